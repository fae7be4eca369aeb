#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "tests/unit/common/config/walk.hpp"

namespace longreach::bodies_names_test {
namespace {

void expect_same(const BondConfig& s, const proto::Bond& m) {
  EXPECT_EQ(s.stiffness_n_per_m, m.stiffness_n_per_m());
  EXPECT_EQ(s.damping_n_s_per_m, m.damping_n_s_per_m());
  EXPECT_EQ(s.stiffness_nm_per_rad, m.stiffness_nm_per_rad());
  EXPECT_EQ(s.damping_nm_s_per_rad, m.damping_nm_s_per_rad());
  EXPECT_EQ(s.play_m, m.play_m());
  EXPECT_EQ(s.play_rad, m.play_rad());
}

// Field by field, as in struct_names_test.
TEST(Structs, CarryEachFieldOfBodiesUnderItsName) {
  const auto slave = distinct<proto::SlaveConfig>();
  const proto::Bodies& m = slave.scene().bodies();
  const BodiesConfig s = to_struct(slave).scene.bodies.value();
  EXPECT_EQ(s.mjcf_file, m.mjcf_file());
  ASSERT_EQ(s.file.size(), static_cast<std::size_t>(m.file_size()));
  for (std::size_t i = 0; i < s.file.size(); ++i) {
    EXPECT_EQ(s.file[i].name, m.file(static_cast<int>(i)).name());
    EXPECT_EQ(s.file[i].text, m.file(static_cast<int>(i)).text());
  }
  EXPECT_EQ(s.gripper.value().fixture, m.gripper().fixture());
  EXPECT_EQ(s.gripper.value().reach_m, m.gripper().reach_m());
  EXPECT_EQ(s.gripper.value().reach_rad, m.gripper().reach_rad());
  expect_same(s.gripper.value().bond, m.gripper().bond());
  EXPECT_EQ(s.latch.value().striker, m.latch().striker());
  EXPECT_EQ(s.latch.value().keeper, m.latch().keeper());
  EXPECT_EQ(s.latch.value().travel_m, m.latch().travel_m());
  EXPECT_EQ(s.latch.value().angle_rad, m.latch().angle_rad());
  expect_same(s.latch.value().bond, m.latch().bond());
}

}  // namespace
}  // namespace longreach::bodies_names_test
