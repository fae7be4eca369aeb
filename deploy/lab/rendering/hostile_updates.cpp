// A million invalid or extreme stiffness reports at 1000 per second, half of which are lost by the link: does
// the rendering remain safe for the hand?

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/master_node.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

enum class Attack {
  kUniform,
  kLogUniform,
  kAlternating,
  kNotFinite,
  kNegative,
  kNotUnit,
  kDoubled,
  kFlipped,
  kPlaces,
  kRotating,
  kEverything,
  kCount
};
constexpr std::array<const char*, 11> kAttackNames = {"uniform",  "log_uniform", "alternating", "not_finite",
                                                      "negative", "not_unit",    "doubled",     "flipped",
                                                      "places",   "rotating",    "everything"};

struct AttackedHand {
  const char* name;
  Grip grip;
  std::uint32_t delay_samples;
};
constexpr std::array<AttackedHand, 4> kHands = {{{"light", Grip::kLight, 0},
                                                 {"firm", Grip::kFirm, 0},
                                                 {"released", Grip::kReleased, 0},
                                                 {"released_late", Grip::kReleased, 1}}};

constexpr double kLoss = 0.5;
constexpr int kHandshake_ticks = 50;
constexpr int kLatest_ticks = 20;  // jitter by which reports overtake each other

class Attacker {
 public:
  Attacker(Attack attack, Random random) : attack_(attack), random_(std::move(random)) {}

  ContactReport next(std::uint64_t newest_sequence, double unit) {
    ContactReport c;
    ReportedSurface& s = c.surfaces[0];
    s = {.normal = -Vector3::UnitX(),
         .touch_sequence = random_.uniform(1.0, static_cast<double>(newest_sequence) + 1.0),
         .touch = 1 + static_cast<std::uint32_t>(count_++ / 100),
         .pressed = !random_.chance(0.02)};
    strike(c);
    for (ReportedSurface& one : c.surfaces) one.stiffness *= unit;
    if (attack_ == Attack::kEverything && random_.chance(0.05))
      s.touch_sequence = random_.chance(0.5) ? std::nan("") : 1e300;
    return c;
  }

 private:
  Vector3 direction() {
    return Vector3(random_.normal(), random_.normal(), random_.normal()).stableNormalized();
  }
  double log_uniform() { return std::exp(random_.uniform(std::log(1.0), std::log(1e9))); }
  double not_finite() { return random_.chance(0.5) ? std::nan("") : std::numeric_limits<double>::infinity(); }

  void strike(ContactReport& c) {
    ReportedSurface &s = c.surfaces[0], &second = c.surfaces[1];
    s.stiffness = log_uniform();
    Attack attack = attack_;
    if (attack == Attack::kEverything)
      attack = static_cast<Attack>(random_.next() % static_cast<std::uint64_t>(Attack::kEverything));
    switch (attack) {
      case Attack::kUniform:
        s.stiffness = random_.uniform(0.0, 1e4);
        break;
      case Attack::kAlternating:
        s.stiffness = count_ % 2 == 0 ? 1e9 : 0.0;
        break;
      case Attack::kNotFinite: {
        double* const numbers[] = {&s.stiffness, &s.foot, &s.normal.x(), &s.normal.z(), &s.offset};
        if (random_.chance(0.5)) *numbers[random_.next() % std::size(numbers)] = not_finite();
        break;
      }
      case Attack::kNegative:
        (random_.chance(0.5) ? s.stiffness : s.foot) *= -1.0;
        if (random_.chance(0.5)) s.foot = -0.01 * random_.uniform();
        break;
      case Attack::kNotUnit:
        s.normal *= random_.chance(0.5) ? 0.0 : log_uniform();
        break;
      case Attack::kDoubled:
        second = s;
        second.touch += random_.chance(0.5) ? 1 : 0;
        break;
      case Attack::kFlipped:
        if (random_.chance(0.5)) s.normal = -s.normal;
        break;
      case Attack::kPlaces:
        s.foot = 0.05 * random_.uniform();
        if (random_.chance(0.5)) s.touch_sequence = 0.0, s.offset = 0.05 * random_.normal();
        break;
      case Attack::kRotating:
        s.normal = direction();
        second = s;
        second.normal = direction();
        ++second.touch;
        second.stiffness = log_uniform();
        break;
      case Attack::kLogUniform:
      case Attack::kEverything:
      case Attack::kCount:
        break;
    }
  }

  Attack attack_;
  Random random_;
  std::uint64_t count_ = 0;
};

