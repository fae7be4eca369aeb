#include "common/link/protection.hpp"

#include <array>

namespace longreach {
namespace {

constexpr std::size_t kProtections = static_cast<std::size_t>(Protection::kCount);

constexpr std::array<ProtectionText, kProtections> kTexts = {{
    {"no force guard", "contacts are not detected, and no force is limited", "sensing.force is false"},
    {"no moment guard", "contacts by rotation are not detected, and no moment is limited",
     "sensing.moment or sensing.force is false"},
    {"no check for a frozen force sensor", "a sensor that stops is not noticed",
     "sensing.force_noise_n or sensing.moment_noise_nm is at most half of the resolution of the sensor"},
    {"no check for a saturated force sensor", "a force beyond the range of the sensor is not noticed",
     "sensing.force_range_n is 0 with a real robot"},
    {"no check of the joint speeds",
     "the robot reports no speeds, so the force guard reacts later to inertia",
     "every reported joint speed has been 0 while the joints moved"},
    {"no jerk limit", "the setpoints change their acceleration at once",
     "robot.joint.jerk_max_rad_per_s3 allows it within one tick"},
    {"no hold when the delay increases", "the robot follows goals that have become much older",
     "safety.delay_rise_max_s is above 10 s"},
    {"no hold when the handle is released", "the handle may move without a hand",
     "safety.presence is IGNORE with a real haptic device"},
    {"no protection of RPC", "every user of this machine can take control of the robot",
     "the program was started with --insecure"},
}};

}  // namespace

const ProtectionText& text_of(Protection protection) {
  static constexpr ProtectionText kUnknown{"unknown", "unknown",
                                           "see the documentation of the other side's version"};
  const auto index = static_cast<std::size_t>(protection);
  return index < kProtections ? kTexts[index] : kUnknown;
}

std::vector<std::string> reduced_in_words(std::uint32_t reduced) {
  std::vector<std::string> words;
  for (unsigned i = 0; i < 32; ++i) {
    if ((reduced >> i & 1U) == 0) continue;
    const ProtectionText& text = text_of(static_cast<Protection>(i));
    words.push_back(std::string(text.missing) + ": " + std::string(text.effect) + " (" +
                    std::string(text.when) + ")");
    if (i >= kProtections) break;
  }
  return words;
}

}  // namespace longreach
