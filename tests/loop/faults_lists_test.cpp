// The limits that the campaign asks for and judges: those of the schema that a client cannot change freely.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "proto/config.pb.h"
#include "tests/faults/looseness.hpp"

namespace longreach::faults_lists_test {
namespace {

TEST(FaultLists, TheLimitsThatProtectTheRobotAndTheHandAreAmongThem) {
  const auto expect = [](std::span<const GuardedField> limits, const std::string& path, Loose looser) {
    const auto found = std::ranges::find(limits, path, &GuardedField::path);
    ASSERT_NE(found, limits.end()) << path;
    EXPECT_EQ(found->looser, looser) << path;
  };
  EXPECT_GT(slave_limits().size(), 30u);
  EXPECT_GT(master_limits().size(), 30u);
  expect(slave_limits(), "command.force_guard_n", Loose::kAbove);
  expect(slave_limits(), "command.speed_max_m_per_s", Loose::kAbove);
  expect(slave_limits(), "sensing.tool.mass_kg", Loose::kOther);
  expect(slave_limits(), "safety.age_max_s", Loose::kAbove);
  expect(master_limits(), "rendering.force_max_n", Loose::kAbove);
  expect(master_limits(), "rendering.tank_max_j", Loose::kAbove);
  expect(master_limits(), "safety.presence", Loose::kBelow);
}

TEST(FaultLists, WhatIsLooserIsNamed) {
  EXPECT_EQ(looser(proto::MasterConfig(), proto::MasterConfig()), "");
  proto::SlaveConfig start, now;
  EXPECT_EQ(looser(start, now), "");
  now.mutable_safety()->set_delay_rise_max_s(2.0);
  EXPECT_EQ(looser(start, now), "safety.delay_rise_max_s is less restrictive than at the start");
  now = {};
  now.mutable_safety()->set_gap_s(0.05);
  EXPECT_EQ(looser(start, now), "");  // 0, at the start, finds at least 0.1 s
  now.mutable_safety()->set_gap_s(0.2);
  EXPECT_NE(looser(start, now), "");
  now = {};
  now.mutable_sensing()->mutable_tool()->add_com_m(0.1);
  EXPECT_EQ(looser(start, now), "sensing.tool.com_m is less restrictive than at the start");
}

}  // namespace
}  // namespace longreach::faults_lists_test
