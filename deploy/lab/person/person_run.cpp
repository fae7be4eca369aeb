#include "deploy/lab/person/person_run.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kFront_m =
    5e-4;  // the goal is in front of a surface by more than what a surface's place may be off
constexpr double kMoved_m = 5e-4;  // motion that counts as a response of the tool
constexpr double kSettle_s = 1.0;
constexpr double kTurn_rad_per_s = 0.1;
constexpr double kFelt_n = 0.2;

/// Moves the hand according to the moves of the scenario.
class Walker {
 public:
  explicit Walker(const PersonScenario& s) : s_(s) {}

  /// Index of the present move, or std::nullopt after the last.
  [[nodiscard]] std::optional<std::size_t> move() const {
    return at_ < s_.moves.size() ? std::optional(at_) : std::nullopt;
  }
  HandTarget step(double dt) {
    const PersonMove& m = s_.moves[at_];
    const Vector3 left = m.to_m - hand_m_;
    const Vector3 step = clamp_norm(left, m.speed_m_per_s * dt);
    hand_m_ += step;
    const Vector3 to_turn = m.turn_rad - hand_rad_;
    hand_rad_ += clamp_norm(to_turn, kTurn_rad_per_s * dt);
    there_ = left.norm() < 1e-9 && to_turn.norm() < 1e-9;
    waited_s_ = there_ ? waited_s_ + dt : 0.0;
    HandTarget target;
    target.position_m = hand_m_;
    target.velocity_m_per_s = step / dt;
    target.rotation_rad = hand_rad_;
    target.grip = s_.grip;
    target.buttons.clutch = m.clutch;
    return target;
  }
  [[nodiscard]] bool rests() const { return there_ && waited_s_ > 0.5 * wait_s(); }
  /// Returns true if the next move begins.
  bool next() {
    if (!there_ || waited_s_ < wait_s()) return false;
    ++at_;
    there_ = false;
    waited_s_ = 0.0;
    return true;
  }

 private:
  [[nodiscard]] double wait_s() const { return s_.moves[at_].wait_s + s_.moves[at_].wait_rtt * s_.rtt_s; }
  const PersonScenario& s_;
  std::size_t at_ = 0;
  Vector3 hand_m_ = Vector3::Zero(), hand_rad_ = Vector3::Zero();
  bool there_ = false;
  double waited_s_ = 0.0;
};

