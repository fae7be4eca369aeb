#include "common/recording/recorded_values.hpp"

namespace longreach {

static_assert(sizeof(MotionCommand) == 72 && sizeof(ReportedSurface) == 64 && sizeof(ContactReport) == 256 &&
              sizeof(Reason) == 24 && sizeof(StiffnessReport) == 600);
static_assert(sizeof(ContactEstimate) == 104 && sizeof(Clamps) == 16 && sizeof(Telemetry) == 448);
static_assert(sizeof(Received<MotionCommand>) == 128);

void write(const Vector3& v, recording::Vector& out) {
  out.set_x(v.x());
  out.set_y(v.y());
  out.set_z(v.z());
}

void write(const Quaternion& q, recording::Quaternion& out) {
  out.set_x(q.x());
  out.set_y(q.y());
  out.set_z(q.z());
  out.set_w(q.w());
}

void write(const Pose& pose, recording::Pose& out) {
  write(pose.p, *out.mutable_position_m());
  write(pose.q, *out.mutable_orientation());
}

void write(const Wrench& wrench, recording::Wrench& out) {
  write(wrench.force, *out.mutable_force_n());
  write(wrench.moment, *out.mutable_moment_nm());
}

Vector3 read(const recording::Vector& in) { return {in.x(), in.y(), in.z()}; }
Quaternion read(const recording::Quaternion& in) { return {in.w(), in.x(), in.y(), in.z()}; }
Pose read(const recording::Pose& in) { return {read(in.position_m()), read(in.orientation())}; }
Wrench read(const recording::Wrench& in) { return {read(in.moment_nm()), read(in.force_n())}; }

namespace {

void write(const ReportedSurface& surface, recording::Surface& out) {
  longreach::write(surface.normal, *out.mutable_normal());
  out.set_stiffness(surface.stiffness);
  out.set_foot(surface.foot);
  out.set_touch_sequence(surface.touch_sequence);
  out.set_offset(surface.offset);
  out.set_touch(surface.touch);
  out.set_pressed(surface.pressed);
}

ReportedSurface read(const recording::Surface& in) {
  return {.normal = longreach::read(in.normal()),
          .stiffness = in.stiffness(),
          .foot = in.foot(),
          .touch_sequence = in.touch_sequence(),
          .offset = in.offset(),
          .touch = in.touch(),
          .pressed = in.pressed()};
}

void write(const ContactReport& contact, recording::ContactReport& out) {
  write(contact.surfaces[0], *out.mutable_first());
  write(contact.surfaces[1], *out.mutable_second());
  write(contact.surfaces[2], *out.mutable_third());
  longreach::write(contact.place, *out.mutable_place());
  longreach::write(contact.held_back, *out.mutable_held_back());
  out.set_threshold(contact.threshold);
  out.set_guard(contact.guard);
}

ContactReport read(const recording::ContactReport& in) {
  return {.surfaces = {read(in.first()), read(in.second()), read(in.third())},
          .place = longreach::read(in.place()),
          .held_back = longreach::read(in.held_back()),
          .threshold = in.threshold(),
          .guard = in.guard()};
}

}  // namespace

void write(const MotionCommand& command, recording::MotionCommand& out) {
  out.set_engagement(command.engagement);
  out.set_request(to_recorded<recording::Request>(command.request));
  out.set_mode(to_recorded<recording::Mode>(command.mode));
  out.set_scale(command.scale);
  if (command.grip) out.set_grip(*command.grip);
  out.set_let_go(command.let_go);
  out.set_goal_kind(to_recorded<recording::GoalKind>(command.goal_kind));
  write(command.position_m, *out.mutable_position_m());
  write(command.rotation_rad, *out.mutable_rotation_rad());
}

MotionCommand read(const recording::MotionCommand& in) {
  return {in.engagement(),
          read_enum(in.request(), Request::kLetGo),
          read_enum(in.mode(), MotionMode::kPosition),
          in.scale(),
          in.has_grip() ? std::optional(in.grip()) : std::nullopt,
          in.let_go(),
          read_enum(in.goal_kind(), GoalKind::kOrientation),
          read(in.position_m()),
          read(in.rotation_rad())};
}

void write(const Reason& reason, recording::Place& out) {
  out.set_joint(reason.joint);
  out.set_value(reason.value);
  out.set_limit(reason.limit);
}

namespace {

Reason read(recording::Cause cause, const recording::Place& place) {
  return {read_enum(cause, kLastCause), static_cast<int>(place.joint()), place.value(), place.limit()};
}

}  // namespace

void write(const StiffnessReport& report, recording::StiffnessReport& out) {
  out.set_engagement(report.engagement);
  out.set_state(to_recorded<recording::State>(report.state));
  out.set_cause(to_recorded<recording::Cause>(report.cause.cause));
  write(report.cause, *out.mutable_cause_place());
  out.set_refused(report.refused);
  out.set_refusal(to_recorded<recording::Cause>(report.refusal.cause));
  write(report.refusal, *out.mutable_refusal_place());
  write(report.translation, *out.mutable_translation());
  write(report.rotation, *out.mutable_rotation());
  out.set_reached_sequence(report.reached_sequence);
  out.set_gripper_closed(report.gripper_closed);
  out.set_load(report.load);
  out.set_approach_m_per_s(report.approach_m_per_s);
}

StiffnessReport read(const recording::StiffnessReport& in) {
  return {in.engagement(),
          read_enum(in.state(), SafetyState::kFault),
          read(in.cause(), in.cause_place()),
          read(in.translation()),
          read(in.rotation()),
          in.reached_sequence(),
          in.refused(),
          read(in.refusal(), in.refusal_place()),
          in.gripper_closed(),
          in.load(),
          in.approach_m_per_s()};
}

void write(const ContactEstimate& e, recording::ContactEstimate& out) {
  out.set_stiffness_n_per_m(e.stiffness_n_per_m);
  out.set_stiffness_sd_n_per_m(e.stiffness_sd_n_per_m);
  out.set_k(e.k);
  out.set_lambda(e.lambda);
  out.set_n(e.n);
  out.set_depth_m(e.depth_m);
  out.set_valid(e.valid);
  out.set_secant_n_per_m(e.secant_n_per_m);
  out.set_k_sd(e.k_sd);
  out.set_lambda_sd(e.lambda_sd);
  out.set_n_sd(e.n_sd);
  out.set_correlation(e.correlation);
  out.set_stiffness_verdict(to_recorded<recording::Verdict>(e.stiffness_verdict));
  out.set_k_verdict(to_recorded<recording::Verdict>(e.k_verdict));
  out.set_lambda_verdict(to_recorded<recording::Verdict>(e.lambda_verdict));
  out.set_n_verdict(to_recorded<recording::Verdict>(e.n_verdict));
}

ContactEstimate read(const recording::ContactEstimate& in) {
  ContactEstimate e;
  e.stiffness_n_per_m = in.stiffness_n_per_m();
  e.stiffness_sd_n_per_m = in.stiffness_sd_n_per_m();
  e.k = in.k();
  e.lambda = in.lambda();
  e.n = in.n();
  e.depth_m = in.depth_m();
  e.valid = in.valid();
  e.secant_n_per_m = in.secant_n_per_m();
  e.k_sd = in.k_sd();
  e.lambda_sd = in.lambda_sd();
  e.n_sd = in.n_sd();
  e.correlation = in.correlation();
  e.stiffness_verdict = read_enum(in.stiffness_verdict(), Verdict::kNoPowerLaw);
  e.k_verdict = read_enum(in.k_verdict(), Verdict::kNoPowerLaw);
  e.lambda_verdict = read_enum(in.lambda_verdict(), Verdict::kNoPowerLaw);
  e.n_verdict = read_enum(in.n_verdict(), Verdict::kNoPowerLaw);
  return e;
}

void write(const Clamps& c, recording::Clamps& out) {
  out.set_tool_speed(c.tool_speed);
  out.set_joint_speed(c.joint_speed);
  out.set_joint_position(c.joint_position);
  out.set_workspace(c.workspace);
  out.set_force_guard(c.force_guard);
  out.set_singularity(c.singularity);
  out.set_unreachable(c.unreachable);
  out.set_acceleration(c.acceleration);
  out.set_moment_guard(c.moment_guard);
  out.set_joint(c.joint);
}

Clamps read(const recording::Clamps& in) {
  return {in.tool_speed(),  in.joint_speed(), in.joint_position(), in.workspace(),    in.force_guard(),
          in.singularity(), in.unreachable(), in.acceleration(),   in.moment_guard(), in.joint()};
}

void write(const Telemetry& t, recording::Telemetry& out) {
  out.set_state(to_recorded<recording::State>(t.state));
  out.set_cause(to_recorded<recording::Cause>(t.cause));
  out.set_engagement(t.engagement);
  write(t.X_WE, *out.mutable_tool());
  write(t.X_WE_goal, *out.mutable_goal());
  write_joints(t.joint_rad, *out.mutable_joint_rad());
  write(t.F_E_W, *out.mutable_wrench());
  write(t.estimate, *out.mutable_estimate());
  out.set_penetration_m(t.penetration_m);
  write(t.clamps, *out.mutable_clamps());
  out.set_up_loss(t.up_loss);
  out.set_up_jitter_s(t.up_jitter_s);
  out.set_playout_delay_s(t.playout_delay_s);
  out.set_rejected(t.rejected);
  out.set_limit_violations(t.limit_violations);
  out.set_late_ticks(t.late_ticks);
  out.set_load(t.gripper.holds);
  out.set_gripper_closed(t.gripper.closed);
  out.set_load_kg(t.gripper.load_kg);
  out.set_load_sd_kg(t.gripper.load_sd_kg);
  out.set_reduced(t.reduced);
}

Telemetry read(const recording::Telemetry& in) {
  Telemetry t;
  t.state = read_enum(in.state(), SafetyState::kFault);
  t.cause = read_enum(in.cause(), kLastCause);
  t.engagement = in.engagement();
  t.X_WE = read(in.tool());
  t.X_WE_goal = read(in.goal());
  t.joint_rad = read_joints<std::array<double, kMaxJoints>>(in.joint_rad());
  t.F_E_W = read(in.wrench());
  t.estimate = read(in.estimate());
  t.penetration_m = in.penetration_m();
  t.clamps = read(in.clamps());
  t.up_loss = in.up_loss();
  t.up_jitter_s = in.up_jitter_s();
  t.playout_delay_s = in.playout_delay_s();
  t.rejected = in.rejected();
  t.limit_violations = in.limit_violations();
  t.late_ticks = in.late_ticks();
  t.gripper = {in.gripper_closed(), in.load(), in.load_kg(), in.load_sd_kg()};
  t.reduced = in.reduced();
  return t;
}

void write(const Received<StiffnessReport>& received, recording::ReceivedReport& out) {
  write_receipt(received, *out.mutable_receipt());
  write(received.message, *out.mutable_report());
}
void write(const Received<Telemetry>& received, recording::ReceivedTelemetry& out) {
  write_receipt(received, *out.mutable_receipt());
  write(received.message, *out.mutable_telemetry());
}
void write(const Received<MotionCommand>& received, recording::ReceivedCommand& out) {
  write_receipt(received, *out.mutable_receipt());
  write(received.message, *out.mutable_command());
}

Received<StiffnessReport> read(const recording::ReceivedReport& in) {
  return read_receipt(in.receipt(), read(in.report()));
}
Received<Telemetry> read(const recording::ReceivedTelemetry& in) {
  return read_receipt(in.receipt(), read(in.telemetry()));
}
Received<MotionCommand> read(const recording::ReceivedCommand& in) {
  return read_receipt(in.receipt(), read(in.command()));
}

}  // namespace longreach
