// Figures 13 and 14 of Liu et al. 2019: deflection of the handle and speed of the robot over time in rate
// mode, first translation and then rotation, with the continuous and with the literal law. The same motion of
// the hand drives two loops.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kHand_s = 10.0;   // the hand deflects one device to either side
constexpr double kShown_s = 15.0;  // and the robot responds; then the other device
constexpr double kWait_s = 30.0;   // time limit for the engagement
constexpr double kReach_m = 0.04, kReach_rad = 0.5;
constexpr double kMean_s = 0.02;  // interval for measuring the speed of the tool

/// A coordinate, its speed, and the largest change of the speed in one sample.
struct Motion {
  double place = 0.0, speed = 0.0, step = 0.0;

  void sample(double now, double dt_s) {
    const double before = speed;
    speed = (now - place) / dt_s;
    place = now;
    step = std::max(step, std::abs(speed - before));
  }
};

/// One kind of motion along one axis: y, parallel to the wall that the scene may have.
struct Axis {
  double deflection = 0.0;  // of the handle
  Motion goal{}, tool{};
  double error = 0.0;  // of the goal's speed from the continuous law
  double creep = 0.0;  // largest speed of the goal inside the dead zone

  void sample_goal(double now, double dt_s, double dead_zone, double gain) {
    goal.sample(now, dt_s);
    const double beyond = std::abs(deflection) - dead_zone;
    error = std::max(error, std::abs(std::abs(goal.speed) - gain * std::max(0.0, beyond)));
    // With the literal law, motion ends 10 % inside the edge.
    if (beyond < -0.11 * dead_zone) creep = std::max(creep, std::abs(goal.speed));
  }
};

class RateLoop {
 public:
  RateLoop(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed)
      : config_(master.mapping), grip_(master.hand.grip), lab_(master, slave, seed) {
    while (lab_.now_s() < kWait_s && lab_.master().state != SafetyState::kEngaged) step(0.0, 0.0);
  }

  void step(double reach_m, double reach_rad) {
    lab_.drive({.position_m = {0.0, reach_m, 0.0}, .rotation_rad = {0.0, reach_rad, 0.0}, .grip = grip_});
    lab_.step();
    const MasterView& m = lab_.master();
    translation.deflection = m.p_MH.y();
    rotation.deflection = log_rotation(lab_.devices().spherical().orientation()).y();
    translation.sample_goal(m.goal_m.y(), lab_.period_s(), config_.dead_zone_m, config_.kv_per_s);
    rotation.sample_goal(m.goal_rad.y(), lab_.period_s(), config_.dead_zone_rad, config_.kv_rotation_per_s);
  }

  void sample_tool() {
    const SlaveView& s = lab_.slave();
    translation.tool.sample((s.X_WE.p - s.X_WE_anchor.p).y(), kMean_s);
    rotation.tool.sample(log_rotation(s.X_WE.q * s.X_WE_anchor.q.conjugate()).y(), kMean_s);
  }

  [[nodiscard]] double period_s() const { return lab_.period_s(); }

  Axis translation, rotation;

 private:
  MappingConfig config_;
  Grip grip_;
  Laboratory lab_;
};

MasterConfig rate_control(MasterConfig master, RateLaw law) {
  master.mapping.mode = MotionMode::kRate;
  master.mapping.rate_law = law;
  return master;
}

Plot rate_plot(const std::string& name, const std::string& title, const std::string& csv,
               const std::array<Panel, 3>& panels) {
  return {.name = name,
          .csv = csv,
          .title = title,
          .x_column = "t_s",
          .x_label = "time (s)",
          .panels = {panels.begin(), panels.end()}};
}

/// Both edges of the dead zone in one column of points.
double dotted(double edge, int row) {
  if (row % 5 != 0) return std::nan("");
  return row % 10 == 0 ? edge : -edge;
}

void add_metrics(std::vector<Metric>& metrics, const std::string& law, const Axis& axis, const char* unit,
                 const std::string& kind) {
  metrics.push_back({"speed_step_" + kind + law, axis.goal.step, unit});
  metrics.push_back({"speed_in_dead_zone_" + kind + law, axis.creep, unit});
  metrics.push_back({"law_error_" + kind + law, axis.error, unit});
  metrics.push_back({"tool_behind_goal_" + kind + law, std::abs(axis.tool.place - axis.goal.place),
                     kind == "translation_" ? "m" : "rad"});
}

}  // namespace

