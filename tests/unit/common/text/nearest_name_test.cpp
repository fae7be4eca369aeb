#include "common/text/nearest_name.hpp"

#include <gtest/gtest.h>

namespace longreach::nearest_name_test {
namespace {

const Names kNames{"mode", "scale", "rate_law", "kv_per_s", "delay_s", "jitter_s"};

TEST(NearestName, FindsASlipOfTheKeyboard) {
  EXPECT_EQ(nearest_name("scle", kNames), "scale");
  EXPECT_EQ(nearest_name("Scale", kNames), "scale");
  EXPECT_EQ(nearest_name("rate-law", kNames), "rate_law");
}

TEST(NearestName, AddsAForgottenUnit) {
  EXPECT_EQ(nearest_name("delay", kNames), "delay_s");
  EXPECT_EQ(nearest_name("kv", kNames), "kv_per_s");
  EXPECT_EQ(nearest_name("x", {"x_m", "x_rad"}), std::nullopt);  // which of the two?
}

TEST(NearestName, SaysNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("temperature", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("z", {"a", "b"}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(1 << 20, 'a'), kNames), std::nullopt);
  EXPECT_EQ(nearest_name("scale", {}), std::nullopt);
  EXPECT_EQ(did_you_mean("temperature", kNames), "");
  EXPECT_EQ(did_you_mean("scle", kNames), "; did you mean \"scale\"?");
}

}  // namespace
}  // namespace longreach::nearest_name_test
