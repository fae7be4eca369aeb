// Settings of the sensor and of the guards that would let a force past the guard are refused at the start, with
// the value that is allowed.
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::guarded_test {
namespace {

const std::filesystem::path kDeploy = LONGREACH_DEPLOY;

proto::SlaveConfig with(const std::vector<std::pair<std::string, std::string>>& settings) {
  proto::SlaveConfig config;
  for (const auto& [path, value] : settings) set_field(config, path, value);
  return config;
}

std::string error(const std::vector<std::pair<std::string, std::string>>& settings) {
  proto::SlaveConfig config = with(settings);
  return error_of([&] { resolve_files(config, kDeploy); });
}

TEST(Guarded, RefusesSensorsThatHideMoreThanTheGuardBears) {
  struct Case {
    const char* path;
    const char* value;
    const char* error;  // its beginning; empty: allowed
  };
  const std::string hidden_n = "command.force_guard_n = 20 cannot be enforced with the sensor";
  const std::string hidden_nm = "command.moment_guard_nm = 5 cannot be enforced with the sensor";
  for (const Case& c :
       {Case{"sensing.force_bias_n", "30", hidden_n.c_str()},
        Case{"sensing.force_bias_n", "-30", hidden_n.c_str()}, Case{"sensing.force_bias_n", "5", ""},
        Case{"sensing.force_drift_n", "2", hidden_n.c_str()}, Case{"sensing.force_drift_n", "0.5", ""},
        Case{"sensing.force_resolution_n", "20", "command.force_guard_n = 20 cannot be enforced"},
        Case{"sensing.force_resolution_n", "0.5", ""}, Case{"sensing.moment_bias_nm", "2", hidden_nm.c_str()},
        Case{"sensing.moment_bias_nm", "0.5", ""}, Case{"sensing.moment_drift_nm", "1", hidden_nm.c_str()},
        Case{"sensing.moment_resolution_nm", "5", hidden_nm.c_str()},
        Case{"sensing.touch_nm", "6", "command.moment_guard_nm = 5 is not above sensing.touch_nm = 6"},
        Case{"sensing.bandwidth_hz", "0.5", "command.force_guard_n = 20 cannot be enforced"},
        Case{"command.guard_stiffness_n_per_m", "10",
             "command.guard_stiffness_n_per_m = 10 is below 1000 N/m"},
        Case{"command.guard_stiffness_n_per_m", "1000", ""}}) {
    const std::string is = error({{"sensing.moment", "true"}, {c.path, c.value}}),
                      expected = *c.error ? c.error : "no error";
    EXPECT_TRUE(is.starts_with(expected)) << c.path << " = " << c.value << ": " << is;
  }
  EXPECT_TRUE(error({{"command.hold_force_n", "0"}, {"sensing.touch_n", "30"}}).find("cannot be enforced") !=
              std::string::npos);
}

// 30 sqrt(3) / 0.6 = 86.60; 5 sqrt(3) / 0.35 = 24.74.
TEST(Guarded, NamesTheMinimumAndAllowsIt) {
  const std::pair<std::string, std::string> bias{"sensing.force_bias_n", "30"};
  const std::string is = error({bias});
  EXPECT_NE(is.find("the minimum is 86.7; set it to that value, or lower these figures"), std::string::npos)
      << is;
  EXPECT_EQ(error({bias, {"command.force_guard_n", "86.7"}}), "no error");
  // A bias that nothing removes counts in full.
  const std::pair<std::string, std::string> fixed{"sensing.touch_n", "0.3"},
      five{"sensing.force_bias_n", "5"};
  EXPECT_NE(error({fixed, five}).find("the minimum is 24.8"), std::string::npos) << error({fixed, five});
  EXPECT_EQ(error({fixed, five, {"sensing.zero_s", "0.2"}}), "no error");
}

TEST(Guarded, ChecksNothingWithoutSensor) {
  EXPECT_EQ(error({{"sensing.force", "false"}, {"sensing.force_bias_n", "30"}}), "no error");
  EXPECT_EQ(error({{"sensing.moment", "false"}, {"sensing.moment_bias_nm", "30"}}), "no error");
}

}  // namespace
}  // namespace longreach::guarded_test
