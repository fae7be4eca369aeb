#include "common/config/link_profile.hpp"

#include <gtest/gtest.h>

namespace longreach::link_profile_test {
namespace {

proto::LinkProfile narrow() {
  proto::LinkProfile profile;
  profile.mutable_up()->set_delay_s(0.1);
  profile.mutable_up()->set_rate_bit_per_s(256e3);
  profile.mutable_down()->set_delay_s(0.2);
  return profile;
}

TEST(TakeProfile, ImpairsTheWayInAndKeepsWithinTheRateOfTheWayOut) {
  proto::MasterLink master;
  proto::SlaveLink slave;
  take_profile(master, narrow());
  take_profile(slave, narrow());
  EXPECT_EQ(master.impairment().delay_s(), 0.2);
  EXPECT_EQ(slave.impairment().delay_s(), 0.1);
  EXPECT_LT(master.budget_kbit_per_s(), 256.0);
  EXPECT_GT(master.budget_kbit_per_s(), 230.0);
  EXPECT_FALSE(slave.has_budget_kbit_per_s());  // its way out has no rate
}

TEST(TakeProfile, LeavesABudgetThatIsSet) {
  proto::MasterLink master;
  master.set_budget_kbit_per_s(0.0);
  take_profile(master, narrow());
  EXPECT_EQ(master.budget_kbit_per_s(), 0.0);
}

}  // namespace
}  // namespace longreach::link_profile_test
