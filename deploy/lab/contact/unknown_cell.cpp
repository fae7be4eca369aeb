#include <cmath>

#include "deploy/lab/contact/unknown_contact.hpp"

namespace longreach {
namespace {

constexpr double kLeastSlope = 200.0;      // N/m
constexpr double kCap = 5500.0;            // maximum stiffness that the default device renders, N/m
constexpr double kHandMost_n = 6.0;        // a person probes with
constexpr double kHandDeepest_m = 0.02;    // of the handle
constexpr double kSoftShare = 0.6;         // fraction of the depth that is in the soft layer
constexpr double kHysteresisSpeed = 1e-3;  // m/s

}  // namespace

// Meaning of `n`: the exponent; progressive: depth / depth in which the force grows e-fold; layered:
// stiffness of the soft layer / stiffness of the hard one.
double UnknownCell::depth_m() const {
  const double linear_m = tool_n / slope_n_per_m;
  switch (kind) {
    case MaterialKind::kProgressive:
      return n * linear_m * std::exp(n) / std::expm1(n);
    case MaterialKind::kLayered:
      return linear_m / (kSoftShare * n + 1.0 - kSoftShare);
    case MaterialKind::kHuntCrossley:
    case MaterialKind::kHysteretic:
      break;
  }
  return n * linear_m;
}

double UnknownCell::elastic_n(double depth) const {
  if (depth <= 0.0) return 0.0;
  const double xi = depth / depth_m();
  switch (kind) {
    case MaterialKind::kProgressive:
      return tool_n * std::expm1(n * xi) / std::expm1(n);
    case MaterialKind::kLayered:
      return slope_n_per_m * depth_m() * (n * std::min(xi, kSoftShare) + std::max(xi - kSoftShare, 0.0));
    case MaterialKind::kHuntCrossley:
    case MaterialKind::kHysteretic:
      break;
  }
  return tool_n * std::pow(xi, n);
}

double UnknownCell::tangent_n_per_m(double depth) const {
  if (depth <= 0.0) return 0.0;
  const double xi = depth / depth_m();
  switch (kind) {
    case MaterialKind::kProgressive:
      return slope_n_per_m * std::exp(n * (xi - 1.0));
    case MaterialKind::kLayered:
      return slope_n_per_m * (xi < kSoftShare ? n : 1.0);
    case MaterialKind::kHuntCrossley:
    case MaterialKind::kHysteretic:
      break;
  }
  return slope_n_per_m * std::pow(xi, n - 1.0);
}

double UnknownCell::force_n(double depth, double speed_m_per_s) const {
  const double loss = kind == MaterialKind::kHysteretic
                          ? damping_s_per_m * std::tanh(speed_m_per_s / kHysteresisSpeed)
                          : damping_s_per_m * speed_m_per_s;
  return std::max(0.0, elastic_n(depth) * (1.0 + loss));
}

UnknownCell draw_cell(Random& random, MaterialKind kind) {
  static constexpr const char* kLinks[] = {"analog", "etsvii", "gateway", "georelay",   "interact-spike",
                                           "kontur", "lab",    "moon",    "moon-relay", "pass"};
  UnknownCell cell;
  cell.kind = kind;
  cell.link = kLinks[static_cast<std::size_t>(random.uniform(0.0, std::size(kLinks)))];
  cell.grip = random.chance(0.5) ? Grip::kLight : Grip::kFirm;
  // Draws until a person could press like this, because the force and the motion of the hand are bounded.
  do {
    cell.slope_n_per_m = random.log_uniform(kLeastSlope, kCap);
    cell.scale = random.log_uniform(0.2, 1.0);
    cell.noise_n = random.log_uniform(0.01, 0.2);
    const double least_n = std::max(0.9, 10.0 * cell.noise_n);
    cell.tool_n = random.log_uniform(least_n, 6.0);
    cell.probe_share = random.uniform(0.3, 0.6);
    switch (kind) {
      case MaterialKind::kHuntCrossley:
        cell.n = random.uniform(1.0, 2.0);
        cell.damping_s_per_m = random.uniform(0.0, 5.0);
        break;
      case MaterialKind::kProgressive:
        cell.n = random.uniform(1.5, 3.0);
        cell.damping_s_per_m = random.uniform(0.0, 1.0);
        break;
      case MaterialKind::kLayered:
        cell.n = random.uniform(0.2, 0.5);
        cell.damping_s_per_m = random.uniform(0.0, 1.0);
        break;
      case MaterialKind::kHysteretic:
        cell.n = random.uniform(1.0, 2.0);
        cell.damping_s_per_m = random.uniform(0.05, 0.2);
        break;
    }
  } while (cell.tool_n / cell.scale > kHandMost_n || cell.depth_m() / cell.scale > kHandDeepest_m);
  return cell;
}

UnknownCell draw_light_cell(Random& random, std::size_t index) {
  UnknownCell cell;
  cell.link = index % 2 == 0 ? "lab" : "moon";
  cell.n = random.uniform(1.0, 1.5);
  cell.damping_s_per_m = random.uniform(0.0, 1.0);
  cell.noise_n = 0.05;
  cell.tool_n = 0.5;
  cell.probe_share = 0.5;
  // k is 260 to 1500 N/m^n; slope_n_per_m is the slope at 0.5 N.
  const double k = random.log_uniform(260.0, 1500.0);
  cell.slope_n_per_m = cell.n * cell.tool_n / std::pow(cell.tool_n / k, 1.0 / cell.n);
  return cell;
}

}  // namespace longreach
