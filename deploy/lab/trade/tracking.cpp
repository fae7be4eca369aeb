#include "deploy/lab/trade/tracking.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach {
namespace {

constexpr double kBegins_s = 6.0, kEnds_s = 36.0;
constexpr double kShift_s = 1e-3, kShiftMost_s = 0.6;
constexpr std::uint64_t kSeeds = 4;

proto::LabConfig configured(std::vector<std::string> settings) {
  const bool named =
      std::ranges::any_of(settings, [](const std::string& s) { return s.starts_with("profile="); });
  if (!named) settings.insert(settings.begin(), "profile=analog");
  return configure(settings, find_deploy_folder());
}

HandTarget hand_at(double t_s) {
  HandTarget target;
  const Vector3 w = 2.0 * std::numbers::pi * Vector3(0.11, 0.17, 0.23);
  for (int i = 0; i < 3; ++i) {
    target.position_m[i] = 0.012 * std::sin(w[i] * t_s);
    target.velocity_m_per_s[i] = 0.012 * w[i] * std::cos(w[i] * t_s);
  }
  return target;
}

struct Ways {
  std::vector<Vector3> goal_m, tool_m;  // one row per tick
};

/// Root of the mean square of tool(t) - goal(t - ticks).
double rms_m(const Ways& w, std::size_t from, std::size_t ticks) {
  double sum = 0.0;
  for (std::size_t i = from; i < w.tool_m.size(); ++i)
    sum += (w.tool_m[i] - w.goal_m[i - ticks]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(w.tool_m.size() - from));
}

double roughness(const Ways& w, std::size_t from, double dt) {
  const std::vector<Vector3>& p = w.tool_m;
  double sum = 0.0;
  for (std::size_t i = from; i < p.size(); ++i) sum += (p[i] - 2.0 * p[i - 1] + p[i - 2]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(p.size() - from)) / (dt * dt);
}

}  // namespace

Tracking track(const ExperimentRun& run, std::vector<std::string> settings) {
  settings.emplace_back("scene_file=scenes/free.txtpb");
  const proto::LabConfig config = configured(std::move(settings));
  const MasterConfig master = to_struct(config.master());
  const SlaveConfig slave = to_struct(config.slave());
  Laboratory lab(master, slave, run.seed);
  Ways ways;
  const auto began = std::chrono::steady_clock::now();
  while (lab.now_s() < kEnds_s) {
    lab.drive(hand_at(lab.now_s()));
    lab.step();
    ways.goal_m.push_back(lab.master().goal_m);
    ways.tool_m.push_back(lab.arm().true_pose().p - lab.slave().X_WE_anchor.p);
  }
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - began;
  const double dt = lab.period_s();
  const auto from = static_cast<std::size_t>(kBegins_s / dt);
  const auto link = static_cast<std::size_t>(std::llround(slave.link.impairment.delay_s / dt));
  Tracking t;
  t.error_rms_m = rms_m(ways, from, link);
  std::size_t best = link;
  t.bent_rms_m = t.error_rms_m;
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::round(kShift_s / dt)));
  for (std::size_t shift = link; shift < link + static_cast<std::size_t>(kShiftMost_s / dt);
       shift += stride) {
    if (const double e = rms_m(ways, from, shift); e < t.bent_rms_m) t.bent_rms_m = e, best = shift;
  }
  t.late_s = static_cast<double>(best - link) * dt;
  t.roughness_m_per_s2 = roughness(ways, from, dt);
  t.kbit_per_s = 8e-3 * lab.far_link().bytes_per_s;
  t.cost_us = spent.count() / (1e3 * kEnds_s);
  return t;
}

Touched touched(const ExperimentRun& run, std::vector<std::string> settings) {
  ExperimentRun one;
  one.config = configured(std::move(settings));
  Touched sum;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    one.seed = run.seed + seed;
    const std::vector<Metric> metrics = run_touch(one);
    if (!outcome_of(metrics).empty()) throw std::runtime_error("trade: the tool did not touch the wall");
    for (const Metric& m : metrics) {
      if (m.name == "displayed_stiffness_error") sum.stiffness_error = std::max(sum.stiffness_error, m.value);
      if (m.name == "haptic_return_bit_per_s") sum.return_bit_per_s += m.value / kSeeds;
    }
  }
  return sum;
}

}  // namespace longreach
