#pragma once
// Keeps the goal while the hand still moves after a hold in contact: during the hold no force holds the hand, so it moves
// inwards, and the robot would press harder than before. The robot follows the hand again when the force that the hold
// ended is back and the hand is at rest, or after half a second.

#include "common/spatial/spatial.hpp"
#include "schema/state_master.hpp"

namespace longreach {

class ResumeGate {
 public:
  /// Advances by `dt_s`. Returns whether the goal is kept. `in_contact`: the robot touches something; `felt`: a surface
  /// is rendered.
  bool step(bool engaged, bool in_contact, bool felt, const HandleState& handle, double dt_s) {
    constexpr double kMost_s = 0.5, kRests_m_per_s = 5e-3, kRests_rad_per_s = 0.05;
    if (engaged && !engaged_) left_s_ = kMost_s;
    if (!engaged && engaged_) lost_ = felt_;
    engaged_ = engaged;
    felt_ = felt;
    const bool moves =
        norm(handle.velocity_m_per_s) > kRests_m_per_s || norm(handle.angular_rad_per_s) > kRests_rad_per_s;
    left_s_ = engaged && in_contact && (moves || (lost_ && !felt)) ? left_s_ - dt_s : 0.0;
    return left_s_ > 0.0;
  }

 private:
  bool engaged_ = false;
  bool felt_ = false;  // in the last step
  bool lost_ = false;  // a surface was rendered when the last engagement ended
  double left_s_ = 0.0;
};

}  // namespace longreach
