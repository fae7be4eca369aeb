#include "common/io/log.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace longreach {
namespace {

TEST(Log, WritesOneEventALineWithTimeLevelAndSide) {
  const auto file = std::filesystem::temp_directory_path() / ("longreach-log-" + std::to_string(getpid()));
  set_up_log("slave", file.string());
  spdlog::info("state from={} to={}", "Idle", "Observing");
  spdlog::warn("stopped");
  set_up_log("slave", "", true);
  std::ifstream in(file);
  std::string first, second, third;
  std::getline(in, first);
  std::getline(in, second);
  EXPECT_FALSE(std::getline(in, third));
  const std::string time = R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z )";
  EXPECT_TRUE(std::regex_match(first, std::regex(time + "info slave state from=Idle to=Observing"))) << first;
  EXPECT_TRUE(std::regex_match(second, std::regex(time + "warning slave stopped"))) << second;
  std::filesystem::remove(file);
}

TEST(Log, SaysWhatToDoWhenTheFileCannotBeWritten) {
  try {
    set_up_log("slave", "/proc/no/such/file");
    FAIL() << "opened";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("--log"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace longreach