std::vector<Plot> rate_mapping_plots() {
  const auto speeds = [](const std::string& what, double factor) {
    return std::vector<Curve>{{what + "_literal", "literal law", factor},
                              {what + "_continuous", "continuous law", factor}};
  };
  return {rate_plot("rate-mapping", "Rate control of position: deflection and speeds", "translation",
                    {{{"handle (mm)",
                       {{"deflection_m", "deflection", 1e3}, {"dead_zone_edge_m", "dead zone", 1e3, true}},
                       "set pointsize 0.25"},
                      {"commanded (mm/s)", speeds("goal_m_per_s", 1e3), ""},
                      {"robot (mm/s)", speeds("tool_m_per_s", 1e3), ""}}}),
          rate_plot("rate-mapping-rotation", "Rate control of orientation: deflection and speeds", "rotation",
                    {{{"handle (rad)",
                       {{"deflection_rad", "deflection"}, {"dead_zone_edge_rad", "dead zone", 1.0, true}},
                       "set pointsize 0.25"},
                      {"commanded (rad/s)", speeds("goal_rad_per_s", 1.0), ""},
                      {"robot (rad/s)", speeds("tool_rad_per_s", 1.0), ""}}})};
}

std::vector<Metric> run_rate_mapping(const ExperimentRun& run) {
  const MasterConfig master = to_struct(run.config.master());
  const SlaveConfig slave = to_struct(run.config.slave());
  RateLoop continuous(rate_control(master, RateLaw::kContinuous), slave, run.seed);
  RateLoop literal(rate_control(master, RateLaw::kLiteral), slave, run.seed);
  Trace linear(run.out, "translation",
               {"t_s", "deflection_m", "dead_zone_edge_m", "goal_m_per_s_continuous", "goal_m_per_s_literal",
                "tool_m_per_s_continuous", "tool_m_per_s_literal"});
  Trace angular(run.out, "rotation",
                {"t_s", "deflection_rad", "dead_zone_edge_rad", "goal_rad_per_s_continuous",
                 "goal_rad_per_s_literal", "tool_rad_per_s_continuous", "tool_rad_per_s_literal"});
  const auto ticks = static_cast<int>(kShown_s / continuous.period_s());
  const int every = static_cast<int>(std::lround(kMean_s / continuous.period_s()));
  for (int i = 0; i < 2 * ticks; ++i) {
    const bool turns = i >= ticks;
    const double t = i % ticks * continuous.period_s();
    const double share = t < kHand_s ? std::sin(2.0 * std::numbers::pi * t / kHand_s) : 0.0;
    for (RateLoop* loop : {&continuous, &literal}) {
      loop->step(turns ? 0.0 : share * kReach_m, turns ? share * kReach_rad : 0.0);
      if (i % every == 0) loop->sample_tool();
    }
    if (i % every == 0) {
      const Axis& a = turns ? continuous.rotation : continuous.translation;
      const Axis& b = turns ? literal.rotation : literal.translation;
      const double edge = turns ? master.mapping.dead_zone_rad : master.mapping.dead_zone_m;
      (turns ? angular : linear)
          .row({t, a.deflection, dotted(edge, i / every), a.goal.speed, b.goal.speed, a.tool.speed,
                b.tool.speed});
    }
    if (run.progress && i % 500 == 0) run.progress(0.5 * i / ticks);
  }
  linear.close();
  angular.close();
  if (run.progress) run.progress(1.0);
  std::vector<Metric> metrics;
  add_metrics(metrics, "continuous", continuous.translation, "m/s", "translation_");
  add_metrics(metrics, "literal", literal.translation, "m/s", "translation_");
  add_metrics(metrics, "continuous", continuous.rotation, "rad/s", "rotation_");
  add_metrics(metrics, "literal", literal.rotation, "rad/s", "rotation_");
  return metrics;
}

}  // namespace longreach