struct Outcome {
  double energy_min_j = 0.0;
  double drawdown_j = 0.0;
  double force_step_excess_n = 0.0;  // excess of any force step over max(0.1 N, 5 %)
  double force_rise_excess_n = 0.0;  // excess of a step that increases the force
  double force_max_n = 0.0;
  double unsafe = 0.0;  // number of wrenches that were not finite or exceeded the limit
  double delivered = 0.0;
  double reports = 0.0;
  double rejected = 0.0;
};

void worsen(Outcome& all, const Outcome& one) {
  all.energy_min_j = std::min(all.energy_min_j, one.energy_min_j);
  all.drawdown_j = std::max(all.drawdown_j, one.drawdown_j);
  all.force_step_excess_n = std::max(all.force_step_excess_n, one.force_step_excess_n);
  all.force_rise_excess_n = std::max(all.force_rise_excess_n, one.force_rise_excess_n);
  all.force_max_n = std::max(all.force_max_n, one.force_max_n);
  all.unsafe += one.unsafe;
  all.delivered += one.delivered;
  all.reports += one.reports;
  all.rejected += one.rejected;
}

/// The person presses back and forth in all directions, in position mode and for some time in rate mode.
HandTarget motion(double t, Grip grip) {
  HandTarget target;
  target.position_m = {0.03 * std::sin(1.3 * t), 0.02 * std::sin(0.7 * t), 0.02 * std::sin(2.1 * t)};
  target.velocity_m_per_s = {0.039 * std::cos(1.3 * t), 0.014 * std::cos(0.7 * t), 0.042 * std::cos(2.1 * t)};
  target.rotation_rad = {0.3 * std::sin(1.1 * t), 0.2 * std::sin(0.9 * t), 0.2 * std::sin(1.7 * t)};
  target.grip = grip;
  return target;
}

/// One master with one hand under one attack.
class AttackRun {
 public:
  AttackRun(MasterConfig config, const AttackedHand& hand, Attack attack, const Random& random)
      : config_(prepared(std::move(config), hand)),
        hand_(hand),
        devices_(config_.device),
        node_(config_),
        attacker_(attack, random.child("attacker")),
        way_(random.child("way")),
        pending_(kLatest_ticks + 1) {
    node_.render_by(contact_law(config_.rendering.law));
  }

  Outcome run(int updates) {
    for (int i = 0; i < updates + kHandshake_ticks; ++i) tick(i);
    outcome_.energy_min_j = node_.view().port_energy_min_j;
    outcome_.drawdown_j = node_.view().energy_drawdown_j;
    outcome_.reports = static_cast<double>(node_.view().reports);
    outcome_.rejected = static_cast<double>(node_.view().rejected_values);
    return outcome_;
  }

 private:
  static MasterConfig prepared(MasterConfig config, const AttackedHand& hand) {
    config.device.delay_samples = hand.delay_samples;
    config.safety.engage_at_start = true;
    return config;
  }

  void tick(int i) {
    const Time now = Time{} + from_seconds(1e-3 * (i + 1));
    // A released handle can only be moved by the rendering; a hand places it first.
    const bool let_go = hand_.grip == Grip::kReleased && i % 4000 > 1500;
    devices_.set_target(motion(1e-3 * i, let_go ? Grip::kReleased : held_grip()));
    MasterInput in;
    in.now = now;
    in.handle = devices_.read(now);
    in.handle.held = true;  // a device that does not detect the hand: rendering continues
    in.last_heard = now;
    if (i % 20000 == 10000) in.requests.mode = MotionMode::kRate;
    if (i % 20000 == 12000) in.requests.mode = MotionMode::kPosition;
    std::vector<Received<StiffnessReport>>& due = pending_[static_cast<std::size_t>(i) % pending_.size()];
    in.reports = due;
    if (i > kHandshake_ticks) outcome_.delivered += static_cast<double>(due.size());
    const std::uint64_t reports = node_.view().reports;
    const MasterOutput out = node_.step(in);
    due.clear();
    devices_.write(out.F_H_M);
    if (out.command) newest_ = out.sequence;
    watch(out, node_.view().reports != reports);
    if (i >= kHandshake_ticks) {
      send(i);
    } else {  // a normal slave, before the attack
      pending_[static_cast<std::size_t>(i + 1) % pending_.size()].push_back(
          {.sequence = ++sequence_,
           .newest = true,
           .message = {.engagement = node_.view().engagement, .state = SafetyState::kEngaged}});
    }
  }

  [[nodiscard]] Grip held_grip() const { return hand_.grip == Grip::kReleased ? Grip::kLight : hand_.grip; }

  void send(int i) {
    StiffnessReport report{.engagement = node_.view().engagement, .state = SafetyState::kEngaged};
    report.translation = attacker_.next(newest_, 1.0);
    report.rotation = attacker_.next(newest_, 1e-3);
    ++sequence_;
    if (way_.chance(kLoss)) return;
    const std::size_t when = static_cast<std::size_t>(i) + 1 + way_.next() % (kLatest_ticks - 1);
    const bool newest = when >= latest_arrival_;
    latest_arrival_ = std::max(latest_arrival_, when);
    pending_[when % pending_.size()].push_back({.sequence = sequence_, .newest = newest, .message = report});
  }

