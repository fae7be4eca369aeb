#include "slave/sensing/sensor_words.hpp"

#include <charconv>
#include <cmath>

namespace longreach {
namespace {

std::string number(double value, const char* unit) {
  constexpr int kDigits = 2;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, kDigits).ptr;
  return std::string(text, end) + " " + unit;
}

std::string rejected(const std::string& offset, const char* guard) {
  return "a zero offset of " + offset + " is rejected because it is too large compared with " + guard +
         "; keep the tool free of contact, or describe the tool in sensing.tool";
}

}  // namespace

std::string in_words(const SensorZero& zero) {
  if (!zero.derived) return "";
  std::string text = "touch threshold " + number(zero.touch_n, "N");
  if (zero.noise_n > 0.0) text += ", noise " + number(zero.noise_n, "N");
  if (zero.missing_m > 0.0) {
    const double missing_mm = std::ceil(1e3 * zero.missing_m);
    return text + ", not zeroed: needs " + number(missing_mm, "mm") +
           " of motion at over 5 mm/s without contact";
  }
  return text + ", bias " + number(zero.bias_n, "N");
}

std::string sensor_warning(const SensorZero& zero) {
  if (!zero.derived) return "";
  if (zero.refused_n > 0.0) return rejected(number(zero.refused_n, "N"), "command.force_guard_n");
  if (zero.refused_nm > 0.0) return rejected(number(zero.refused_nm, "N m"), "command.moment_guard_nm");
  if (zero.noisy)
    return "the force sensor is noisier than sensing.force_noise_n: contacts below " +
           number(zero.touch_n, "N") +
           " are not detected; shield the sensor, or set sensing.force_noise_n to its noise level";
  if (zero.missing_m <= 0.0 && zero.drift_n > zero.touch_n)
    return "the force sensor may have drifted by " + number(zero.drift_n, "N") +
           " since the last free motion and may hide a light contact; move the tool 10 mm without contact";
  return "";
}

}  // namespace longreach
