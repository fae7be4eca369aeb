#include "slave/drivers/robot_adapter.hpp"

#include <algorithm>

#include "common/wire/codec.hpp"

namespace longreach {
namespace {

using adapter::RobotDatagram;
using adapter::SetpointDatagram;

static_assert(adapter::kJoints == kMaxJoints && adapter::kBodiesMost == kTrackedBodies);

Vector3 vector(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

RobotState RobotAdapter::read(Time now) {
  const bool fresh = port_.receive(now);
  take_bodies(now);
  measured_.ok = port_.ok();
  measured_.age_s = port_.age_s(now);
  if (!fresh || !measured_.ok) return measured_;
  const RobotDatagram& d = port_.newest();
  std::copy_n(d.joint_rad, kMaxJoints, measured_.joint_rad.data());
  std::copy_n(d.joint_rad_per_s, kMaxJoints, measured_.joint_rad_per_s.data());
  const Quaternion q_WE = kinematics_.forward(measured_.joint_rad).q;
  measured_.F_F_W = {q_WE * vector(d.moment_nm), q_WE * vector(d.force_n)};
  measured_.load = (d.flags & RobotDatagram::kLoad) != 0;
  return measured_;
}

void RobotAdapter::take_bodies(Time now) {
  bodies_ = {};
  const auto& sent = port_.newest_extra();
  if (!sent) return;
  for (std::uint32_t i = 0; i < sent->count; ++i) {
    const adapter::TrackedBody& one = sent->body[i];
    if (one.age_s < 0.0) continue;
    const double(&q)[4] = one.orientation;
    bodies_.body[i] = BodyPose{{vector(one.position_m), Quaternion(q[0], q[1], q[2], q[3]).normalized()},
                               std::min(one.age_s + port_.extra_age_s(now), kBodyAgeMaxS)};
  }
}

void RobotAdapter::write(const std::optional<JointVector>& joint_setpoint_rad) {
  SetpointDatagram out;
  const bool finite = joint_setpoint_rad && joint_setpoint_rad->allFinite();
  if (joint_setpoint_rad && !finite) ++rejected_;
  const bool moves = finite && measured_.ok;
  if (moves) {
    out.flags = SetpointDatagram::kMove;
    std::copy_n(joint_setpoint_rad->data(), kMaxJoints, out.joint_rad);
  }
  moved_ = moves ? std::min(moved_ + 1, kLong) : 0;
  if (grip_.value_or(measured_.load)) out.flags |= SetpointDatagram::kGrip;
  if (grip_) out.flags |= SetpointDatagram::kGripAsked;
  port_.send(out);
}

}  // namespace longreach
