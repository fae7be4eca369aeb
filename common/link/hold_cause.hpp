#pragma once
// Texts of the causes for which a side stops following goals or refuses to engage (HoldCause, proto/types.proto). Both
// sides use the same table, as does all code that displays, logs, records or evaluates a cause. In the status and the log,
// the name of a cause consists of a few lower-case words.

#include <cstdint>
#include <string>
#include <string_view>

#include "schema/types.hpp"

namespace longreach {

/// Kind of a hold, for the verdict of a run: a fault that must be repaired, a busy machine, the operator, an outage of the
/// link, or a protection after which engaging is enough.
enum class HoldAttribution : std::uint8_t { kFault, kMachine, kOperator, kOutage, kProtection };

struct CauseText {
  std::string_view name;
  std::string_view sentence;  // contains neither the joint nor the values, and no full stop
  std::string_view remedy;    // suggested action
  HoldAttribution attribution = HoldAttribution::kFault;
};
/// Returns the texts of `cause`. All are empty for kNone; the name of an invalid number is "unknown".
const CauseText& text_of(HoldCause cause);

/// A cause with the joint and values that it refers to. Converts to and from a bare HoldCause.
struct Reason {
  HoldCause cause = HoldCause::kNone;
  std::uint8_t joint = 0;  // number of the joint, from 1; 0: no joint
  // Position of the joint, rad or m, or its speed, rad/s or m/s; for kToolOutside, the distance of the tool
  // from the centre of the workspace, m. For an approaching surface, the axis of W along which the tool can
  // retreat: 1, 2, 3 for x, y, z, negative for the opposite direction. For a handle that jumped, the
  // distance, m; for a handle outside its workspace, its distance from the centre, m. For repeated holds because
  // of missing datagrams, their number; `limit` is then the timeout, s.
  double value = 0.0;
  double limit = 0.0;  // limit of `value` or previous position of the joint, in the same unit

  constexpr Reason() = default;
  constexpr Reason(HoldCause of) : cause(of) {}
  constexpr Reason(HoldCause of, int joint_from_1, double is, double bound)
      : cause(of), joint(static_cast<std::uint8_t>(joint_from_1)), value(is), limit(bound) {}
  constexpr operator HoldCause() const { return cause; }
};
/// Time within which the slave counts holds because of missing datagrams, and their number from which on a hold
/// stays until the next engagement.
inline constexpr double kSilentHoldsWithin_s = 10.0;
inline constexpr int kSilentHoldsMax = 3;
/// The cause of a hold that stays for that reason. `gap_s` is the timeout.
constexpr Reason silent_repeatedly(double gap_s) {
  return {HoldCause::kLinkSilent, 0, kSilentHoldsMax, gap_s};
}
constexpr bool operator==(const Reason& a, HoldCause b) { return a.cause == b; }
/// Compares cause and joint; the values may differ.
constexpr bool operator==(const Reason& a, const Reason& b) {
  return a.cause == b.cause && a.joint == b.joint;
}
/// Returns, for example, "joint 5 of the robot is at 2.15 rad (or m), beyond its limit of 2.094".
std::string sentence(const Reason& reason);
/// Returns the suggested action.
std::string_view remedy(const Reason& reason);
/// Returns the sentence followed by the remedy.
std::string with_remedy(const Reason& reason);

}  // namespace longreach
