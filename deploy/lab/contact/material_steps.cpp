// The material changes while the tool is in contact: the tool slides from a soft tile of the scene
// `materials` onto a hard one and back, and presses through the layers of the scene `layers`. For each
// estimator, measures the time and the motion of the tool until the reported stiffness is that of the new
// material, and the steps of the force at the hand.
//
// A change occurs when the true tangent stiffness at the tool differs by more than 20 % from that at the
// previous change. It counts if it lasts for 2 s or until it is followed, that is, until the reported
// stiffness is within 20 % of the true one. People hardly feel smaller differences.

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {
namespace {

constexpr double kFollowed = 0.2;
constexpr double kNearM = 0.01;    // distance from the start to the surface
constexpr double kRowS = 0.01;     // interval between the rows of the trace
constexpr double kSteadyS = 0.1;   // minimum duration of a true stiffness; shorter ones are transitions
constexpr double kLastingS = 2.0;  // shorter changes need not be followed
constexpr std::size_t kKinds = std::size(kEstimatorKinds);

/// A motion to a position at a constant speed, then a rest.
struct Leg {
  Vector3 to_m;
  double speed_m_per_s;
  double rest_s;
};

struct Change {
  double at_s = 0.0;
  Vector3 at_m = Vector3::Zero();
  double true_n_per_m = 0.0;
  std::optional<double> followed_s{};
  double followed_m = 0.0;  // distance that the tool has moved by then
};

struct Row {
  double t_s, beside_m, depth_m, tool_n, hand_n, true_n_per_m, reported_n_per_m, rendered_n_per_m;
};

struct Outcome {
  std::vector<Change> changes;
  std::vector<Row> rows;
  double force_step_excess_n = 0.0, force_rise_excess_n = 0.0;  // beyond max(0.1 N, 5 %)
  double port_energy_min_j = 0.0;
  double error_end = 1.0;
};

class Run {
 public:
  Run(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed) : lab_(master, slave, seed) {}

  Outcome go(const std::vector<Leg>& legs) {
    while (lab_.master().state != SafetyState::kEngaged && lab_.now_s() < 30.0) tick();
    rest(1.0);
    for (const Leg& leg : legs) {
      const Vector3 from = hand_.position_m, way = leg.to_m - from;
      const double seconds = way.norm() / leg.speed_m_per_s;
      hand_.velocity_m_per_s = way / std::max(seconds, lab_.period_s());
      for (double t = 0.0; t < seconds; t += lab_.period_s()) {
        hand_.position_m = from + way * std::min(t / seconds, 1.0);
        tick();
      }
      hand_.velocity_m_per_s.setZero();
      rest(leg.rest_s);
    }
    outcome_.port_energy_min_j = lab_.master().port_energy_min_j;
    return outcome_;
  }

 private:
  void rest(double seconds) {
    for (double t = 0.0; t < seconds; t += lab_.period_s()) tick();
  }

  /// The person keeps to the path by leaning against the felt force.
  void tick() {
    constexpr double kLeans_s = 0.2;
    const Vector3 against_m = -lab_.master().spring_force_n / hand_model(hand_.grip).stiffness_n_per_m;
    lean_m_ += lab_.period_s() / kLeans_s * (against_m - lean_m_);
    HandTarget target = hand_;
    target.position_m += lean_m_;
    lab_.drive(target);
    lab_.step();
    watch_stiffness();
    watch_force();
    if (++ticks_ % static_cast<std::uint64_t>(std::lround(kRowS / lab_.period_s())) != 0) return;
    const MasterView& m = lab_.master();
    outcome_.rows.push_back({lab_.now_s(), lab_.arm().true_pose().p.y() - start_m_.y(),
                             lab_.arm().true_penetration_m(), lab_.arm().true_wrench().force.norm(),
                             m.spring_force_n.norm(), here_n_per_m_, lab_.slave().reported_stiffness_n_per_m,
                             m.stiffness_n_per_m});
  }

  void watch_stiffness() {
    const Vector3 tool_m = lab_.arm().true_pose().p;
    const double here = lab_.arm().material_stiffness(tool_m);
    const bool steady = here > 0.0 && std::abs(here - here_n_per_m_) < 1e-3 * here;
    here_n_per_m_ = here;
    steady_s_ = steady ? steady_s_ + lab_.period_s() : 0.0;
    std::vector<Change>& changes = outcome_.changes;
    const auto other = [&] {
      return changes.empty() || std::abs(here / changes.back().true_n_per_m - 1.0) > kFollowed;
    };
    if (steady_s_ > kSteadyS && other()) {
      const bool passed = !changes.empty() && !changes.back().followed_s &&
                          lab_.now_s() - steady_s_ - changes.back().at_s < kLastingS;
      if (passed) changes.pop_back();
      if (other()) changes.push_back({lab_.now_s() - steady_s_, tool_m, here});
    }
    const double reported = lab_.slave().reported_stiffness_n_per_m;
    if (changes.empty() || here <= 0.0) return;
    outcome_.error_end = std::abs(reported / here - 1.0);
    Change& c = changes.back();
    if (c.followed_s || std::abs(reported / c.true_n_per_m - 1.0) > kFollowed) return;
    c.followed_s = lab_.now_s() - c.at_s;
    c.followed_m = (tool_m - c.at_m).norm();
  }

  void watch_force() {
    const MasterView& m = lab_.master();
    if (m.reports == reports_) return;
    reports_ = m.reports;
    const double step_n = m.force_step_n;
    const double bound_n = std::max(0.1, 0.05 * m.spring_force_n.norm());
    outcome_.force_step_excess_n = std::max(outcome_.force_step_excess_n, std::abs(step_n) - bound_n);
    outcome_.force_rise_excess_n = std::max(outcome_.force_rise_excess_n, step_n - bound_n);
  }

  Laboratory lab_;
  HandTarget hand_{.grip = Grip::kFirm};
  Vector3 start_m_ = lab_.arm().true_pose().p;
  Vector3 lean_m_ = Vector3::Zero();
  Outcome outcome_;
  double here_n_per_m_ = 0.0, steady_s_ = 0.0;
  std::uint64_t reports_ = 0;
  std::uint64_t ticks_ = 0;
};

MasterConfig in_position(MasterConfig master) {
  master.safety.engage_at_start = true;
  master.mapping.mode = MotionMode::kPosition;
  master.mapping.scale = 1.0;
  return master;
}

/// The scene of a file, translated by `by_m`.
SceneConfig scene_of(const ExperimentRun& run, const std::string& name, const Vector3& by_m) {
  proto::SlaveConfig slave = run.config.slave();
  slave.clear_scene();
  slave.set_scene_file("scenes/" + name + ".txtpb");
  resolve_files(slave, find_deploy_folder());
  SceneConfig scene = to_struct(slave).scene;
  for (SurfaceConfig& s : scene.surface) {
    if (s.plane) s.plane->point_m += by_m;
    if (s.box) s.box->centre_m += by_m;
  }
  return scene;
}

std::string metric_name(EstimatorKind kind) {
  std::string name(name_of(kind));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void tell(const std::string& name, const Outcome& o, std::vector<Metric>& metrics) {
  double slowest_s = 0.0, farthest_m = 0.0, followed = 0.0;
  for (const Change& c : o.changes) {
    slowest_s = std::max(slowest_s, c.followed_s.value_or(0.0));
    farthest_m = std::max(farthest_m, c.followed_m);
    followed += c.followed_s ? 1.0 : 0.0;
  }
  metrics.push_back({name + "_changes", static_cast<double>(o.changes.size()), ""});
  metrics.push_back({name + "_followed", followed, ""});
  metrics.push_back({name + "_slowest_s", slowest_s, "s"});
  metrics.push_back({name + "_farthest_m", farthest_m, "m"});
  metrics.push_back({name + "_error_end", o.error_end, ""});
  metrics.push_back({name + "_force_step_excess_n", o.force_step_excess_n, "N"});
  metrics.push_back({name + "_force_rise_excess_n", o.force_rise_excess_n, "N"});
  metrics.push_back({name + "_port_energy_min_j", o.port_energy_min_j, "J"});
}

void write(const ExperimentRun& run, const std::string& name, const std::vector<Outcome>& outcomes) {
  Trace trace(run.out, name,
              {"t_s", "beside_m", "depth_m", "tool_force_n", "hand_force_n", "true_n_per_m",
               "rendered_n_per_m", "fixed_exponent_n_per_m", "maximum_likelihood_n_per_m"});
  std::size_t rows = outcomes.front().rows.size();
  for (const Outcome& o : outcomes) rows = std::min(rows, o.rows.size());
  const Outcome& first = outcomes.front();
  const auto positive = [](double value) { return value > 0.0 ? value : std::nan(""); };
  for (std::size_t i = 0; i < rows; ++i) {
    const Row& r = first.rows[i];
    const auto reported = [&](std::size_t kind) { return positive(outcomes[kind].rows[i].reported_n_per_m); };
    trace.row({r.t_s, r.beside_m, r.depth_m, r.tool_n, r.hand_n, positive(r.true_n_per_m),
               positive(r.rendered_n_per_m), reported(0), reported(1)});
  }
  trace.close();
}

// Force, path and true stiffness are those of the run with the first estimator, because the motion of the
// hand depends on the felt force.
Plot plot_of(const std::string& name, const std::string& title, const Panel& place) {
  return {.name = name,
          .csv = name,
          .title = title,
          .x_column = "t_s",
          .x_label = "time (s)",
          .panels = {{"stiffness (N/mm)",
                      {{"true_n_per_m", "true (fixed exponent)", 1e-3},
                       {"fixed_exponent_n_per_m", "fixed exponent", 1e-3},
                       {"maximum_likelihood_n_per_m", "maximum likelihood", 1e-3}},
                      "set logscale y"},
                     {"force (N)", {{"tool_force_n", "tool"}, {"hand_force_n", "hand"}}, "unset logscale y"},
                     place}};
}

}  // namespace

std::vector<Plot> material_steps_plots() {
  const Panel way{"path (mm)", {{"beside_m", "along", 1e3}, {"depth_m", "inwards", 1e3}}, "unset logscale y"};
  const Panel depth{"depth (mm)", {{"depth_m", "tool", 1e3}}, "unset logscale y"};
  return {plot_of("layers", "Pressing through layers of 0.3, 1.3 and 11.3 N/mm", depth),
          plot_of("soft_to_hard", "Sliding from a tile of 1 N/mm onto one of 10 N/mm", way),
          plot_of("hard_to_soft", "Sliding from a tile of 10 N/mm onto one of 1 N/mm, then pressing", way)};
}

std::vector<Metric> run_material_steps(const ExperimentRun& run) {
  struct Case {
    std::string name, scene;
    Vector3 by_m;
    std::vector<Leg> legs;
  };
  // Layers: presses into each one in turn. Tiles of 1 and 10 N/mm: starts 10 mm from the other tile and
  // slides onto it.
  const std::vector<Case> cases = {
      {"layers",
       "layers",
       {kNearM - 0.105, 0.0, 0.0},
       {{{kNearM + 0.003, 0.0, 0.0}, 0.004, 3.0},
        {{kNearM + 0.009, 0.0, 0.0}, 0.002, 3.0},
        {{kNearM + 0.038, 0.0, 0.0}, 0.004, 8.0}}},
      {"soft_to_hard",
       "materials",
       {kNearM - 0.105, 0.03, 0.04},
       {{{kNearM + 0.002, 0.0, 0.0}, 0.004, 3.0}, {{kNearM + 0.002, 0.022, 0.0}, 0.005, 4.0}}},
      {"hard_to_soft",
       "materials",
       {kNearM - 0.105, 0.01, 0.04},
       {{{kNearM + 0.001, 0.0, 0.0}, 0.004, 4.0},
        {{kNearM + 0.002, -0.022, 0.0}, 0.005, 2.0},
        {{kNearM + 0.008, -0.022, 0.0}, 0.004, 6.0}}}};
  const MasterConfig master = in_position(to_struct(run.config.master()));
  std::vector<Metric> metrics;
  double done = 0.0;
  for (const Case& c : cases) {
    SlaveConfig slave = to_struct(run.config.slave());
    slave.scene = scene_of(run, c.scene, c.by_m);
    std::vector<Outcome> outcomes;
    for (const EstimatorKind kind : kEstimatorKinds) {
      slave.estimator.kind = kind;
      outcomes.push_back(Run(master, slave, run.seed).go(c.legs));
      tell(c.name + "_" + metric_name(kind), outcomes.back(), metrics);
      done += 1.0 / static_cast<double>(kKinds * cases.size());
      if (run.progress) run.progress(done);
    }
    if (!run.out.empty()) write(run, c.name, outcomes);
  }
  return metrics;
}

}  // namespace longreach
