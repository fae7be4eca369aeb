#include "common/wire/values.hpp"

#include <algorithm>
#include <cmath>

#include "common/wire/codec.hpp"

namespace longreach {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;
using Floats = google::protobuf::RepeatedField<float>;

constexpr double kEstimateMax = 1e30;  // keeps a float finite
constexpr double kPlaceMax = 1e9;      // of a cause
constexpr double kThresholdMax = 1e6;  // of a force, N, or moment, N m, that is detected or guarded
constexpr float kLoadMaxKg = 1e9F;
constexpr double kAccelerationMax = 1e6;  // m/s² or rad/s²
constexpr double kSequenceMax = 9e15;     // below 2^53: a fractional sequence still has its fraction's halves
constexpr double kScaleRounding = 1e-9;   // steps of 0.05 do not add up exactly
constexpr double kUnitTolerance = 1e-6;   // of a quaternion's norm

bool within(double value, double low, double high) { return value >= low && value <= high; }  // false for NaN

template <class Field>
bool all_within(const Field& values, double limit) {
  bool all = true;  // looks at every one: quicker than to stop at the first that is not
  for (const auto v : values) all = all & (std::abs(static_cast<double>(v)) <= limit);
  return all;
}

template <class Enum>
bool read_enum(std::uint32_t value, Enum& out) {
  out = static_cast<Enum>(value);
  return value < static_cast<std::uint32_t>(kCountOf<Enum>);
}

std::uint32_t number_of(HoldCause cause) { return static_cast<std::uint32_t>(cause); }

/// Where it is; of a cause without a place nothing.
void write(const Reason& reason, Floats& place) {
  place.Clear();
  if (reason.joint == 0 && reason.limit == 0.0 && reason.value == 0.0) return;
  place.Add(static_cast<float>(reason.joint));
  for (const double x : {reason.value, reason.limit})
    place.Add(static_cast<float>(std::clamp(x, -kPlaceMax, kPlaceMax)));
}

/// A cause with its place, or without one.
bool read(std::uint32_t cause, const Floats& place, Reason& out) {
  out = Reason{};
  if (!read_enum(cause, out.cause)) return false;
  if (place.empty()) return true;
  if (place.size() != 3 || !all_within(place, kPlaceMax)) return false;
  const auto joint = static_cast<double>(place.Get(0));
  if (!within(joint, 0.0, kMaxJoints) || joint != std::floor(joint)) return false;
  out = {out.cause, static_cast<int>(joint), static_cast<double>(place.Get(1)),
         static_cast<double>(place.Get(2))};
  return true;
}

template <class Field>
Vector3 to_vector(const Field& values) {
  return {static_cast<double>(values.Get(0)), static_cast<double>(values.Get(1)),
          static_cast<double>(values.Get(2))};
}

/// Three numbers, each of at most `limit`; none: zero.
template <class Field>
bool read_vector(const Field& values, double limit, Vector3& out) {
  out.setZero();
  if (values.empty()) return true;
  if (values.size() != 3 || !all_within(values, limit)) return false;
  out = to_vector(values);
  return true;
}

bool is_direction(const Vector3& v) { return std::abs(v.norm() - 1.0) < kUnitTolerance; }

/// A unit vector; none: zero.
bool read_direction(const Doubles& values, Vector3& out) {
  return read_vector(values, 1.0 + kUnitTolerance, out) && (values.empty() || is_direction(out));
}

template <class Field, class Vector>
void assign(const Vector& values, Field& out) {
  out.Clear();
  for (const double v : values) out.Add(static_cast<typename Field::value_type>(v));
}

/// Takes no bytes where it is zero.
void assign_unless_zero(const Vector3& values, Doubles& out) {
  out.Clear();
  if (!values.isZero(0.0)) assign(values, out);
}

using Touches = google::protobuf::RepeatedField<std::uint32_t>;

constexpr std::uint32_t kPressed = 1, kOlder = 2, kTouch = 4;  // in the integer of a surface

void write(const ContactReport& contact, Floats& lines, Doubles& places, Touches& touches) {
  lines.Clear();
  places.Clear();
  touches.Clear();
  for (const ReportedSurface& s : contact.surfaces) {
    if (s.touch == 0) continue;
    const bool older = s.touch_sequence == 0.0;
    for (const double v : {s.normal.x(), s.normal.y(), s.normal.z(), s.stiffness, s.foot})
      lines.Add(static_cast<float>(v));
    places.Add(older ? s.offset : s.touch_sequence);
    touches.Add(s.touch * kTouch + (older ? kOlder : 0) + (s.pressed ? kPressed : 0));
  }
}

/// `line` of one surface; `far`: the greatest length that is possible.
bool read(const float* line, double place, std::uint32_t touch, double far, ReportedSurface& out) {
  out = {.normal = {static_cast<double>(line[0]), static_cast<double>(line[1]), static_cast<double>(line[2])},
         .stiffness = static_cast<double>(line[3]),
         .foot = static_cast<double>(line[4]),
         .touch = touch / kTouch,
         .pressed = (touch & kPressed) != 0};
  const bool older = (touch & kOlder) != 0;
  (older ? out.offset : out.touch_sequence) = place;
  if (!is_direction(out.normal)) return false;
  out.normal.normalize();
  return out.touch > 0 && within(out.stiffness, 0.0, kStiffnessMaxNPerM) && within(out.foot, 0.0, far) &&
         (older ? within(place, -far, far) : within(place, 0.0, kSequenceMax));
}

bool read(const Floats& lines, const Doubles& places, const Touches& touches, double far,
          ContactReport& out) {
  out.surfaces = {};
  const int count = touches.size();
  if (count > static_cast<int>(kSurfaces) || lines.size() != kLineNumbers * count || places.size() != count)
    return false;
  for (int i = 0; i < count; ++i) {
    ReportedSurface& surface = out.surfaces[static_cast<std::size_t>(i)];
    if (!read(lines.data() + kLineNumbers * i, places[i], touches[i], far, surface)) return false;
  }
  return true;
}

void write(const Pose& pose, proto::PoseXyzw& out) {
  assign(pose.p, *out.mutable_position_m());
  assign(pose.q.coeffs(), *out.mutable_quaternion());
}

bool read(const proto::PoseXyzw& in, Pose& out) {
  if (in.position_m_size() != 3 || in.quaternion_size() != 4) return false;
  if (!all_within(in.position_m(), 1e9) || !all_within(in.quaternion(), 1.0 + kUnitTolerance)) return false;
  const auto& q = in.quaternion();
  out = {to_vector(in.position_m()), Quaternion(q[3], q[0], q[1], q[2])};
  if (!within(out.q.norm(), 1.0 - kUnitTolerance, 1.0 + kUnitTolerance)) return false;
  out.q.normalize();
  return true;
}

constexpr unsigned kJointBit = 9;
constexpr std::uint32_t kLowerBit = 1u << 12;

std::uint32_t to_bits(const Clamps& c) {
  const bool flags[] = {c.tool_speed,  c.joint_speed, c.joint_position, c.workspace,   c.force_guard,
                        c.singularity, c.unreachable, c.acceleration,   c.moment_guard};
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < std::size(flags); ++i) bits |= static_cast<std::uint32_t>(flags[i]) << i;
  return bits | static_cast<std::uint32_t>(std::abs(c.joint)) << kJointBit | (c.joint < 0 ? kLowerBit : 0);
}

