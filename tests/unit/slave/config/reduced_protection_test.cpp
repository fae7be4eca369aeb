#include "slave/config/reduced_protection.hpp"

#include <gtest/gtest.h>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach::reduced_protection_test {
namespace {

TEST(ReducedProtection, WithoutNoiseAFrozenSensorIsNotNoticed) {
  const std::uint32_t frozen = with(0, Protection::kFrozenSensor, true);
  for (const bool force : {true, false}) {
    SlaveConfig config = test::wall_config(0.02, 1000.0);
    (force ? config.sensing.force_noise_n : config.sensing.moment_noise_nm) = 0.0;
    EXPECT_EQ(reduced_protection(config), frozen);
    (force ? config.sensing.force : config.sensing.moment) = false;
    EXPECT_EQ(reduced_protection(config) & frozen, 0U) << "there is no such sensor";
  }
}

}  // namespace
}  // namespace longreach::reduced_protection_test
