#include "master/input/remote_hand.hpp"

namespace longreach {

std::optional<HandTarget> RemoteHand::step(const RemoteHandInput& in, OperatorRequests& requests) {
  const bool silent = to_seconds(in.now - in.aim.said) > kHandAgeMax_s;
  fell_silent_ = false;
  const bool held = holds_;
  holds_ = in.aim.holds && !silent;
  if (holds_) {
    if (!held || in.aim.hand != hand_ || in.engagement != engagement_) take(in);
    requests.clutch = in.aim.clutch;
    if (in.aim.grip != gripped_) requests.grip = gripped_ = in.aim.grip;
    return lead(in);
  }
  if (held) {
    fell_silent_ = in.aim.holds;
    gone_ = fell_silent_ || !in.person;
    engagement_ = in.engagement;
  }
  gone_ = gone_ && in.engagement == engagement_;
  if (!gone_) return std::nullopt;
  HandTarget no_hand;
  no_hand.grip = Grip::kReleased;
  return no_hand;
}

void RemoteHand::take(const RemoteHandInput& in) {
  gone_ = false;
  hand_ = in.aim.hand;
  engagement_ = in.engagement;
  gripped_ = in.aim.grip;
  led_m_ = in.handle.p_MH;
  led_rad_ = log_rotation(in.handle.q_MH);
  from_m_ = led_m_ - in.aim.position_m;
  from_rad_ = led_rad_ - in.aim.rotation_rad;
}

HandTarget RemoteHand::lead(const RemoteHandInput& in) {
  const Vector3 step = clamp_norm(from_m_ + in.aim.position_m - led_m_, kSpeed_m_per_s * period_s_);
  led_m_ += step;
  led_rad_ += clamp_norm(from_rad_ + in.aim.rotation_rad - led_rad_, kSpeed_rad_per_s * period_s_);
  HandTarget target;
  target.position_m = led_m_;
  target.velocity_m_per_s = step / period_s_;
  target.rotation_rad = led_rad_;
  target.grip = in.grip;
  return target;
}

}  // namespace longreach
