// Forward kinematics of the two haptic devices.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "deploy/lab/devices/delta_catalog.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"
#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach {
namespace {

/// The methods of `fk-network`, which describes them.
std::vector<TradePoint> measure_spherical(const ExperimentRun& run) {
  constexpr std::pair<const char*, const char*> kWays[] = {{"tracking", "tracking"},
                                                           {"newton_step", "one_newton_step"},
                                                           {"newton_two_steps", "two_newton_steps"},
                                                           {"network", "network"},
                                                           {"network_newton", "network_and_step"},
                                                           {"all_solutions", "all_solutions"}};
  ExperimentRun inner = run;
  inner.out.clear();
  inner.progress = nullptr;
  std::map<std::string, double> value;
  for (const Metric& m : run_fk_network(inner)) value[m.name] = m.value;
  std::vector<TradePoint> points;
  for (const auto& [way, series] : kWays) {
    const std::string name = way;
    points.push_back({series, "", value.at(name + "_ns"), value.at(name + "_error_max_rad")});
    points.back().standard = name == "tracking";
  }
  return points;
}

constexpr int kTicks = 4000, kCounted = 32;

/// The handle on a path through its workspace at 1 kHz, up to 0.4 m/s.
struct DeltaMotion {
  std::vector<Vector3> p_m, theta_rad;
};

DeltaMotion delta_motion(const DeltaKinematics& k, const Vector3& home_m) {
  DeltaMotion m;
  for (int i = 0; i < kTicks; ++i) {
    const double t = 2.0 * std::numbers::pi * 1e-3 * i;
    m.p_m.push_back(home_m +
                    0.05 * Vector3(std::sin(0.71 * t), std::cos(0.53 * t), 0.6 * std::sin(0.37 * t)));
    m.theta_rad.push_back(k.inverse(m.p_m.back()).theta_rad);
  }
  return m;
}

Vector3 newton(const DeltaKinematics& k, const Vector3& theta_rad, Vector3 p_m, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Vector3 at_rad = k.inverse(p_m).theta_rad;
    p_m += jacobian(velocity(k.geometry(), at_rad, p_m)).m_per_rad * (theta_rad - at_rad);
  }
  return p_m;
}

std::vector<TradePoint> measure_delta(const ExperimentRun&) {
  const DeltaDesign design = omega_like();
  const DeltaKinematics k(design.geometry);
  const DeltaMotion m = delta_motion(k, design.home_m);
  std::vector<TradePoint> points{{"closed_form", "", 0.0, 0.0, NAN, true}};
  for (const int steps : {1, 2, 3}) points.push_back({"newton_steps", std::to_string(steps)});
  for (std::size_t way = 0; way < points.size(); ++way) {
    Vector3 p = m.p_m.front();
    const auto call = [&](int i) {
      const Vector3& theta = m.theta_rad[static_cast<std::size_t>(i)];
      p = way == 0 ? k.forward(theta, DeltaAssembly::kNegative, p).p_m
                   : newton(k, theta, p, static_cast<int>(way));
    };
    for (int i = 0; i < kTicks; ++i) {
      call(i);
      points[way].error = std::max(points[way].error, (p - m.p_m[static_cast<std::size_t>(i)]).norm());
    }
    p = m.p_m.front();
    points[way].cost = cost_ns(kTicks, call);
    p = m.p_m.front();
    points[way].instructions = instructions(kCounted, call);
  }
  return points;
}

}  // namespace

TradeStage trade_spherical_forward() {
  return {.name = "spherical_forward",
          .title = "Orientation of the 3-RRR device from its motor angles",
          .cost = "time per call",
          .cost_unit = "ns",
          .error = "maximum error",
          .error_unit = "rad",
          .series = {"tracking", "one_newton_step", "two_newton_steps", "network", "network_and_step",
                     "all_solutions"},
          .measure = measure_spherical};
}

TradeStage trade_delta_forward() {
  return {.name = "delta_forward",
          .title = "Position of the DELTA from its motor angles, tracked from tick to tick",
          .cost = "time per call",
          .cost_unit = "ns",
          .error = "maximum error",
          .error_unit = "m",
          .series = {"closed_form", "newton_steps"},
          .measure = measure_delta};
}

}  // namespace longreach
