#include "master/devices/handle_behaviour.hpp"

#include <algorithm>

namespace longreach {

Vector3 HandleSprings::idle(const Coordinates& at, bool held, const Gains& gains, IdleRule rule,
                            double dt_s) {
  if (held) {
    left_ = false;
    return Vector3::Zero();
  }
  if (!left_) anchor_ = at.x;
  left_ = true;
  const double before_j = 0.5 * gains.home * (at.x - anchor_).squaredNorm();
  if (rule == IdleRule::kHome) anchor_ -= clamp_norm(anchor_, gains.speed * dt_s);
  const double after_j = 0.5 * gains.home * (at.x - anchor_).squaredNorm();
  supplied_j_ = after_j - before_j;
  energy_j_ += after_j;
  return -gains.home * (at.x - anchor_) - gains.damping * at.rate;
}

Vector3 HandleSprings::guide(const Vector3& x, const Gains& gains, HandleMotion motion) {
  if (motion == HandleMotion::kCoupled || x.norm() < gains.free) {
    axis_ = -1;
    return Vector3::Zero();
  }
  if (axis_ < 0) {
    x.cwiseAbs().maxCoeff(&axis_);
    off_ = x;
    off_[axis_] = 0.0;
  }
  Vector3 away = x - off_;
  away[axis_] = 0.0;
  energy_j_ += 0.5 * gains.guide * away.squaredNorm();
  return -gains.guide * away;
}

Vector3 HandleSprings::step(const Coordinates& at, bool held, const Gains& gains,
                            const BehaviourConfig& config, double dt_s) {
  energy_j_ = supplied_j_ = 0.0;
  Vector3 force = idle(at, held, gains, config.idle, dt_s) + guide(at.x, gains, config.motion);
  const double r = norm(at.x), over = r - gains.stop_radius;
  at_stop_ = over >= 0.0;
  if (over > 0.0 && r > 0.0) {
    force -= gains.stop * over / r * at.x;
    energy_j_ += 0.5 * gains.stop * over * over;
  }
  return force;
}

HandleBehaviour::HandleBehaviour(const DeviceConfig& config) { configure(config); }

void HandleBehaviour::configure(const DeviceConfig& config) {
  const BehaviourConfig& b = config_ = config.behaviour;
  turns_ = config.turns;
  linear_ = {.home = b.home_n_per_m,
             .damping = b.home_n_s_per_m,
             .speed = b.home_speed_m_per_s,
             .guide = b.guide_n_per_m,
             .free = b.free_m,
             .stop = b.stop_n_per_m,
             .stop_radius = b.stop_share * config.delta.workspace_m};
  angular_ = {.home = b.home_nm_per_rad,
              .damping = b.home_nm_s_per_rad,
              .speed = b.home_speed_rad_per_s,
              .guide = b.guide_nm_per_rad,
              .free = b.free_rad,
              .stop = b.stop_nm_per_rad,
              .stop_radius = b.stop_share * config.spherical.workspace_rad};
}

Wrench HandleBehaviour::step(const HandleState& handle, double dt_s) {
  Wrench F;
  if (handle.p_MH.allFinite() && handle.velocity_m_per_s.allFinite())
    F.force = translation_.step({handle.p_MH, handle.velocity_m_per_s}, handle.held, linear_, config_, dt_s);
  if (turns_ && handle.q_MH.coeffs().allFinite() && handle.angular_rad_per_s.allFinite())
    F.moment = rotation_.step({log_rotation(handle.q_MH), handle.angular_rad_per_s}, handle.held, angular_,
                              config_, dt_s);
  return F;
}

}  // namespace longreach