bool read(std::uint32_t bits, Clamps& out) {
  const auto bit = [bits](int i) { return ((bits >> i) & 1u) != 0; };
  out = {bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6), bit(7), bit(8)};
  const int joint = static_cast<int>((bits & ~kLowerBit) >> kJointBit);
  out.joint = (bits & kLowerBit) != 0 ? -joint : joint;
  return joint <= kMaxJoints;
}

// An estimator that knows nothing yet may have an infinite variance: that is "not valid", not a damaged
// datagram.
ContactEstimate sendable(const ContactEstimate& e) {
  const bool finite = std::isfinite(e.stiffness_n_per_m) && std::isfinite(e.stiffness_sd_n_per_m) &&
                      std::isfinite(e.k) && std::isfinite(e.lambda) && std::isfinite(e.n) &&
                      std::isfinite(e.depth_m);
  return e.valid && finite ? e : ContactEstimate{};
}

float finite_float(double value) {
  return static_cast<float>(std::clamp(value, -kEstimateMax, kEstimateMax));
}

void write(const ContactEstimate& e, proto::Telemetry& out) {
  out.set_stiffness_n_per_m(e.stiffness_n_per_m);
  out.set_stiffness_sd_n_per_m(finite_float(e.stiffness_sd_n_per_m));
  out.set_k(finite_float(e.k));
  out.set_lambda(finite_float(e.lambda));
  out.set_n(finite_float(e.n));
  out.set_depth_m(finite_float(e.depth_m));
  out.set_estimate_valid(e.valid);
  out.clear_estimate_sd();
  out.set_verdicts(0);
  if (!e.valid) return;
  for (const double sd : {e.k_sd, e.lambda_sd, e.n_sd}) out.add_estimate_sd(finite_float(sd));
  out.add_estimate_sd(finite_float(e.correlation));
  std::uint32_t verdicts = 0;
  for (const Verdict v : {e.n_verdict, e.lambda_verdict, e.k_verdict, e.stiffness_verdict}) {
    verdicts = verdicts << 2 | static_cast<std::uint32_t>(v);
  }
  out.set_verdicts(verdicts);
}

