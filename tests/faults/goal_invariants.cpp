// I31, I32, I37: the goal does not run away from a robot that stands, where nothing is nothing is felt, and the tool
// does not creep along a boundary.

#include <algorithm>
#include <deque>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

bool both_engaged(const Moment& m) {
  return m.claimed == SafetyState::kEngaged && m.shown == SafetyState::kEngaged && m.slave_ran &&
         m.master_ran;
}
/// Nothing has happened for so long by which goal and robot may be apart for a reason.
bool undisturbed(const Moment& m, double for_s) {
  for (const AffectedSignal what :
       {AffectedSignal::kJoints, AffectedSignal::kRobot, AffectedSignal::kSlaveTime,
        AffectedSignal::kMasterTime, AffectedSignal::kMaster, AffectedSignal::kSlave, AffectedSignal::kLease})
    if (m.since(what) < for_s) return false;
  return true;
}

/// While the tool stands the goal leads it by what it has moved within a round trip, and by little more. What
/// a fault of the link has held back may come for half a minute, and the playout is late by it.
class BoundedLead : public Invariant {
 public:
  explicit BoundedLead(const Scenario& s)
      : Invariant("I31", "the goal does not run away from a robot that stands"),
        news_s_(s.round_trip_s + 0.5),
        news_(static_cast<std::size_t>(news_s_ / 0.001)) {}
  void see(const Moment& m) override {
    const bool stands = both_engaged(m) && m.since(AffectedSignal::kLink) > kLate_s &&
                        undisturbed(m, kRecovers_s + news_s_) && m.engagement == engagement_ &&
                        (m.X_WE.p - stands_m_).norm() < kStands_m;
    engagement_ = m.engagement;
    if (!stands) {
      stands_m_ = m.X_WE.p;
      way_m_ = 0.0;
      ways_m_.clear();
    }
    way_m_ += ways_m_.empty() ? 0.0 : (m.goal_m - goal_m_).norm();
    goal_m_ = m.goal_m;
    ways_m_.push_back(way_m_);
    if (ways_m_.size() <= news_) return;
    ways_m_.pop_front();
    at_most(m, (m.anchor_m + m.goal_m - m.X_WE.p).norm(), kLead_m + way_m_ - ways_m_.front(),
            "m ahead of a robot that stands");
  }

 private:
  static constexpr double kStands_m = 1e-3, kRecovers_s = 2.0, kLate_s = 30.0;
  static constexpr double kLead_m = 5e-3 + kStands_m;

  double news_s_;
  std::size_t news_;  // ticks
  std::uint32_t engagement_ = 0;
  Vector3 stands_m_ = Vector3::Zero(), goal_m_ = Vector3::Zero();
  double way_m_ = 0.0;         // of the goal since the tool stands
  std::deque<double> ways_m_;  // likewise, in the past
};

/// In a scene of planes, which tells where nothing is. What was touched while the scene, the sensor or the
/// robot was not what it is may be remembered until the next engagement. The boundary of the motion is felt, too.
class FreeSpace : public Invariant {
 public:
  explicit FreeSpace(const Scenario& s)
      : Invariant("I32", "where nothing is nothing is felt"),
        start_m_(start_pose(s).p),
        surfaces_(s.slave.scene.surface),
        radius_m_(s.slave.scene.tool_radius_m),
        news_s_(s.round_trip_s + kDecays_s) {}
  void see(const Moment& m) override {
    for (const AffectedSignal what :
         {AffectedSignal::kScene, AffectedSignal::kSensor, AffectedSignal::kJoints, AffectedSignal::kRobot,
          AffectedSignal::kSlave, AffectedSignal::kMaster, AffectedSignal::kHandle})
      doubtful_ = doubtful_ || m.since(what) < kDecays_s;
    if (m.engagement != engagement_) doubtful_ = false;
    engagement_ = m.engagement;
    if (m.report && !forgotten(m)) remembered_s_ = m.t_s;
    was_faulty_ =
        (was_faulty_ && m.t_s - remembered_s_ < news_s_) || m.since(AffectedSignal::kSensor) < kDecays_s;
    if (m.report && !m.report->translation.held_back.isZero(0.0)) held_back_s_ = m.t_s;
    const bool boundary = m.t_s - held_back_s_ < news_s_;
    if (doubtful_ || was_faulty_ || boundary || !both_engaged(m) ||
        depth_m(m.anchor_m + m.goal_m) > -kPlace_m)
      return;
    at_most(m, m.contact_n, kNothing_n, "N where nothing is");
  }

