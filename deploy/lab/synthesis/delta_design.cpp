#include "deploy/lab/synthesis/delta_design.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/check.hpp"
#include "common/spatial/sin_cos.hpp"
#include "common/spatial/singular_value.hpp"
#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/delta/delta_statics.hpp"

namespace longreach {
namespace {

/// A form without a division by the reach of the leg: flat2 (1 - cos²γ) = flat2 - X² share.
double bend(const DeltaGeometry& g, int i, const Vector3& p) {
  const Vector3 q = g.to_leg(i, p);
  const double across = q.y() - g.side_m();
  const double rod2 = g.rod_m() * g.rod_m();
  const double flat2 = rod2 - across * across;
  const bool offset = g.offset_m() > 0.0;
  if (offset && flat2 <= 0.0) return flat2 / rod2;
  const double reach = g.offset_m() + std::sqrt(std::max(flat2, 0.0));
  const double reach2 =
      offset ? reach * reach : flat2;  // without offset the square of the rods, whatever its sign
  const double share = offset ? flat2 / reach2 : 1.0;
  const double out = q.x() - g.radius_m();
  const double X = (out * out + q.z() * q.z() - g.arm_m() * g.arm_m() - reach2) / (2.0 * g.arm_m());
  return (flat2 - X * X * share) / rod2;
}

double radius_m(const DeltaGeometry& g, const DeltaDemand& demand) {
  return g.radius_m() + demand.platform_radius_m + g.arm_m();
}

Vector3 column_norms(const Matrix3& J) { return J.colwise().stableNorm().transpose(); }

}  // namespace

DeltaFigures figures(const DeltaGeometry& g, const Vector3& p_m) {
  DeltaFigures at;
  if (!p_m.allFinite()) return at;
  for (int i = 0; i < 3; ++i) at.bend[i] = bend(g, i, p_m);
  const DeltaAngles angles = DeltaKinematics(g).inverse(p_m);
  if (angles.status != SolutionStatus::kFound) return at;
  for (int i = 0; i < 3; ++i) at.elbow_m[i] = g.arm_m() * sin_cos(angles.theta_rad[i]).s;
  const DeltaVelocity v = velocity(g, angles.theta_rad, p_m);
  const DeltaJacobian J = jacobian(v);
  at.rods = smallest_singular_value(v.rods);
  if (J.status != SolutionStatus::kFound) return at;
  at.torque_m = column_norms(J.m_per_rad);
  // σ_max(J) is 1 / σ_min(J⁻¹), which needs no division by the volume of the rods.
  const Matrix3 inverse = v.lever_m.cwiseInverse().asDiagonal() * v.rods;
  at.conditioning = std::min(smallest_singular_value(J.m_per_rad) * smallest_singular_value(inverse), 1.0);
  return at;
}

DeltaSlacks slacks(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                   const DeltaFigures& at) {
  const double lowest_m = g.up() * cube.centre_m.z() + 0.5 * cube.side_m;
  DeltaSlacks slack;
  for (int i = 0; i < 3; ++i) {
    slack[i] = at.bend[i] - demand.arm * demand.arm;
    slack[3 + i] = std::max(-1.0, 1.0 - at.torque_m[i] * demand.force_n / demand.torque_nm);
    slack[6 + i] = 1.0 - (lowest_m + std::max(-at.elbow_m[i], 0.0)) / demand.height_m;
  }
  slack[9] = 1.0 - radius_m(g, demand) / demand.radius_m;
  slack[10] = at.rods - demand.rods;
  slack[kDeltaConditioningSlack] = at.conditioning - demand.conditioning;
  return slack;
}

DeltaCubeFigures figures(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                         int per_edge) {
  CHECK(per_edge >= 1);
  constexpr double kMost = std::numeric_limits<double>::infinity();
  DeltaCubeFigures all{kMost, kMost, 0.0, kMost, kMost, 0.0, 0.0, 0.0};
  const double step = per_edge > 1 ? 1.0 / (per_edge - 1) : 0.0;
  const double first = per_edge > 1 ? -0.5 : 0.0;
  const int count = per_edge * per_edge * per_edge;
  for (int n = 0; n < count; ++n) {
    const Vector3 place(n % per_edge, n / per_edge % per_edge, n / per_edge / per_edge);
    const DeltaFigures at =
        figures(g, cube.centre_m + cube.side_m * (step * place + Vector3::Constant(first)));
    all.slack = std::min(all.slack, slacks(g, demand, cube, at).minCoeff());
    all.conditioning = std::min(all.conditioning, at.conditioning);
    all.conditioning_mean += at.conditioning / count;
    all.arm = std::min(all.arm, std::sqrt(std::max(at.bend.minCoeff(), 0.0)));
    all.rods = std::min(all.rods, at.rods);
    all.torque_m = std::max(all.torque_m, at.torque_m.maxCoeff());
    all.height_m = std::max(all.height_m, -at.elbow_m.minCoeff());
  }
  all.radius_m = radius_m(g, demand);
  all.height_m += g.up() * cube.centre_m.z() + 0.5 * cube.side_m;
  return all;
}

double largest_cube_m(const DeltaGeometry& g, const DeltaDemand& demand, const Vector3& centre_m,
                      int per_edge) {
  const auto meets = [&](double side_m) {
    return figures(g, demand, {centre_m, side_m}, per_edge).slack >= 0.0;
  };
  double fits = 0.0, too_large = 4.0 * g.size_m();
  if (!meets(fits)) return 0.0;
  while (too_large - fits > 1e-6 * g.size_m()) {
    const double middle = 0.5 * (fits + too_large);
    (meets(middle) ? fits : too_large) = middle;
  }
  return fits;
}

}  // namespace longreach
