#include "tests/faults/guard_watch.hpp"

namespace longreach {
namespace {

constexpr std::array kClamps = {"tool speed",  "joint speed", "joint position", "workspace",
                                "force guard", "singularity", "unreachable",    "moment guard"};

std::string cause_name(const char* side, HoldCause cause) {
  return std::string(side) + ": " + std::string(text_of(cause).name);
}

}  // namespace

std::vector<std::string> guard_names() {
  std::vector<std::string> all;
  for (const HoldCause cause :
       {HoldCause::kOperator, HoldCause::kPeerHolds, HoldCause::kLinkSilent, HoldCause::kPeerRestarted,
        HoldCause::kRobotFault, HoldCause::kJointJumped, HoldCause::kJointOutside, HoldCause::kHandleReleased,
        HoldCause::kPreempted, HoldCause::kTrackingLost, HoldCause::kStalled, HoldCause::kOverrun,
        HoldCause::kDelayRose, HoldCause::kSensorFault, HoldCause::kSensorSign, HoldCause::kForcePersists,
        HoldCause::kSurfaceApproaching})
    all.push_back(cause_name("slave", cause));
  for (const HoldCause cause :
       {HoldCause::kOperator, HoldCause::kLinkSilent, HoldCause::kDelayRose, HoldCause::kDeviceFault,
        HoldCause::kHandleReleased, HoldCause::kHandleJumped, HoldCause::kHandleOutside})
    all.push_back(cause_name("master", cause));
  for (const char* clamp : kClamps) all.push_back(std::string("clamp: ") + clamp);
  for (std::size_t i = 0; i < kRejectionCount; ++i)
    if (static_cast<Rejection>(i) != Rejection::kDecode)  // takes the key of a session
      all.push_back("refused: " + std::string(to_string(static_cast<Rejection>(i))));
  for (const char* other : {"robot's own watchdog", "hand's force", "damping injected", "limits refused"})
    all.emplace_back(other);
  return all;
}

void GuardWatch::see(const World& world, const Moment& m) {
  if (m.report && m.cause != far_) {
    far_ = m.cause;
    if (far_ != HoldCause::kNone) ++acted_[cause_name("slave", far_)];
  }
  const MasterView& master = world.laboratory().master();
  if (master.cause != near_) {
    near_ = master.cause;
    if (near_ != HoldCause::kNone) ++acted_[cause_name("master", near_)];
  }
  if (m.telemetry) clamps(*m.telemetry);
  const auto rises = [this](bool& before, bool now, const char* name) {
    if (now && !before) ++acted_[name];
    before = now;
  };
  rises(watchdog_, world.laboratory().arm().watchdog_stopped(), "robot's own watchdog");
  rises(hand_, master.force_clamped, "hand's force");
  rises(injecting_, master.damping_injected, "damping injected");
}

void GuardWatch::clamps(const Telemetry& reported) {
  const Clamps& c = reported.clamps;
  const std::array now = {c.tool_speed,  c.joint_speed, c.joint_position, c.workspace,
                          c.force_guard, c.singularity, c.unreachable,    c.moment_guard};
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] && !clamped_[i]) ++acted_[std::string("clamp: ") + kClamps[i]];
    clamped_[i] = now[i];
  }
}

void GuardWatch::end(const World& world) {
  const Laboratory& lab = world.laboratory();
  for (const RejectionCounts& counts : {lab.slave_port().rejected(), lab.master_port().rejected()}) {
    for (std::size_t i = 0; i < kRejectionCount; ++i)
      if (counts[i] > 0) acted_["refused: " + std::string(to_string(static_cast<Rejection>(i)))] += counts[i];
  }
  if (world.refused_changes() > 0) acted_["limits refused"] += world.refused_changes();
}

}  // namespace longreach