/// Records the observations during one move.
class Observer {
 public:
  Observer(const Vector3& goal_m, const Vector3& tool_m, double given_j)
      : goal_m_(goal_m), tool_m_(tool_m), last_m_(goal_m) {
    seen_.given_j = given_j;
    seen_.tool_least_m = seen_.tool_most_m = tool_m;
  }
  /// `rests` is true in the second half of the wait.
  void look(const Laboratory& lab, const Vector3& tool_m, bool rests, double given_j) {
    const MasterView& m = lab.master();
    const double felt = m.spring_force_n.norm();
    if (felt <= 0.0) seen_.given_j = given_j;
    seen_.goal_step_m = std::max(seen_.goal_step_m, (m.goal_m - last_m_).norm());
    if (felt_n_) seen_.felt_step_n = std::max(seen_.felt_step_n, felt - *felt_n_);
    felt_n_ = felt;
    if (rests) {
      least_n_ = std::min(least_n_, felt);
      most_n_ = std::max(most_n_, felt);
      seen_.felt_swing_n = most_n_ - least_n_;
    }
    seen_.felt = m.spring_force_n;
    seen_.hand_m = lab.devices().delta().position_m();
    seen_.hand_n = m.F_H_M.force.norm();
    seen_.cut = seen_.cut || m.stiffness_clamped;
    const Vector3& v = lab.arm().true_velocity();
    if (v_) seen_.tool_m_per_s2 = std::max(seen_.tool_m_per_s2, (v - *v_).norm() / lab.period_s());
    v_ = v;
    last_m_ = m.goal_m;
    seen_.goal_m = m.goal_m;
    seen_.tool_m = tool_m;
    seen_.tool_least_m = seen_.tool_least_m.cwiseMin(tool_m);
    seen_.tool_most_m = seen_.tool_most_m.cwiseMax(tool_m);
    seen_.felt_n = felt;
    seen_.felt_max_n = std::max(seen_.felt_max_n, felt);
    seen_.tool_force_n = lab.arm().true_wrench().force;
    seen_.tool_n = seen_.tool_force_n.norm();
    seen_.tool_max_n = std::max(seen_.tool_max_n, seen_.tool_n);
    seen_.felt_nm = m.spring_moment_nm.norm();
    seen_.tool_nm = lab.arm().true_wrench().moment.norm();
    if (!began_s_) began_s_ = lab.now_s();
    if (seen_.felt_s < 0.0 && felt > kFelt_n) seen_.felt_s = lab.now_s() - *began_s_;
    seen_.lead_m = (m.goal_m - tool_m).norm();
    seen_.lead_max_m = std::max(seen_.lead_max_m, seen_.lead_m);
    seen_.hand_m_per_s = std::max(seen_.hand_m_per_s, lab.devices().delta().velocity_m_per_s().norm());
    seen_.engaged = m.state == SafetyState::kEngaged;
    seen_.holds = m.holds;
    if (!moved_s_ && (m.goal_m - goal_m_).norm() > kMoved_m) moved_s_ = lab.now_s();
    if (moved_s_ && seen_.answer_s < 0.0 && (tool_m - tool_m_).norm() > kMoved_m)
      seen_.answer_s = lab.now_s() - *moved_s_;
  }
  [[nodiscard]] const MoveSeen& seen() const { return seen_; }

 private:
  MoveSeen seen_{};
  Vector3 goal_m_, tool_m_, last_m_;
  std::optional<double> felt_n_{}, moved_s_{}, began_s_{};
  std::optional<Vector3> v_{};
  double least_n_ = 1e9, most_n_ = 0.0;
};

/// Whether tool and goal have been at rest in free space for so long that the hand can know it.
class FreeAir {
 public:
  explicit FreeAir(double rtt_s) : known_after_s_(rtt_s + 0.5) {}
  bool step(const Laboratory& lab, const Vector3& tool_m) {
    constexpr double kRests_m = 2e-4;
    const Vector3& goal_m = lab.master().goal_m;
    const Clamps& c = lab.slave().clamps;
    const bool at_limit = c.workspace || c.joint_position || c.unreachable || c.singularity;
    const bool moved = (goal_m - goal_m_).norm() > kRests_m || (tool_m - tool_m_).norm() > kRests_m;
    const bool touches = lab.arm().true_wrench().force.norm() > 0.0;
    if (touches || at_limit || moved) goal_m_ = goal_m, tool_m_ = tool_m, since_s_ = 0.0;
    since_s_ += lab.period_s();
    return since_s_ > known_after_s_;
  }

 private:
  double known_after_s_, since_s_ = 0.0;
  Vector3 goal_m_ = Vector3::Zero(), tool_m_ = Vector3::Zero();
};

/// A total loss of datagrams in both directions for some time.
class Blackout {
 public:
  explicit Blackout(const PersonScenario& s)
      : up_(s.slave.link.impairment), down_(s.master.link.impairment) {}
  void begin(Laboratory& lab, double seconds) {
    if (seconds <= 0.0) return;
    until_s_ = lab.now_s() + seconds;
    ImpairmentConfig up = up_, down = down_;
    up.loss = down.loss = 1.0;
    lab.impair_slave(up);
    lab.impair_master(down);
  }
  void step(Laboratory& lab) {
    if (!until_s_ || lab.now_s() < *until_s_) return;
    lab.impair_slave(up_);
    lab.impair_master(down_);
    until_s_.reset();
  }

