#pragma once
// Equation of motion of a DELTA in terms of the position of its platform. The mass of each forearm is lumped
// at its ends:
//
//   M a = F + Wᵀ (τ - I β),   M = m 1 + Wᵀ I W,   θ' = W v,   θ'' = W a + β
//   m = m_p + 3/2 m_f,   I = drive (rotor and arm) + ½ m_f arm²
//
// The rows of W are n_i / l_i of delta_statics.hpp. β follows from the second derivative of the closure
// equation:
//
//   β_i = ((q'² - o v_t²/ρ)/rod + n . A θ'²) / l_i
//
// Here o is the offset of a general leg, q the vector from DeltaGeometry::elbow() to the centre of the
// platform, ρ the length of q in the plane of the leg, v_t the component of q' perpendicular to q in that
// plane, and A the vector of the arm. The equations are exact except for the lumping (Codourey, The
// International Journal of Robotics Research 17(12), 1998).

#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/delta/delta_statics.hpp"
#include "schema/config_master.hpp"

namespace longreach {

/// A pose with the quantities that occur in the equation of motion. If `closed` is false (out of reach or
/// singular), the other values are invalid.
struct DeltaPose {
  bool closed = false;
  Vector3 p_m = Vector3::Zero();
  Vector3 theta_rad = Vector3::Zero();
  DeltaVelocity at{};
  Matrix3 rates = Matrix3::Zero();  // W, rad/m
};

class DeltaDynamics {
 public:
  /// Throws GeometryError for impossible dimensions or masses.
  explicit DeltaDynamics(const DeltaConfig& config);

  [[nodiscard]] const DeltaKinematics& kinematics() const { return kinematics_; }
  [[nodiscard]] const DeltaGeometry& geometry() const { return kinematics_.geometry(); }
  [[nodiscard]] const DeltaMasses& masses() const { return masses_; }
  [[nodiscard]] Vector3 home_m() const { return home_; }  // in the base frame

  /// Returns the pose with the platform at `p_m`, in the base frame.
  [[nodiscard]] DeltaPose pose(const Vector3& p_m) const;
  /// Returns the mass matrix M.
  [[nodiscard]] Matrix3 mass_kg(const DeltaPose& at) const;
  /// Returns β, rad/s², at the platform velocity `v_m_per_s`.
  [[nodiscard]] Vector3 rate_bias(const DeltaPose& at, const Vector3& v_m_per_s) const;
  /// Returns the weight of all links as an equivalent force on the platform, N.
  [[nodiscard]] Vector3 weight(const DeltaPose& at, const Vector3& gravity_m_per_s2) const;
  /// Returns the force on the platform, N, that is equivalent to the axis torques `tau_nm`.
  [[nodiscard]] static Vector3 force(const DeltaPose& at, const Vector3& tau_nm) {
    return at.rates.transpose() * tau_nm;
  }
  [[nodiscard]] double axis_inertia_kg_m2() const { return axis_kg_m2_; }

 private:
  DeltaKinematics kinematics_;
  DeltaMasses masses_;
  Vector3 home_;
  double platform_kg_;
  double axis_kg_m2_;
};

}  // namespace longreach
