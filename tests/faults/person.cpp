#include "tests/faults/person.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kReach_m = 0.04;
constexpr double kReach_rad = 0.3;
constexpr double kSlowest_s = 1.6, kSwiftest_s = 0.3;  // for a way
constexpr double kReaction_s = 0.3;
constexpr double kImpatience_s = 1.0;

/// Way and speed of least jerk (Flash and Hogan 1985) at the share `s` of the time.
double direction(double s) { return s * s * s * (10.0 + s * (-15.0 + 6.0 * s)); }
double speed(double s) { return 30.0 * s * s * (1.0 + s * (-2.0 + s)); }

}  // namespace

Person::Person(Random random, const MasterConfig& master, double round_trip_s)
    : random_(random),
      grip_(master.hand.grip),
      rate_(master.mapping.mode == MotionMode::kRate),
      reach_m_(std::min(kReach_m, 0.6 * master.device.delta.workspace_m)),
      reach_rad_(std::min(kReach_rad, 0.5 * master.device.spherical.workspace_rad)),
      timeout_s_(round_trip_s + 1.5) {}

Vector3 Person::anywhere(double reach) {
  return reach * Vector3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)) /
         std::sqrt(3.0);
}

void Person::choose(double now_s) {
  from_m_ = to_m_;
  from_rad_ = to_rad_;
  moves_at_s_ = now_s;
  arrives_s_ = now_s + random_.uniform(kSwiftest_s, kSlowest_s);
  chooses_s_ = arrives_s_ + (random_.chance(0.3) ? random_.uniform(0.0, 2.0) : 0.0);
  const double what = random_.uniform();
  if (resting_ || what < 0.2) {
    to_m_.setZero();  // in rate mode: the robot stands
    to_rad_.setZero();
  } else if (what < 0.5) {
    to_m_ = Vector3(reach_m_, 0.1 * reach_m_ * random_.normal(), 0.0);  // into the wall
    to_rad_.setZero();
  } else {
    to_m_ = anywhere(reach_m_);
    to_rad_ = random_.chance(0.5) ? anywhere(reach_rad_) : Vector3::Zero();
  }
}

HandTarget Person::step(double now_s, const MasterView& shown, OperatorRequests& requests) {
  if (now_s >= chooses_s_) choose(now_s);
  const double share = std::clamp((now_s - moves_at_s_) / (arrives_s_ - moves_at_s_), 0.0, 1.0);
  HandTarget target;
  target.grip = grip_;
  target.position_m = from_m_ + direction(share) * (to_m_ - from_m_);
  target.velocity_m_per_s = speed(share) / (arrives_s_ - moves_at_s_) * (to_m_ - from_m_);
  target.rotation_rad = from_rad_ + direction(share) * (to_rad_ - from_rad_);
  const bool engaged = shown.state == SafetyState::kEngaged;
  if (engaged) ask_s_ = now_s + kReaction_s;
  asked_ = !engaged && now_s >= ask_s_;
  if (asked_) {
    requests.engage = true;
    ask_s_ = now_s + (impatient_ ? kImpatience_s : timeout_s_);
  }
  return target;
}

}  // namespace longreach
