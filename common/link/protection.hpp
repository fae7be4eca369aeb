#pragma once
// Protections that a setting or the connected hardware makes ineffective. Each side reports its own, and every display
// shows them as "reduced protection: ...". deploy/guide/operating.md contains the same table.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

/// The number of an enumerator is the number of its bit on the wire.
enum class Protection : std::uint8_t {
  kForceGuard,
  kMomentGuard,
  kFrozenSensor,
  kSaturatedSensor,
  kJointSpeed,
  kJointJerk,
  kDelayRise,
  kHandPresence,
  kRpc,
  kCount
};

struct ProtectionText {
  std::string_view missing;  // what does not act, for example "no force guard"
  std::string_view effect;   // what can happen
  std::string_view when;     // setting or state that is the reason
};
const ProtectionText& text_of(Protection protection);

/// A permitted increase of the delay above this never causes a hold on a link that longreach supports, s.
inline constexpr double kDelayRiseNoticed_s = 10.0;

/// Returns `reduced` with the bit of `protection` set if `applies`.
constexpr std::uint32_t with(std::uint32_t reduced, Protection protection, bool applies) {
  return reduced | (applies ? 1U << static_cast<unsigned>(protection) : 0U);
}
/// Returns for each set bit "no force guard: contacts are not detected (sensing.force is false)". Unknown bits, for
/// example of a newer version, are described as such.
std::vector<std::string> reduced_in_words(std::uint32_t reduced);

}  // namespace longreach
