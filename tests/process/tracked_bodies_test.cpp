// The free bodies of a robot behind an adapter, from the robot to the page of the real programs.
#include <array>

#include "tests/process/view_station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::tracked_bodies_test {
namespace {

class TrackedBodies : public ViewStation {
 protected:
  void SetUp() override {
    const std::string robot_file = (folder_.path() / "robot.txtpb").string();
    adapter_ = "unix:" + (folder_.path() / "robot").string();
    robot_ = std::make_unique<RunningProgram>(
        "longreach-mujoco", std::vector<std::string>{LONGREACH_DEPLOY "/mujoco/scenes/spacecraft.xml",
                                                     adapter_, "--write-robot", robot_file});
    ASSERT_TRUE(says(*robot_, "listening on " + adapter_)) << robot_->output();
    slave_words_ = {
        "--adapter", adapter_, "--set", "robot_file=" + robot_file, "--set", "robot_adapter.silence_s=0.5"};
  }

  /// The position of the first body in a frame of the page, if there is one.
  static std::optional<std::array<double, 3>> body(const std::string& frame) {
    std::size_t at = frame.find("\"body1\":{");
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string key = std::string("\"") + "xyz"[i] + "\":";
      at = frame.find(key, at);
      if (at == std::string::npos) return std::nullopt;
      p[i] = std::stod(frame.substr(at + key.size()));
    }
    return p;
  }

  TemporaryFolder folder_;
  std::string adapter_;
  std::unique_ptr<RunningProgram> robot_;
  std::vector<std::string> slave_words_;
};

TEST_F(TrackedBodies, OfMujocoAreShownWhereTheyAre) {
  constexpr std::array kSpacecraft_m{0.684, 0.0, 0.539};  // spacecraft.xml
  start_slave(slave_words_);
  start_master({"--operator", "none"});
  start_view();
  if (HasFatalFailure()) return;
  PageClient page(address_);
  ASSERT_TRUE(page.ok());
  std::optional<std::array<double, 3>> seen;
  std::string frame;
  for (int i = 0; i < 2000 && !seen; ++i) {
    frame = page.read().value_or("");
    seen = body(frame);
  }
  ASSERT_TRUE(seen) << frame << outputs() << robot_->output();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*seen)[i], kSpacecraft_m[i], 0.005) << frame;
  EXPECT_EQ(slave_.counter("adapter_malformed"), 0U);
  drive("markers");
}

TEST_F(TrackedBodies, AreCountedByTheCheckOfTheAdapter) {
  std::string output;
  // The rate is that of the machine, too.
  for (int i = 0; i < 5 && output.find(" 0 failures") == std::string::npos; ++i) {
    RunningProgram check("longreach", {"adapter", "check", "--robot", adapter_});
    check.wait(std::chrono::seconds(60));
    output = check.output();
  }
  EXPECT_NE(output.find("tracks 1 free body\n"), std::string::npos) << output;
  EXPECT_NE(output.find("increases by one per datagram"), std::string::npos) << output;
  EXPECT_NE(output.find("0 failures"), std::string::npos) << output;
}

}  // namespace
}  // namespace longreach::tracked_bodies_test
