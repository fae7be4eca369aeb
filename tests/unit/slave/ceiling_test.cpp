#include "slave/ceiling.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace longreach {
namespace {

struct Field {
  std::string path;
  std::function<double&(SlaveConfig&)> of;
  double tighter, looser;  // than 1.0, of the start
};

const std::vector<Field>& fields() {
  static const std::vector<Field> kFields = {
      {"command.speed_max_m_per_s", [](auto& c) -> double& { return c.command.speed_max_m_per_s; }, 0.9, 1.1},
      {"command.acceleration_max_m_per_s2",
       [](auto& c) -> double& { return c.command.acceleration_max_m_per_s2; }, 0.9, 1.1},
      {"command.speed_max_rad_per_s", [](auto& c) -> double& { return c.command.speed_max_rad_per_s; }, 0.9,
       1.1},
      {"command.acceleration_max_rad_per_s2",
       [](auto& c) -> double& { return c.command.acceleration_max_rad_per_s2; }, 0.9, 1.1},
      {"command.force_guard_n", [](auto& c) -> double& { return c.command.force_guard_n; }, 0.9, 1.1},
      {"command.workspace_m", [](auto& c) -> double& { return c.command.workspace_m; }, 0.9, 1.1},
      {"command.guard_stiffness_n_per_m",
       [](auto& c) -> double& { return c.command.guard_stiffness_n_per_m; }, 1.1, 0.9},
      {"sensing.touch_n", [](auto& c) -> double& { return c.sensing.touch_n; }, 0.9, 1.1},
      {"sensing.filter_s", [](auto& c) -> double& { return c.sensing.filter_s; }, 0.9, 1.1},
      {"safety.gap_s", [](auto& c) -> double& { return c.safety.gap_s; }, 0.9, 1.1},
      {"safety.age_max_s", [](auto& c) -> double& { return c.safety.age_max_s; }, 0.9, 1.1},
      {"safety.resume_s", [](auto& c) -> double& { return c.safety.resume_s; }, 0.9, 1.1}};
  return kFields;
}

TEST(Ceiling, EachLimitCanBeTightenedAndNotLoosened) {
  for (const Field& field : fields()) {
    SlaveConfig start;
    field.of(start) = 1.0;
    SlaveConfig after = start;
    EXPECT_FALSE(loosened(start, after)) << field.path;
    field.of(after) = field.tighter;
    EXPECT_FALSE(loosened(start, after)) << field.path;
    field.of(after) = field.looser;
    EXPECT_EQ(loosened(start, after), field.path);
  }
}

TEST(Ceiling, AGapTimerByTheSendRateIsShortenedByWhatIsShorterForEveryMaster) {
  SlaveConfig start, after;
  EXPECT_FALSE(loosened(start, after));
  after.safety.gap_s = 0.1;
  EXPECT_FALSE(loosened(start, after));
  after.safety.gap_s = 0.101;
  EXPECT_EQ(loosened(start, after), "safety.gap_s");
  start.safety.gap_s = 0.1;
  after.safety.gap_s = 0.0;
  EXPECT_EQ(loosened(start, after), "safety.gap_s");
}

TEST(Ceiling, TheHoldLimitCountsAsItActs) {
  SlaveConfig start, after;
  start.command.force_guard_n = after.command.force_guard_n = 20.0;
  after.command.hold_force_n = 10.0;  // half of the guard is the start's
  EXPECT_FALSE(loosened(start, after));
  after.command.hold_force_n = 11.0;
  EXPECT_EQ(loosened(start, after), "command.hold_force_n");
  start.command.hold_force_n = 4.0;
  after.command.hold_force_n = 0.0;
  EXPECT_EQ(loosened(start, after), "command.hold_force_n");
  after.command.force_guard_n = 8.0;
  EXPECT_FALSE(loosened(start, after));
}

}  // namespace
}  // namespace longreach