bool read(const proto::Telemetry& in, ContactEstimate& e) {
  e = {};
  e.stiffness_n_per_m = in.stiffness_n_per_m();
  e.stiffness_sd_n_per_m = static_cast<double>(in.stiffness_sd_n_per_m());
  e.k = static_cast<double>(in.k());
  e.lambda = static_cast<double>(in.lambda());
  e.n = static_cast<double>(in.n());
  e.depth_m = static_cast<double>(in.depth_m());
  e.valid = in.estimate_valid();
  for (const double v : {e.stiffness_n_per_m, e.stiffness_sd_n_per_m, e.k, e.lambda, e.n, e.depth_m}) {
    if (!std::isfinite(v)) return false;
  }
  if (!e.valid) return true;
  const auto& sd = in.estimate_sd();
  if (sd.size() != 4 || !all_within(sd, 2.0 * kEstimateMax)) return false;
  e.secant_n_per_m = e.n != 0.0 ? e.stiffness_n_per_m / e.n : 0.0;
  e.k_sd = static_cast<double>(sd[0]);
  e.lambda_sd = static_cast<double>(sd[1]);
  e.n_sd = static_cast<double>(sd[2]);
  e.correlation = static_cast<double>(sd[3]);
  std::uint32_t bits = in.verdicts();
  for (Verdict* v : {&e.stiffness_verdict, &e.k_verdict, &e.lambda_verdict, &e.n_verdict}) {
    if (!read_enum(bits & 3u, *v)) return false;
    bits >>= 2;
  }
  return bits == 0;
}

bool link_figures_possible(const proto::Telemetry& in) {
  return within(static_cast<double>(in.penetration_m()), -1e9, 1e9) && within(in.up_loss(), 0.0, 1.0) &&
         within(in.up_jitter_s(), 0.0, 1e9) && within(in.playout_delay_s(), 0.0, 1e9);
}

}  // namespace

void write(const MotionCommand& command, proto::MotionCommand& out) {
  out.set_engagement(command.engagement);
  out.set_request(static_cast<std::uint32_t>(command.request));
  out.set_mode(static_cast<std::uint32_t>(command.mode));
  out.set_scale(command.scale);
  out.clear_grip();
  if (command.grip) out.set_grip(*command.grip);
  out.set_let_go(command.let_go);
  out.mutable_position_m()->Clear();
  out.mutable_rotation_rad()->Clear();
  if (command.goal_kind == GoalKind::kGoalPosition) {
    assign(command.position_m, *out.mutable_position_m());
  } else {
    assign(command.rotation_rad, *out.mutable_rotation_rad());
  }
}

