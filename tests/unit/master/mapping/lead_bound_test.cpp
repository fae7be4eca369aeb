#include "master/mapping/lead_bound.hpp"

#include <gtest/gtest.h>

namespace longreach::lead_bound_test {
namespace {

ContactReport held(double place_m) {
  ContactReport c;
  c.place = {place_m, 0.0, 0.0};
  c.held_back = Vector3::UnitX();
  return c;
}

TEST(LeadBound, LastsUntilAGoalWithinItHasBeenReached) {
  LeadBound lead(0.005);
  EXPECT_TRUE(lead.bound().direction.isZero(0.0));
  lead.on_report(held(0.1), 40);
  EXPECT_EQ(lead.bound().direction, Vector3(Vector3::UnitX()));
  lead.on_command(100, 0.2);    // still ahead
  lead.on_command(101, 0.005);  // drawn back
  lead.on_command(102, -0.01);
  // The flag's end alone is not enough.
  lead.on_report({}, 100);
  EXPECT_FALSE(lead.bound().direction.isZero(0.0));
  lead.on_report({}, 101);
  EXPECT_TRUE(lead.bound().direction.isZero(0.0));
}

TEST(LeadBound, WaitsAnewWhenTheRobotHasGivenWay) {
  LeadBound lead(0.005);
  lead.on_report(held(0.1), 40);
  lead.on_command(100, 0.005);
  lead.on_report(held(0.09), 40);
  lead.on_command(101, 0.015);
  lead.on_report({}, 101);
  EXPECT_FALSE(lead.bound().direction.isZero(0.0));
  lead.on_command(102, 0.005);
  lead.on_report({}, 102);
  EXPECT_TRUE(lead.bound().direction.isZero(0.0));
}

TEST(LeadBound, IsATenthOfTheDepthOfTheGuardAtASurface) {
  LeadBound lead(0.003);
  const auto at = [&](const Vector3& normal, double n_per_m, bool pressed, double guard_n) {
    ContactReport c = held(0.1);
    c.surfaces[0] = {.normal = normal, .stiffness = n_per_m, .touch = 1, .pressed = pressed};
    c.guard = guard_n;
    lead.on_report(c, 40);
    return lead.bound().lead;
  };
  const Vector3 opposes = -Vector3::UnitX();
  EXPECT_DOUBLE_EQ(at(opposes, 5000.0, true, 20.0), 4e-4);
  EXPECT_DOUBLE_EQ(at(opposes, 200.0, true, 20.0), 0.003) << "a soft one";
  EXPECT_DOUBLE_EQ(at(opposes, 0.0, true, 20.0), 0.003) << "not known yet";
  EXPECT_DOUBLE_EQ(at(opposes, 5000.0, true, 0.0), 0.003) << "no guard";
  EXPECT_DOUBLE_EQ(at(opposes, 5000.0, false, 20.0), 0.003) << "not pressed";
  EXPECT_DOUBLE_EQ(at(Vector3::UnitY(), 5000.0, true, 20.0), 0.003) << "beside";
}

}  // namespace
}  // namespace longreach::lead_bound_test
