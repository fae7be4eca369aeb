#include "master/devices/delta/delta_statics.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include "common/spatial/sin_cos.hpp"
#include "common/spatial/singular_value.hpp"

namespace longreach {
namespace {

/// Volume of the unit rods below which they count as linearly dependent.
constexpr double kDependentRods = 1e-9;

Matrix3 adjugate_columns(const Matrix3& rows) {
  Matrix3 columns;
  const Vector3 a = rows.row(0), b = rows.row(1), c = rows.row(2);
  columns << b.cross(c), c.cross(a), a.cross(b);
  return columns;
}

}  // namespace

void require_valid(const DeltaMasses& masses) {
  const auto mass = [](std::string_view name, double kg) {
    if (!std::isfinite(kg) || kg < 0.0)
      throw GeometryError(std::string(name) + " must be a finite, non-negative mass");
  };
  mass("platform", masses.platform_kg);
  mass("arm", masses.arm_kg);
  mass("forearm", masses.forearm_kg);
  if (!(std::abs(masses.arm_com_fraction) <= 1.0))
    throw GeometryError("arm_com_fraction must be from -1 to 1");
}

DeltaVelocity velocity(const DeltaGeometry& g, const Vector3& theta_rad, const Vector3& p_m) {
  const DeltaTurns turn(theta_rad);
  const DeltaLegVectors elbow = g.elbows(turn);
  const DeltaLegs &cos = g.cos_azimuth(), &sin = g.sin_azimuth();
  DeltaLegs x = p_m.x() - elbow.x, y = p_m.y() - elbow.y, z = p_m.z() - elbow.z;
  // The offset lies in the plane of the leg between the end of the arm and the rods.
  DeltaLegs out = cos * x + sin * y;
  const DeltaLegs distance = (out * out + z * z).sqrt();
  const DeltaLegs share = (distance > 0.0).select(g.offset_m() / distance, 1.0);
  x -= share * out * cos, y -= share * out * sin, z -= share * z;
  const DeltaLegs length = (x * x + y * y + z * z).sqrt();
  const DeltaLegs per_length = (length > 0.0).select(1.0 / length, 0.0);
  x *= per_length, y *= per_length, z *= per_length;
  out = cos * x + sin * y;
  DeltaVelocity at;
  at.rods.col(0) = x.head<3>();
  at.rods.col(1) = y.head<3>();
  at.rods.col(2) = z.head<3>();
  at.lever_m = (g.arm_m() * (g.up() * z * turn.cosine - out * turn.sine)).head<3>();
  return at;
}

DeltaSingularity singularity(const DeltaGeometry& g, const DeltaVelocity& at) {
  return {at.lever_m.cwiseAbs().minCoeff() / g.arm_m(), smallest_singular_value(at.rods)};
}

DeltaJacobian jacobian(const DeltaVelocity& at) {
  const Matrix3 columns = adjugate_columns(at.rods);
  const double volume = at.rods.row(0).dot(columns.col(0));
  if (!(std::abs(volume) > kDependentRods)) return {};
  return {SolutionStatus::kFound, columns * (at.lever_m / volume).asDiagonal()};
}

DeltaTorques statics(const DeltaVelocity& at, const Vector3& force_n) {
  const DeltaJacobian J = jacobian(at);
  if (J.status != SolutionStatus::kFound || !force_n.allFinite()) return {};
  return {SolutionStatus::kFound, J.m_per_rad.transpose() * force_n};
}

DeltaTorques gravity_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at) {
  return holding_torques(g, masses, gravity_m_per_s2, theta_rad, at, Vector3::Zero());
}

DeltaTorques holding_torques(const DeltaGeometry& g, const DeltaMasses& masses,
                             const Vector3& gravity_m_per_s2, const Vector3& theta_rad,
                             const DeltaVelocity& at, const Vector3& force_n) {
  const double with_platform = masses.platform_kg + 1.5 * masses.forearm_kg;
  const double with_arm = masses.arm_kg * masses.arm_com_fraction + 0.5 * masses.forearm_kg;
  DeltaTorques result = statics(at, force_n - with_platform * gravity_m_per_s2);
  if (result.status != SolutionStatus::kFound) return result;
  // In the frame of the leg, the displacement of the end of the arm per radian is (-a sin θ, 0, a cos θ).
  const DeltaTurns turn(theta_rad);
  const Vector3& pull = gravity_m_per_s2;
  const DeltaLegs outwards = g.cos_azimuth() * pull.x() + g.sin_azimuth() * pull.y();
  const DeltaLegs along = g.arm_m() * (g.up() * pull.z() * turn.cosine - turn.sine * outwards);
  result.tau_nm -= with_arm * along.head<3>().matrix();
  return result;
}

double potential_energy(const DeltaGeometry& g, const DeltaMasses& masses, const Vector3& gravity_m_per_s2,
                        const Vector3& theta_rad, const Vector3& p_m) {
  Vector3 moment = (masses.platform_kg + 1.5 * masses.forearm_kg) * p_m;  // mass times position
  for (int i = 0; i < 3; ++i) {
    const auto [s, c] = sin_cos(theta_rad[i]);
    const Vector3 motor = g.to_world(i, {g.radius_m(), g.side_m(), 0.0});
    const Vector3 arm = g.to_world(i, g.arm_m() * Vector3(c, 0.0, s));
    moment +=
        masses.arm_kg * (motor + masses.arm_com_fraction * arm) + 0.5 * masses.forearm_kg * (motor + arm);
  }
  return -gravity_m_per_s2.dot(moment);
}

}  // namespace longreach