bool read(const proto::MotionCommand& in, MotionCommand& out) {
  if (!read_enum(in.request(), out.request)) return false;
  if (!read_enum(in.mode(), out.mode)) return false;
  if (!within(in.scale(), kScaleMin - kScaleRounding, kScaleMax + kScaleRounding)) return false;
  out.engagement = in.engagement();
  out.scale = std::clamp(in.scale(), kScaleMin, kScaleMax);
  out.grip = in.has_grip() ? std::optional(in.grip()) : std::nullopt;
  out.let_go = in.let_go();
  out.goal_kind = in.rotation_rad().empty() ? GoalKind::kGoalPosition : GoalKind::kGoalOrientation;
  if (in.position_m().empty() == in.rotation_rad().empty()) return false;  // neither or both
  return read_vector(in.position_m(), kGoalMaxM, out.position_m) &&
         read_vector(in.rotation_rad(), kGoalMaxRad, out.rotation_rad);
}

void write(const StiffnessReport& report, proto::StiffnessReport& out) {
  out.set_engagement(report.engagement);
  out.set_state(static_cast<std::uint32_t>(report.state));
  out.set_cause(number_of(report.cause));
  write(report.cause, *out.mutable_cause_place());
  out.set_refused(report.refused);
  out.set_refusal(number_of(report.refusal));
  write(report.refusal, *out.mutable_refusal_place());
  out.set_reached_sequence(report.reached_sequence);
  out.set_gripper_closed(report.gripper_closed);
  out.set_load(report.load);
  out.set_approach_m_per_s(static_cast<float>(report.approach_m_per_s));
  out.set_touch_n(static_cast<float>(report.translation.threshold));
  out.set_touch_nm(static_cast<float>(report.rotation.threshold));
  out.set_guard_n(static_cast<float>(report.translation.guard));
  out.set_guard_nm(static_cast<float>(report.rotation.guard));
  write(report.translation, *out.mutable_translation_lines(), *out.mutable_translation_places(),
        *out.mutable_translation_touches());
  write(report.rotation, *out.mutable_rotation_lines(), *out.mutable_rotation_places(),
        *out.mutable_rotation_touches());
  assign_unless_zero(report.translation.place, *out.mutable_translation_tool_m());
  assign_unless_zero(report.translation.held_back, *out.mutable_translation_held_back());
  assign_unless_zero(report.rotation.place, *out.mutable_rotation_tool_rad());
  assign_unless_zero(report.rotation.held_back, *out.mutable_rotation_held_back());
}

bool read(const proto::StiffnessReport& in, StiffnessReport& out) {
  out.engagement = in.engagement();
  out.reached_sequence = in.reached_sequence();
  out.gripper_closed = in.gripper_closed();
  out.load = in.load();
  out.approach_m_per_s = static_cast<double>(in.approach_m_per_s());
  out.translation.threshold = static_cast<double>(in.touch_n());
  out.rotation.threshold = static_cast<double>(in.touch_nm());
  out.translation.guard = static_cast<double>(in.guard_n());
  out.rotation.guard = static_cast<double>(in.guard_nm());
  out.refused = in.refused();
  return within(out.approach_m_per_s, 0.0, kGoalMaxM) &&
         within(out.translation.threshold, 0.0, kThresholdMax) &&
         within(out.rotation.threshold, 0.0, kThresholdMax) &&
         within(out.translation.guard, 0.0, kThresholdMax) &&
         within(out.rotation.guard, 0.0, kThresholdMax) && read_enum(in.state(), out.state) &&
         read(in.cause(), in.cause_place(), out.cause) &&
         read(in.refusal(), in.refusal_place(), out.refusal) &&
         read(in.translation_lines(), in.translation_places(), in.translation_touches(), kGoalMaxM,
              out.translation) &&
         read(in.rotation_lines(), in.rotation_places(), in.rotation_touches(), kGoalMaxRad, out.rotation) &&
         read_vector(in.translation_tool_m(), kGoalMaxM, out.translation.place) &&
         read_vector(in.rotation_tool_rad(), kGoalMaxRad, out.rotation.place) &&
         read_direction(in.translation_held_back(), out.translation.held_back) &&
         read_direction(in.rotation_held_back(), out.rotation.held_back);
}

