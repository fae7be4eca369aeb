#include "tests/faults/injected_defect.hpp"

namespace longreach {

void DefectInjector::apply(RobotState& reported) {
  if (what_ != InjectedDefect::kForceNotRendered) return;
  constexpr double kNoise = 0.05, kNoise_nm = 0.005;
  for (Eigen::Index i = 0; i < 3; ++i) {
    reported.F_F_W.force[i] = kNoise * noise_.normal();
    reported.F_F_W.moment[i] = kNoise_nm * noise_.normal();
  }
}

void DefectInjector::before_sent_log(SlaveInput& input) {
  constexpr std::uint64_t kAfter = 2000;  // ticks
  if (++ticks_ < kAfter || what_ != InjectedDefect::kForgeriesTaken || input.commands.empty()) return;
  commands_.assign(input.commands.begin(), input.commands.end());
  commands_.back().message.position_m.x() += 0.01;
  input.commands = commands_;
}

void DefectInjector::ask(SlaveInput& input) {
  switch (what_) {
    case InjectedDefect::kSilenceUnnoticed:
      if (input.last_heard) input.last_heard = input.now;
      break;
    case InjectedDefect::kStopNotReceived:
      input.stop = false;
      break;
    case InjectedDefect::kTakenNotReceived:
      input.taken = false;
      break;
    case InjectedDefect::kLatenessUnreported:
      input.late_ticks = 0;
      break;
    case InjectedDefect::kLossUnreported:
      input.up_loss = 0.0;
      break;
    case InjectedDefect::kRequestsNotReceived:
      commands_.assign(input.commands.begin(), input.commands.end());
      for (Received<MotionCommand>& c : commands_) {
        if (c.message.engagement > 0) c.message.request = Request::kEngage;
      }
      input.commands = commands_;
      break;
    default:
      break;
  }
}

void DefectInjector::answer(SlaveOutput& out) {
  if (what_ == InjectedDefect::kSetpointsShake && out.joint_setpoint_rad)
    (*out.joint_setpoint_rad)[0] += ticks_ % 2 == 0 ? 1e-3 : -1e-3;
  if (what_ == InjectedDefect::kPictureFrozen && out.telemetry) {
    if (!first_) first_ = out.telemetry->X_WE;
    out.telemetry->X_WE = *first_;
  }
  if (what_ == InjectedDefect::kCauseWrong && out.report && out.report->state == SafetyState::kHolding)
    out.report->cause = HoldCause::kPreempted;
  if (what_ == InjectedDefect::kRefusalUnreported && out.report) out.report->refused = 0;
  if (what_ == InjectedDefect::kContactUnreported && out.report)
    out.report->translation = out.report->rotation = {};
  constexpr double kEarly = 100.0;  // commands
  if (what_ != InjectedDefect::kTouchedEarly || !out.report) return;
  ContactReport& contact = out.report->translation;
  ReportedSurface& surface = contact.surfaces[0];
  if (surface.pressed && surface.touch_sequence > kEarly) {
    surface.touch_sequence -= kEarly;
    touched_ = contact;
  } else if (touched_) {
    contact = *touched_;
  }
}

void DefectInjector::answer(MasterOutput& out) const {
  if (what_ == InjectedDefect::kHandPushed) out.F_H_M.force *= 10.0;
}

}  // namespace longreach