 private:
  ImpairmentConfig up_, down_;
  std::optional<double> until_s_{};
};

/// Removes the position of the tool and the direction in which it is held back from the reports, and keeps
/// surfaces that are no longer reported.
class Blind : public FaultHooks {
 public:
  void after_slave_step(SlaveOutput& out) override {
    if (!out.report) return;
    for (ContactReport* contact : {&out.report->translation, &out.report->rotation}) {
      contact->place.setZero();
      contact->held_back.setZero();
    }
    ReportedSurface& first = out.report->translation.surfaces[0];
    if (first.touch == 0) {
      first = met_;
      first.pressed = false;
    }
    met_ = first;
  }

 private:
  ReportedSurface met_{};
};

void ask(Laboratory& lab, const PersonMove& move, MasterConfig& master) {
  OperatorRequests& requests = lab.requests();
  requests.mode = move.mode;
  requests.scale = move.scale;
  requests.stop = move.stop;
  requests.hold = move.hold;
  requests.engage = move.engage;
  requests.grip = move.load;
  lab.let_go(move.let_go);
  if (!move.change) return;
  move.change(master);
  lab.configure_master(master);
}

}  // namespace

PersonSeen run_person(const PersonScenario& s) {
  Laboratory lab(s.master, s.slave, s.seed);
  Blind blind;
  if (s.blind) {
    lab.set_fault_hooks(blind);
  } else if (s.hooks) {
    lab.set_fault_hooks(*s.hooks);
  }
  PersonSeen all;
  HandTarget rest;
  rest.grip = s.grip;
  lab.drive(rest);
  lab.requests().engage = true;
  const double started_s = 20.0 + 4.0 * s.rtt_s;
  double engaged_s = -1.0;
  while (lab.now_s() < started_s && (engaged_s < 0.0 || lab.now_s() < engaged_s + kSettle_s + s.rtt_s)) {
    lab.step();
    if (engaged_s < 0.0 && lab.master().state == SafetyState::kEngaged) engaged_s = lab.now_s();
  }
  const Vector3 anchor_m = lab.slave().X_WE_anchor.p;
  const auto tool = [&] { return Vector3(lab.arm().true_pose().p - anchor_m); };
  Walker walker(s);
  Blackout blackout(s);
  FreeAir free_air(s.rtt_s);
  MasterConfig master = s.master;
  Observer observer(lab.master().goal_m, tool(), 0.0);
  Vector3 goal_before = lab.master().goal_m;
  bool began = true;
  double given_j = 0.0;
  Vector3 hand_before = lab.devices().delta().position_m();
  while (const auto index = walker.move()) {
    const PersonMove& move = s.moves[*index];
    lab.drive(walker.step(lab.period_s()));
    if (began) {
      ask(lab, move, master);
      blackout.begin(lab, move.blackout_s);
    }
    began = false;
    blackout.step(lab);
    lab.step();
    const MasterView& m = lab.master();
    const Vector3& hand = lab.devices().delta().position_m();
    given_j += m.spring_force_n.dot(hand - hand_before);
    hand_before = hand;
    observer.look(lab, tool(), walker.rests(), given_j);
    all.goal_m_per_s = std::max(all.goal_m_per_s, (m.goal_m - goal_before).norm() / lab.period_s());
    goal_before = m.goal_m;
    const double felt_n = m.spring_force_n.norm(), depth_m = s.depth_m(m.goal_m);
    if (free_air.step(lab, tool())) all.free_n = std::max(all.free_n, felt_n);
    if (m.state == SafetyState::kEngaged && depth_m < -kFront_m) all.front_n = std::max(all.front_n, felt_n);
    all.energy_min_j = std::min(all.energy_min_j, m.port_energy_min_j);
    if (walker.next()) {
      all.move.push_back(observer.seen());
      observer = Observer(m.goal_m, tool(), given_j);
      began = true;
    }
  }
  return all;
}

}  // namespace longreach