  void watch(const MasterOutput& out, bool updated) {
    const double force_n = out.F_H_M.force.norm();
    if (!out.F_H_M.force.allFinite() || !out.F_H_M.moment.allFinite() ||
        force_n > config_.rendering.force_max_n + 1e-9 ||
        out.F_H_M.moment.norm() > config_.rendering.moment_max_nm + 1e-9)
      ++outcome_.unsafe;
    outcome_.force_max_n = std::max(outcome_.force_max_n, force_n);
    if (!updated) return;
    const double allowed_n = std::max(0.1, 0.05 * node_.view().spring_force_n.norm());
    const double step_n = node_.view().force_step_n;
    outcome_.force_step_excess_n = std::max(outcome_.force_step_excess_n, std::abs(step_n) - allowed_n);
    outcome_.force_rise_excess_n = std::max(outcome_.force_rise_excess_n, step_n - allowed_n);
  }

  MasterConfig config_;
  AttackedHand hand_;
  SimulatedDevices devices_;
  MasterNode node_;
  Attacker attacker_;
  Random way_;
  std::vector<std::vector<Received<StiffnessReport>>> pending_;  // ordered by the tick of arrival
  std::size_t latest_arrival_ = 0;
  std::uint64_t sequence_ = 0;
  std::uint64_t newest_ = 1;
  Outcome outcome_{};
};

}  // namespace

std::vector<Plot> hostile_updates_plots() {
  return {{.name = "hostile-updates",
           .csv = "attacks",
           .title = "Minimum port energy under hostile reports (11 attacks with each of 4 hands)",
           .x_column = "case",
           .x_label = "case",
           .panels = {{"STIFFNESS (mJ)",
                       {{"energy_min_j", "minimum energy", 1e3, true}, {"drawdown_j", "drawdown", 1e3, true}},
                       "set yrange [-1:1]"},
                      {"NAIVE (J)", {{"naive_energy_min_j", "minimum energy", 1.0, true}}, ""}}}};
}

std::vector<Metric> run_hostile_updates(const ExperimentRun& run) {
  constexpr int kUpdates = 1000000,
                kCases = static_cast<int>(Attack::kCount) * static_cast<int>(kHands.size());
  const MasterConfig config = to_struct(run.config.master());
  MasterConfig naive = config;
  naive.rendering.law = RenderingLaw::kNaive;
  const Random random(run.seed);
  Trace trace(run.out, "attacks",
              {"case", "energy_min_j", "drawdown_j", "force_rise_excess_n", "naive_energy_min_j"});
  Outcome ours, theirs;
  double naive_sum_j = 0.0;
  int n = 0;
  std::vector<Metric> metrics;
  for (int a = 0; a < static_cast<int>(Attack::kCount); ++a) {
    for (const AttackedHand& hand : kHands) {
      const Random stream = random.child(std::string(kAttackNames[static_cast<std::size_t>(a)]) + hand.name);
      const int updates = kUpdates / kCases;
      const Outcome one = AttackRun(config, hand, static_cast<Attack>(a), stream).run(updates);
      const Outcome other = AttackRun(naive, hand, static_cast<Attack>(a), stream).run(updates);
      worsen(ours, one);
      worsen(theirs, other);
      naive_sum_j += other.energy_min_j;
      trace.row({static_cast<double>(++n), one.energy_min_j, one.drawdown_j, one.force_rise_excess_n,
                 other.energy_min_j});
      if (run.progress) run.progress(static_cast<double>(n) / kCases);
    }
  }
  trace.close();
  return {{"updates", ours.delivered, ""},
          {"reports_applied", ours.reports, ""},
          {"reports_refused", ours.rejected, ""},
          {"port_energy_min_j", ours.energy_min_j, "J"},
          {"energy_drawdown_j", ours.drawdown_j, "J"},
          {"force_step_excess_n", ours.force_step_excess_n, "N"},
          {"force_rise_excess_n", ours.force_rise_excess_n, "N"},
          {"force_max_n", ours.force_max_n, "N"},
          {"unsafe_wrenches", ours.unsafe, ""},
          {"naive_force_step_excess_n", theirs.force_step_excess_n, "N"},
          {"naive_port_energy_min_j", theirs.energy_min_j, "J"},
          {"naive_port_energy_sum_j", naive_sum_j, "J"},
          {"naive_unsafe_wrenches", theirs.unsafe, ""}};
}

}  // namespace longreach
