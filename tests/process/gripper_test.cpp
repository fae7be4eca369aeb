// A load in the gripper of the real programs: it is the robot's, whoever commands, and its mass is found.
#include <csignal>
#include <fstream>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::gripper_test {
namespace {

class Gripping : public Station {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "near.xml")
        << "<mujoco><option gravity='0 0 0'/><asset><material name='hard'/></asset><worldbody>"
           "<body name='tool'><freejoint/>"
           "<geom type='sphere' size='0.02' mass='1' pos='-0.1 0 0' material='hard'/></body>"
           "<body name='load' pos='0.06 0 0'><freejoint/>"
           "<geom type='box' size='0.05 0.05 0.05' mass='5' material='hard'/>"
           "<site name='fixture' pos='-0.06 0 0'/></body></worldbody></mujoco>";
    std::ofstream(scene_) << "name: 'near'\n"
                             "material { name: 'hard' stiffness_n_per_m: 20000 }\n"
                             "bodies { mjcf_file: 'near.xml' gripper {} }\n";
  }
  void start_keyboard(const Terminal& terminal, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--operator", "keyboard", "--mode", "position", "--engage"});
    start_master(more, {terminal.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
  }
  bool gripper_is(const std::string& words) {
    return eventually([&, this] {
      const auto now = slave_.status();
      return now && now->gripper().find(words) != std::string::npos;
    });
  }

  const TemporaryFolder folder_;
  const std::string scene_ = (folder_.path() / "near.txtpb").string();
};

TEST_F(Gripping, ALoadStaysInTheGripperWhenTheMasterIsStartedAgain) {
  start_slave({"--set", "scene_file=" + scene_});
  const Terminal first;
  start_keyboard(first);
  if (HasFatalFailure()) return;
  EXPECT_TRUE(gripper_is("open")) << outputs();
  first.type("g");
  ASSERT_TRUE(gripper_is("holds an object")) << outputs();
  master_program_->signal(SIGKILL);
  const Terminal second;
  start_keyboard(second, {"--take"});
  if (HasFatalFailure()) return;
  ASSERT_TRUE(eventually([this] {
    const auto now = master_.status();
    return now && now->gripper().find("closed, holds") == 0;
  })) << outputs();
  // Dragged to and fro its mass is found, and its inertia is no contact.
  ASSERT_TRUE(eventually([&, this] {
    for (const char* keys : {"WWWW", "SSSS"}) {
      second.type(keys);
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
    }
    return slave_.status()->gripper().find("kg") != std::string::npos;
  })) << outputs();
  const std::string reported = slave_.status()->gripper();
  EXPECT_NEAR(std::stod(reported.substr(reported.find("holds ") + 6)), 5.0, 0.5) << reported;
  EXPECT_EQ(slave_.counter("touches"), 0u) << reported;
  second.type("g");
  EXPECT_TRUE(gripper_is("open")) << outputs();
}

}  // namespace
}  // namespace longreach::gripper_test
