#include "tests/faults/sabotage.hpp"

namespace longreach {

void Saboteur::tell(RobotState& told) const {
  if (what_ == Sabotage::kForceUnfelt) told.F_F_W = {};
}

void Saboteur::before_ghost(SlaveInput& input) {
  constexpr std::uint64_t kAfter = 2000;  // ticks
  if (++ticks_ < kAfter || what_ != Sabotage::kForgeriesTaken || input.commands.empty()) return;
  commands_.assign(input.commands.begin(), input.commands.end());
  commands_.back().message.position_m.x() += 0.01;
  input.commands = commands_;
}

void Saboteur::ask(SlaveInput& input) {
  switch (what_) {
    case Sabotage::kSilenceUnnoticed:
      if (input.last_heard) input.last_heard = input.now;
      break;
    case Sabotage::kStopUnheard:
      input.stop = false;
      break;
    case Sabotage::kRequestsUnheard:
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

void Saboteur::answer(SlaveOutput& out) {
  if (what_ == Sabotage::kSetpointsShake && out.joint_setpoint_rad)
    (*out.joint_setpoint_rad)[0] += ticks_ % 2 == 0 ? 1e-3 : -1e-3;
  if (what_ == Sabotage::kPictureFrozen && out.telemetry) {
    if (!first_) first_ = out.telemetry->X_WE;
    out.telemetry->X_WE = *first_;
  }
  if (what_ == Sabotage::kCauseWrong && out.report && out.report->state == SafetyState::kHolding)
    out.report->cause = HoldCause::kTaken;
  if (what_ == Sabotage::kRefusalUnreported && out.report) out.report->refused = 0;
  if (what_ == Sabotage::kContactUnreported && out.report)
    out.report->translation = out.report->rotation = {};
  constexpr double kEarly = 100.0;  // commands
  if (what_ != Sabotage::kTouchedEarly || !out.report) return;
  ContactReport& contact = out.report->translation;
  ReportedSurface& surface = contact.surfaces[0];
  if (surface.pressed && surface.touch_sequence > kEarly) {
    surface.touch_sequence -= kEarly;
    touched_ = contact;
  } else if (touched_) {
    contact = *touched_;
  }
}

void Saboteur::answer(MasterOutput& out) const {
  if (what_ == Sabotage::kHandPushed) out.F_H_M.force *= 10.0;
}

}  // namespace longreach
