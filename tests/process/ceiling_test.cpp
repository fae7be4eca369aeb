// What clients ask for that would switch a guard off, of real programs.
#include "tests/support/station.hpp"

namespace longreach::ceiling_test {
namespace {

using Assignments = std::vector<std::pair<std::string, std::string>>;

const std::string kWhatToDo = "change it in the configuration file of this side and restart this side";

TEST_F(Station, AClientSwitchesNoGuardOffAtEitherSide) {
  start_slave({"--set", "sensing.touch_n=0.3"});
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Observing"; })) << outputs();
  const std::string slave = slave_.get(""), master = master_.get("");
  for (const Assignments& asked : {Assignments{{"sensing.zero_s", "100"}},
                                   {{"sensing.tool.mass_kg", "8"}, {"sensing.gravity_m_per_s2", "0,0,-9.81"}},
                                   {{"sensing.release_n", "1e-6"}},
                                   {{"sensing.touch_n", "0"}, {"sensing.release_n", "0.12"}},
                                   {{"command.force_guard_n", "100"}},
                                   {{"command.guard_stiffness_n_per_m", "19000"}},
                                   {{"safety.gap_s", "2"}}})
    EXPECT_NE(slave_.set(asked).find(kWhatToDo), std::string::npos) << asked.front().first;
  for (const Assignments& asked : {Assignments{{"rendering.force_max_n", "100"}},
                                   {{"rendering.slew_n_per_s", "1e6"}},
                                   {{"rendering.ke", "100"}},
                                   {{"safety.silence_s", "10"}},
                                   {{"safety.engage_at_start", "true"}}})
    EXPECT_NE(master_.set(asked).find(kWhatToDo), std::string::npos) << asked.front().first;
  EXPECT_NE(master_.set("rendering.law", "NAIVE")
                .find("available only in longreach-lab; leave it out or set STIFFNESS"),
            std::string::npos);
  // One of two would do; the other does not: none is set.
  EXPECT_NE(slave_.set({{"command.force_guard_n", "10"}, {"safety.resume_s", "9"}}), "");
  EXPECT_NE(master_.set({{"rendering.force_max_n", "5"}, {"rendering.ke", "2"}}), "");
  EXPECT_NE(master_.set({{"rendering.force_max_n", "5"}, {"rendering.law", "NAIVE"}}), "");
  EXPECT_EQ(slave_.get(""), slave);
  EXPECT_EQ(master_.get(""), master);

  EXPECT_NE(slave.find("force_guard_n: 20  # may be set: 20 or less"), std::string::npos) << slave;
  EXPECT_EQ(slave_.set("command.force_guard_n", "10"), "");
  EXPECT_EQ(slave_.get("command.force_guard_n"), "10");
  EXPECT_NE(slave_.get("").find("force_guard_n: 10  # may be set: 20 or less"), std::string::npos);
}

TEST_F(Station, AMasterDoesNotStartWithALawToCompareWith) {
  for (const std::string law : {"NAIVE", "WAVE"}) {
    RunningProgram program("longreach-master", {"--set", "rendering.law=" + law, "--view", "none"});
    EXPECT_NE(program.wait(std::chrono::seconds(20)), 0);
    EXPECT_NE(program.output().find("rendering.law = " + law +
                                    " is for comparison and available only in longreach-lab; leave it "
                                    "out or set STIFFNESS"),
              std::string::npos)
        << program.output();
  }
}

}  // namespace
}  // namespace longreach::ceiling_test