void write(const Telemetry& telemetry, proto::Telemetry& out) {
  out.set_state(static_cast<std::uint32_t>(telemetry.state));
  out.set_cause(number_of(telemetry.cause));
  out.set_engagement(telemetry.engagement);
  write(telemetry.X_WE, *out.mutable_tool());
  write(telemetry.X_WE_goal, *out.mutable_goal());
  assign(telemetry.joint_rad, *out.mutable_joint_rad());
  assign(telemetry.F_E_W.force, *out.mutable_force_n());
  assign(telemetry.F_E_W.moment, *out.mutable_moment_nm());
  write(sendable(telemetry.estimate), out);
  out.set_penetration_m(static_cast<float>(telemetry.penetration_m));
  out.set_clamps(to_bits(telemetry.clamps));
  out.set_up_loss(static_cast<float>(telemetry.up_loss));
  out.set_up_jitter_s(static_cast<float>(telemetry.up_jitter_s));
  out.set_playout_delay_s(static_cast<float>(telemetry.playout_delay_s));
  out.set_rejected(telemetry.rejected);
  out.set_limit_violations(telemetry.limit_violations);
  out.set_late_ticks(telemetry.late_ticks);
  out.set_load(telemetry.gripper.holds);
  out.set_gripper_closed(telemetry.gripper.closed);
  out.set_load_kg(static_cast<float>(telemetry.gripper.load_kg));
  out.set_load_sd_kg(static_cast<float>(telemetry.gripper.load_sd_kg));
  out.set_reduced(telemetry.reduced);
  out.set_load_acceleration_m_per_s2(static_cast<float>(telemetry.load_acceleration_m_per_s2));
  out.set_load_acceleration_rad_per_s2(static_cast<float>(telemetry.load_acceleration_rad_per_s2));
}

bool read(const proto::Telemetry& in, Telemetry& out) {
  const bool possible = read_enum(in.state(), out.state) && read_enum(in.cause(), out.cause) &&
                        read(in.tool(), out.X_WE) && read(in.goal(), out.X_WE_goal) &&
                        read(in, out.estimate) && read(in.clamps(), out.clamps) && link_figures_possible(in);
  if (!possible) return false;
  if (!(in.load_kg() >= 0.0F && in.load_kg() < kLoadMaxKg) ||
      !(in.load_sd_kg() >= 0.0F && in.load_sd_kg() < kLoadMaxKg) ||
      !within(static_cast<double>(in.load_acceleration_m_per_s2()), 0.0, kAccelerationMax) ||
      !within(static_cast<double>(in.load_acceleration_rad_per_s2()), 0.0, kAccelerationMax))
    return false;
  if (in.joint_rad_size() != kMaxJoints || in.force_n_size() != 3 || in.moment_nm_size() != 3) return false;
  if (!all_within(in.joint_rad(), 1e9) || !all_within(in.force_n(), 1e12) ||
      !all_within(in.moment_nm(), 1e12)) {
    return false;
  }
  out.engagement = in.engagement();
  std::copy(in.joint_rad().begin(), in.joint_rad().end(), out.joint_rad.begin());
  out.F_E_W = {to_vector(in.moment_nm()), to_vector(in.force_n())};
  out.penetration_m = static_cast<double>(in.penetration_m());
  out.up_loss = static_cast<double>(in.up_loss());
  out.up_jitter_s = static_cast<double>(in.up_jitter_s());
  out.playout_delay_s = static_cast<double>(in.playout_delay_s());
  out.rejected = in.rejected();
  out.limit_violations = in.limit_violations();
  out.late_ticks = in.late_ticks();
  out.gripper = {.holds = in.load(),
                 .closed = in.gripper_closed(),
                 .load_kg = static_cast<double>(in.load_kg()),
                 .load_sd_kg = static_cast<double>(in.load_sd_kg())};
  out.reduced = in.reduced();
  out.load_acceleration_m_per_s2 = static_cast<double>(in.load_acceleration_m_per_s2());
  out.load_acceleration_rad_per_s2 = static_cast<double>(in.load_acceleration_rad_per_s2());
  return true;
}

}  // namespace longreach
