#include <gtest/gtest.h>

#include "common/config/config.hpp"

namespace longreach::changes_test {
namespace {

using Paths = std::vector<std::string>;

constexpr bool kEngaged = true;
constexpr bool kFree = false;

TEST(RefusedChanges, FollowTheFieldsOwnOption) {
  const proto::MasterConfig before;
  proto::MasterConfig after;
  after.mutable_mapping()->set_scale(0.5);                       // not while engaged: the default
  after.mutable_link()->mutable_impairment()->set_delay_s(1.0);  // any time
  after.mutable_loop()->set_rate_hz(2000.0);                     // at start
  EXPECT_EQ(refused_changes(before, after, kEngaged), (Paths{"loop.rate_hz", "mapping.scale"}));
  EXPECT_EQ(refused_changes(before, after, kFree), (Paths{"loop.rate_hz"}));
}

TEST(RefusedChanges, CompareEffectiveValues) {
  proto::MasterConfig before;
  proto::MasterConfig after;
  after.mutable_loop()->set_rate_hz(1000.0);  // its default, written out
  after.mutable_mapping();
  EXPECT_EQ(refused_changes(before, after, kEngaged), Paths{});
  before.mutable_loop()->set_rate_hz(2000.0);
  EXPECT_EQ(refused_changes(before, after, kEngaged), (Paths{"loop.rate_hz"}));
  after.clear_loop();
  EXPECT_EQ(refused_changes(before, after, kEngaged), (Paths{"loop.rate_hz"}));
}

TEST(RefusedChanges, TakePartsOfWhatIsReadAtStartAsReadAtStart) {
  proto::SlaveConfig before;
  for (int i = 0; i < 6; ++i) before.mutable_robot()->add_joint()->set_a_m(1.0);
  before.mutable_scene()->add_material()->set_name("wall");
  proto::SlaveConfig after = before;
  after.mutable_robot()->mutable_joint(3)->set_max_rad(1.0);
  after.mutable_scene()->mutable_material(0)->set_exponent(1.5);
  EXPECT_EQ(refused_changes(before, after, kFree),
            (Paths{"robot.joint.3.max_rad", "scene.material.wall.exponent"}));
}

TEST(RefusedChanges, NameTheListWhoseLengthChanges) {
  const proto::SlaveConfig before;
  proto::SlaveConfig after;
  after.mutable_scene()->add_material();
  EXPECT_EQ(refused_changes(before, after, kFree), (Paths{"scene.material"}));
  const proto::MasterConfig still;
  proto::MasterConfig turned;
  for (int i = 0; i < 3; ++i) turned.mutable_operator_()->add_direction(1.0);
  EXPECT_EQ(refused_changes(still, turned, kEngaged), (Paths{"operator.direction"}));
  EXPECT_EQ(refused_changes(still, turned, kFree), Paths{});
}

TEST(RefusedChanges, SeeTheSmallestDifference) {
  proto::SlaveConfig before;
  proto::SlaveConfig after;
  before.mutable_command()->set_force_guard_n(20.0);
  after.mutable_command()->set_force_guard_n(20.000000000000004);
  EXPECT_EQ(refused_changes(before, after, kEngaged), (Paths{"command.force_guard_n"}));
}

}  // namespace
}  // namespace longreach::changes_test
