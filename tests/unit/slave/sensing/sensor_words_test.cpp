#include "slave/sensing/sensor_words.hpp"

#include <gtest/gtest.h>

namespace longreach::sensor_words_test {
namespace {

SensorZero usual() {
  return {.count = 1, .bias_n = 3.21, .touch_n = 0.25, .noise_n = 0.0112, .derived = true};
}

TEST(SensorWords, SayThresholdNoiseAndBiasOrWhatIsMissing) {
  EXPECT_EQ(in_words(usual()), "touch threshold 0.25 N, noise 0.011 N, bias 3.2 N");
  SensorZero zero = usual();
  zero.noise_n = 0.0;
  zero.missing_m = 0.0071;
  EXPECT_EQ(in_words(zero),
            "touch threshold 0.25 N, not zeroed: needs 8 mm of motion at over 5 mm/s without contact");
  EXPECT_EQ(in_words(SensorZero{}), "") << "as configured";
}

TEST(SensorWords, WarnOfWhatHidesOrInventsContacts) {
  EXPECT_EQ(sensor_warning(usual()), "");
  SensorZero zero = usual();
  zero.drift_n = 0.4;
  EXPECT_EQ(sensor_warning(zero),
            "the force sensor may have drifted by 0.4 N since the last free motion and may hide a light "
            "contact; move the tool 10 mm without contact");
  zero.noisy = true;
  zero.touch_n = 1.05;
  EXPECT_EQ(sensor_warning(zero),
            "the force sensor is noisier than sensing.force_noise_n: contacts below 1.1 N are not detected; "
            "shield the sensor, or set sensing.force_noise_n to its noise level");
  zero.refused_nm = 3.24;
  EXPECT_EQ(
      sensor_warning(zero),
      "a zero offset of 3.2 N m is rejected because it is too large compared with command.moment_guard_nm; "
      "keep the tool free of contact, or describe the tool in sensing.tool");
  zero.refused_n = 14.7;
  EXPECT_EQ(
      sensor_warning(zero),
      "a zero offset of 15 N is rejected because it is too large compared with command.force_guard_n; keep "
      "the tool free of contact, or describe the tool in sensing.tool");
  zero.derived = false;
  EXPECT_EQ(sensor_warning(zero), "");
}

}  // namespace
}  // namespace longreach::sensor_words_test
