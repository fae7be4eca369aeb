// Figure 12 of Liu et al. 2019: the hand rotates the rotational handle into a virtual wall and out again.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/simulation/hand_model.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWall_rad = 5.0 * kDegree;
constexpr double kTurn_rad = 20.0 * kDegree;  // target of the hand
constexpr double kDamping_nm_s_per_rad = 4.775e-3;
constexpr std::array kStiffness_nm_mm_per_deg = {8.0, 20.0, 50.0};
constexpr double kDuration_s = 3.0;

struct Sample {
  double angle_rad = 0.0;
  double moment_nm = 0.0;
};

/// Into the wall within one second, one second at rest, and out again.
double wanted_rad(double t) {
  const auto smooth = [](double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  };
  return kTurn_rad * (smooth(t) - smooth(t - 2.0));
}

std::vector<Sample> turn_into_wall(const DeviceConfig& device, double stiffness_nm_per_rad) {
  SimulatedDevices devices(device);
  std::vector<Sample> samples;
  for (int i = 0; i <= static_cast<int>(kDuration_s * 1e3); ++i) {
    const double t = 1e-3 * i;
    devices.set_target({.rotation_rad = {wanted_rad(t), 0.0, 0.0}, .grip = Grip::kLight});
    const HandleState handle = devices.read(Time{} + from_seconds(t));
    const double depth = log_rotation(handle.q_MH).x() - kWall_rad;
    double moment = 0.0;
    if (depth > 0.0)
      moment =
          -std::max(0.0, stiffness_nm_per_rad * depth + kDamping_nm_s_per_rad * handle.angular_rad_per_s.x());
    devices.write({.moment = {moment, 0.0, 0.0}});
    samples.push_back({log_rotation(devices.spherical().orientation()).x(), moment});
  }
  return samples;
}

}  // namespace

std::vector<Plot> wall_rotation_plots() {
  std::vector<Curve> angles, moments;
  for (const double k : kStiffness_nm_mm_per_deg) {
    const std::string name = std::to_string(static_cast<int>(k));
    angles.push_back({"angle_" + name + "_deg", name + " N mm/deg"});
    moments.push_back({"moment_" + name + "_nm", name + " N mm/deg", 1e3});
  }
  angles.push_back({"wanted_deg", "commanded by the hand"});
  return {{.name = "wall-rotation",
           .csv = "wall",
           .title = "A lightly gripped handle is rotated into a virtual wall at 5 degrees",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"rotation (deg)", angles, ""}, {"moment (N mm)", moments, ""}}}};
}

std::vector<Metric> run_wall_rotation(const ExperimentRun& run) {
  const DeviceConfig device = to_struct(run.config.master()).device;
  std::vector<std::vector<Sample>> all;
  std::vector<Metric> metrics;
  for (const double k : kStiffness_nm_mm_per_deg) {
    const double stiffness = k * 1e-3 / kDegree;
    all.push_back(turn_into_wall(device, stiffness));
    const std::vector<Sample>& samples = all.back();
    // At rest in the wall, the springs of hand and wall share the rotation, apart from friction.
    const double hand = wrist_model(Grip::kLight).stiffness_nm_per_rad;
    const double expected = hand * (kTurn_rad - kWall_rad) / (hand + stiffness);
    const double depth = samples[1900].angle_rad - kWall_rad;
    double lowest = 1e9, highest = -1e9;
    for (std::size_t i = 1700; i < 1900; ++i) {
      lowest = std::min(lowest, samples[i].angle_rad);
      highest = std::max(highest, samples[i].angle_rad);
    }
    const std::string at = "_at_" + std::to_string(static_cast<int>(k));
    metrics.push_back({"depth" + at, depth / kDegree, "deg"});
    metrics.push_back({"depth_expected" + at, expected / kDegree, "deg"});
    metrics.push_back({"trembling" + at, (highest - lowest) / kDegree, "deg"});
  }
  Trace trace(run.out, "wall",
              {"t_s", "wanted_deg", "angle_8_deg", "angle_20_deg", "angle_50_deg", "moment_8_nm",
               "moment_20_nm", "moment_50_nm"});
  for (std::size_t i = 0; i < all[0].size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    trace.row({t, wanted_rad(t) / kDegree, all[0][i].angle_rad / kDegree, all[1][i].angle_rad / kDegree,
               all[2][i].angle_rad / kDegree, all[0][i].moment_nm, all[1][i].moment_nm, all[2][i].moment_nm});
  }
  trace.close();
  return metrics;
}

}  // namespace longreach
