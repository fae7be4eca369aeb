#include "deploy/lab/rendering/idle_draws.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/config/config.hpp"
#include "common/config/deploy_folder.hpp"
#include "common/core/random.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr std::array kDevices = {"paper", "falcon", "desktop"};
constexpr double kDepth_m = 0.005;  // maximum depth of a press
constexpr double kDepth_rad = 0.1;
constexpr double kDeflects_m = 0.018;  // maximum speed of a handle that the hand moves in rate mode
constexpr double kFarthest = 0.98;     // fraction of the workspace: into its soft stop

Vector3 direction(Random& random) {
  return Vector3(random.normal(), random.normal(), random.normal()).stableNormalized();
}

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

/// Force that the motors can hold at the handle at this pose, in any direction.
double motor_force_n(const DeviceConfig& device, const Vector3& x_m) {
  const DeltaDynamics d(device.delta);
  const Matrix3 rates = d.pose(d.home_m() + x_m).rates;
  return device.delta.drive.torque_max_nm * Eigen::JacobiSVD<Matrix3>(rates).singularValues()[2];
}

/// A wall that balances `press` within `depth`, with up to twice the maximum rendered stiffness; every fourth
/// wall is much stiffer.
double wall(Random& random, double press, double depth, double cap) {
  const double softest = press / depth;
  return random.chance(0.25) ? 100.0 * std::max(cap, softest)
                             : log_uniform(random, softest, std::max(2.0 * cap, 1.01 * softest));
}

}  // namespace

std::vector<MasterConfig> idle_masters(const proto::LabConfig& config) {
  std::vector<MasterConfig> masters;
  for (const char* name : kDevices) {
    proto::MasterConfig master = config.master();
    master.set_device_file(std::string("devices/") + name + ".txtpb");
    master.clear_device();
    resolve_files(master, find_deploy_folder());
    masters.push_back(to_struct(master));
    masters.back().safety.engage_at_start = false;
  }
  return masters;
}

IdleDraw draw_idle(const std::vector<MasterConfig>& masters, std::uint64_t seed, std::size_t number) {
  Random random = Random(seed).child("idle").child(std::to_string(number));
  IdleDraw draw;
  MasterConfig& m = draw.master = masters[number % masters.size()];
  m.hand.grip = random.chance(0.5) ? Grip::kLight : Grip::kFirm;
  draw.lets_go = random.chance(1.0 / 3.0);
  m.mapping.mode = random.chance(0.3) ? MotionMode::kRate : MotionMode::kPosition;
  m.mapping.rate_centre = RateCentre::kWhereModeBegan;  // the hand may be at any place
  m.mapping.scale = random.uniform(0.25, 1.0);
  m.rendering.home_spring = random.chance(0.2);
  m.device.delay_samples = random.chance(0.3) ? 1 : 0;
  draw.inward = direction(random);
  Vector3 to = direction(random), about = direction(random);
  // A released handle would not be at rest, because the spring between it and its home relaxes slowly.
  if (draw.lets_go && draw.inward.dot(to) < 0.0) to = -to;
  if (draw.lets_go && draw.inward.dot(about) < 0.0) about = -about;
  // The centre of rate mode moves with a handle that returns home, so the handle would not leave the dead
  // zone.
  if (m.mapping.mode == MotionMode::kRate && draw.inward.dot(to) < 0.0) to = -to;
  const double far = std::cbrt(random.uniform()), far_turned = std::cbrt(random.uniform());
  const double kind = random.uniform();
  double farthest_m = kFarthest * m.device.delta.workspace_m;
  double farthest_rad = kFarthest * m.device.spherical.workspace_rad;
  const DeviceFigures least = device_figures(m.device, 1.0 / m.loop.rate_hz);
  const double lag_s = 0.5 / m.loop.rate_hz + least.delay_s;
  if (kind > 1.0 / 3.0) {
    const double most_n =
        std::min(1.1 * m.rendering.force_max_n, 0.7 * motor_force_n(m.device, 0.5 * farthest_m * to));
    draw.press_n = random.uniform(0.5, most_n);
    draw.wall_n_per_m = wall(random, draw.press_n, kDepth_m, least.damping_n_s_per_m / lag_s);
    const double goes_m =
        m.mapping.mode == MotionMode::kRate ? kDeflects_m : 0.002 / m.mapping.scale + kDepth_m;
    farthest_m = 0.93 * m.device.delta.workspace_m - goes_m;
  }
  if (kind > 2.0 / 3.0 && m.mapping.mode == MotionMode::kPosition) {
    draw.press_nm = random.uniform(0.01, 1.1 * m.rendering.moment_max_nm);
    draw.wall_nm_per_rad = wall(random, draw.press_nm, kDepth_rad, least.damping_nm_s_per_rad / lag_s);
    farthest_rad = 0.93 * m.device.spherical.workspace_rad - 0.02 / m.mapping.scale - kDepth_rad - 0.1;
  }
  if (number % 2 == 1) m.rendering.store_j = 0.0;
  draw.place.p = far * farthest_m * to;
  draw.place.q = exp_rotation(far_turned * farthest_rad * about);
  return draw;
}

}  // namespace longreach
