#pragma once
// A station with `longreach view`, and a browser that drives its page (tests/process/page/drive.mjs).

#include <filesystem>
#include <iostream>

#include "tests/process/page_client.hpp"
#include "tests/support/station.hpp"

namespace longreach {

class ViewStation : public Station {
 protected:
  void start_view(const std::vector<std::string>& more = {}, const std::string& slave = "") {
    std::vector<std::string> arguments = {
        "--master", "127.0.0.1:" + std::to_string(ports_.master_rpc), "--slave",
        slave.empty() ? "127.0.0.1:" + std::to_string(ports_.slave_rpc) : slave, "view"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    view_ = std::make_unique<RunningProgram>("longreach", arguments);
    ASSERT_TRUE(says(*view_, "(Ctrl-C quits)")) << view_->output();
    const std::string said = view_->output();
    const std::size_t begin = said.find("http://");
    address_ = said.substr(begin, said.find("  (") - begin);
    port_ = port_of(address_);
  }

  /// Drives the page as tests/process/page/drive.mjs describes; pictures stay in the build.
  std::unique_ptr<RunningProgram> driver(const std::string& what) {
    const auto pictures = std::filesystem::path(LONGREACH_BIN).parent_path() / "view";
    std::filesystem::create_directories(pictures);
    // First among what is not real-time, where that is allowed: a picture without a graphics processor takes
    // long.
    const std::vector<std::string> words = {"-n",
                                            "-10",
                                            LONGREACH_NODE,
                                            LONGREACH_PAGE_TESTS "/drive.mjs",
                                            what,
                                            address_,
                                            pictures.string(),
                                            LONGREACH_NPM,
                                            LONGREACH_CHROMIUM};
    return std::make_unique<RunningProgram>("/usr/bin/nice", words);
  }
  void finish(RunningProgram& driver) {
    const auto status = driver.wait(std::chrono::minutes(9));
    EXPECT_EQ(status, 0) << driver.output() << view_->output() << outputs();
    std::cout << driver.output();
  }
  void drive(const std::string& what) { finish(*driver(what)); }

  std::unique_ptr<RunningProgram> view_;
  std::string address_;
  int port_ = 0;
};

}  // namespace longreach
