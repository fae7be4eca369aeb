#include <gtest/gtest.h>

#include "tests/unit/common/config/error_of.hpp"

namespace longreach::lab_setting_test {
namespace {

// The error; the configuration must then be as it was.
std::string lab_error(proto::LabConfig config, const std::string& setting) {
  const std::string before = config.SerializeAsString();
  const std::string error = error_of([&] { set_lab_field(config, setting); });
  EXPECT_EQ(config.SerializeAsString(), before) << setting;
  return error;
}

TEST(LabSetting, FindsTheSideThatHasThePath) {
  proto::LabConfig config;
  set_lab_field(config, "mapping.scale=0.5");
  set_lab_field(config, "estimator.forgetting=0.995");
  EXPECT_EQ(config.master().mapping().scale(), 0.5);
  EXPECT_EQ(config.slave().estimator().forgetting(), 0.995);
}

TEST(LabSetting, TakesTheSideAsAPrefix) {
  proto::LabConfig config;
  set_lab_field(config, "master.link.impairment.delay_s=650ms");
  set_lab_field(config, "slave.link.impairment.delay_s=0.1");
  EXPECT_EQ(config.master().link().impairment().delay_s(), 0.65);
  EXPECT_EQ(config.slave().link().impairment().delay_s(), 0.1);
}

TEST(LabSetting, SetsTheLaboratorysOwnFields) {
  proto::LabConfig config;
  set_lab_field(config, "profile=a=b");  // only the first "=" divides
  set_lab_field(config, "duration_s=90");
  EXPECT_EQ(config.profile(), "a=b");
  EXPECT_EQ(config.duration_s(), 90.0);
}

TEST(LabSetting, NamesBothPathsWhenBothSidesHaveIt) {
  for (const std::string path :
       {"link.impairment.delay_s", "rpc.listen", "safety.resume_s", "loop.priority"}) {
    EXPECT_EQ(lab_error({}, path + "=1"),
              path + " exists on both sides; write master." + path + " or slave." + path);
  }
}

TEST(LabSetting, SetsTheLoopRateOnBothSidesOrOnNone) {
  proto::LabConfig config;
  set_lab_field(config, "loop.rate_hz=2000");
  EXPECT_EQ(config.master().loop().rate_hz(), 2000.0);
  EXPECT_EQ(config.slave().loop().rate_hz(), 2000.0);
  EXPECT_EQ(lab_error(config, "loop.rate_hz=100"), "master.loop.rate_hz = 100 is outside 250 to 8000");
}

TEST(LabSetting, SetsTheAccuracyOfBothSides) {
  proto::LabConfig config;
  set_lab_field(config, "accuracy=EXACT");
  EXPECT_EQ(config.master().accuracy(), proto::EXACT);
  EXPECT_EQ(config.slave().accuracy(), proto::EXACT);
}

TEST(LabSetting, LeadsFromAWrongPathToARightOne) {
  EXPECT_TRUE(lab_error({}, "mapping.scle=1")
                  .starts_with("master.mapping has no field \"scle\"; did you mean \"scale\"?"));
  EXPECT_TRUE(lab_error({}, "slave.estimator.forgeting=1")
                  .starts_with("slave.estimator has no field \"forgeting\"; did you mean \"forgetting\"?"));
  EXPECT_EQ(
      lab_error({}, "loop.rate=1"),
      "master.loop has no field \"rate\"; did you mean \"rate_hz\"? It has: rate_hz, priority, lock_memory; "
      "and "
      "slave.loop has no field \"rate\"; did you mean \"rate_hz\"? It has: rate_hz, priority, lock_memory");
  EXPECT_EQ(lab_error({}, "estimtor.forgetting=1"),
            "neither the laboratory nor either side has a field \"estimtor\"; did you mean "
            "\"estimator\"? The fields are: profile, duration_s, trace_hz, master, slave, link, loop, "
            "device_file, device, hand, operator, mapping, rendering, safety, rpc, accuracy, "
            "device_adapter, playout, command, robot_file, robot, scene_file, scene, sensing, "
            "estimator, robot_adapter");
  EXPECT_EQ(lab_error({}, "mapping.scale"), "\"mapping.scale\" is not a setting; write PATH=VALUE");
  EXPECT_EQ(lab_error({}, "=1"), "\"=1\" is not a setting; write PATH=VALUE");
  EXPECT_EQ(lab_error({}, "mapping.scale=7"), "master.mapping.scale = 7 is outside 0.05 to 1");
  EXPECT_TRUE(
      lab_error({}, "mapping=7").starts_with("master.mapping is a group; set one of its fields: mode, "));
}

}  // namespace
}  // namespace longreach::lab_setting_test