 private:
  /// What a lie has made of surfaces is known till nothing is there, or till the sensor is found to lie.
  [[nodiscard]] static bool forgotten(const Moment& m) {
    if (m.cause == HoldCause::kSensorSign || m.cause == HoldCause::kSensorFault) return true;
    return std::ranges::none_of(m.report->translation.surfaces,
                                [](const ReportedSurface& s) { return s.touch > 0; });
  }
  static constexpr double kPlace_m = 1e-3;  // of a surface that was found
  static constexpr double kNothing_n = 0.2, kDecays_s = 1.0;

  /// Of the point behind the nearest plane; negative: in front of all.
  [[nodiscard]] double depth_m(const Vector3& p_W) const {
    double most = -1e9;
    for (const SurfaceConfig& surface : surfaces_) {
      if (!surface.plane) continue;
      const Vector3 point =
          surface.plane->point_m + (surface.plane->from_tool_start ? start_m_ : Vector3::Zero());
      most = std::max(most, radius_m_ + surface.plane->normal.normalized().dot(point - p_W));
    }
    return most;
  }

  Vector3 start_m_;
  std::vector<SurfaceConfig> surfaces_;
  double radius_m_, news_s_;
  double held_back_s_ = -1e9, remembered_s_ = -1e9;
  std::uint32_t engagement_ = 0;
  bool doubtful_ = false, was_faulty_ = false;
};

/// Handle at rest, no contact, and a limit reported that no singular pose is part of: the tool stands. In rate mode
/// only if the handle is pushed or turned, not both: each has its own line, and one may continue.
class StandsAtBoundary : public Invariant {
 public:
  explicit StandsAtBoundary(const Scenario& s)
      : Invariant("I37", "at the boundary of its motion the tool does not creep"),
        rate_(s.master.mapping.mode == MotionMode::kRate),
        news_s_(s.round_trip_s + 0.3) {}
  void see(const Moment& m) override {
    if (m.report) touches_ = m.report->translation.in_contact() || m.report->rotation.in_contact();
    if (m.telemetry) {
      const Clamps& c = m.telemetry->clamps;
      limited_ = (c.unreachable || c.joint_position) && !c.singularity && !c.workspace;
    }
    const bool rests =
        (m.x_MH - handle_.p).norm() < kRests_m && m.q_MH.angularDistance(handle_.q) < kRests_rad;
    if (!rests) {
      handle_ = {m.x_MH, m.q_MH};
      moved_s_ = m.t_s;
    }
    const bool alone = !rate_ || m.x_MH.norm() < kCentre_m || log_rotation(m.q_MH).norm() < kCentre_rad;
    const bool holds = both_engaged(m) && limited_ && alone && !touches_ && m.t_s - moved_s_ > news_s_ &&
                       m.since(AffectedSignal::kLink) > kRecovers_s + news_s_ &&
                       m.since(AffectedSignal::kScene) > kRecovers_s &&
                       m.since(AffectedSignal::kHandle) > kRecovers_s &&
                       undisturbed(m, kRecovers_s + news_s_);
    if (!holds) limited_s_ = m.t_s;
    if (m.t_s - limited_s_ <= kBrakes_s) {
      stands_ = m.X_WE;
      return;
    }
    at_most(m, (m.X_WE.p - stands_.p).norm(), kSide_m, "m along a boundary");
    at_most(m, m.X_WE.q.angularDistance(stands_.q), kSide_rad, "rad along a boundary");
  }

 private:
  static constexpr double kRests_m = 2e-3, kRests_rad = 0.02, kCentre_m = 1e-3, kCentre_rad = 0.01;
  static constexpr double kRecovers_s = 1.0, kBrakes_s = 0.3;
  static constexpr double kSide_m = 2e-3, kSide_rad = 10e-3;

  bool rate_;
  double news_s_;
  bool limited_ = false, touches_ = false;
  Pose handle_{}, stands_{};
  double moved_s_ = 0.0, limited_s_ = 0.0;
};

}  // namespace

void add_goal_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<BoundedLead>(s));
  all.push_back(std::make_unique<StandsAtBoundary>(s));
  const bool reported = std::ranges::all_of(
      s.slave.scene.surface, [](const SurfaceConfig& surface) { return surface.plane || surface.hinge; });
  if (reported) all.push_back(std::make_unique<FreeSpace>(s));
}

}  // namespace longreach
