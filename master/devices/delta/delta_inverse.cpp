#include <cmath>
#include <limits>

#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// The loop of the leg closes where U cos θ + w sin θ = H; D² = U² + w² - H².
struct DeltaLegLoop {
  double U, w, H, D;
  bool closes;
  bool double_root;
};

/// Decides whether the loop closes near a double root. `slack` is the possible effect of rounding of H on D².
void judge(DeltaLegLoop& leg, double D2, double slack) {
  leg.closes = D2 >= -slack;
  leg.double_root = D2 <= slack;
  leg.D = D2 > 0.0 ? std::sqrt(D2) : 0.0;
}

inline DeltaLegLoop leg_loop(const DeltaGeometry& g, int i, const Vector3& p) {
  constexpr double kNearRoot = 1e-6;  // D² relative to d²
  const Vector3 q = g.to_leg(i, p);
  const double arm = g.arm_m(), rod = g.rod_m();
  const double across = q.y() - g.side_m();
  /// Squared length of the rods projected into the plane of the leg.
  double flat2 = (rod - across) * (rod + across);
  DeltaLegLoop leg;
  leg.closes = true;
  leg.double_root = false;
  if (!(flat2 >= 0.0)) {
    leg.closes = flat2 >= -8.0 * kEps * rod * rod;
    if (!leg.closes) return leg;
    flat2 = 0.0;
  }
  const double reach = g.offset_m() + std::sqrt(flat2);
  leg.U = q.x() - g.radius_m();
  leg.w = q.z();
  const double d2 = leg.U * leg.U + leg.w * leg.w;
  const double d = std::sqrt(d2);
  leg.H = 0.5 * (arm + (d - reach) * (d + reach) / arm);
  const double D2 = (d - leg.H) * (d + leg.H);
  if (D2 > kNearRoot * d2) {
    leg.D = std::sqrt(D2);
  } else {
    judge(leg, D2, 4.0 * kEps * std::abs(leg.H) * (arm * arm + d2 + reach * reach) / arm);
  }
  return leg;
}

// tan(θ/2) = (w - D) / (H + U) = (H - U) / (w + D): the form without cancellation is used.
inline double first_root(const DeltaLegLoop& leg) {
  const double wide = leg.w + leg.D;
  if (leg.w < 0.0) return 2.0 * std::atan((leg.w - leg.D) / (leg.H + leg.U));
  return wide == 0.0 && leg.H == leg.U ? 0.0 : 2.0 * std::atan((leg.H - leg.U) / wide);
}

inline double second_root(const DeltaLegLoop& leg) {
  if (leg.D == 0.0) return first_root(leg);
  if (leg.w >= 0.0) return 2.0 * std::atan((leg.w + leg.D) / (leg.H + leg.U));
  return 2.0 * std::atan((leg.H - leg.U) / (leg.w - leg.D));
}

}  // namespace

DeltaAngles DeltaKinematics::inverse(const Vector3& p_m, unsigned mode) const {
  DeltaAngles result;
  bool singular = false;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const DeltaLegLoop leg = leg_loop(g_, i, p_m);
    if (!leg.closes) return {};
    singular |= leg.double_root;
    result.theta_rad[i] = (mode >> i & 1U) != 0 ? second_root(leg) : first_root(leg);
  }
  result.status = singular ? SolutionStatus::kSingular : SolutionStatus::kFound;
  return result;
}

DeltaRoots DeltaKinematics::inverse_all(const Vector3& p_m) const {
  DeltaRoots result;
  bool singular = false;
  for (int i = 0; i < 3; ++i) {
    const DeltaLegLoop leg = leg_loop(g_, i, p_m);
    if (!leg.closes) return {};
    singular |= leg.double_root;
    result.first_rad[i] = first_root(leg);
    result.second_rad[i] = second_root(leg);
  }
  result.status = singular ? SolutionStatus::kSingular : SolutionStatus::kFound;
  return result;
}

}  // namespace longreach
