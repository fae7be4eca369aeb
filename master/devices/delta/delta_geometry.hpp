#pragma once
// The dimensions of a DELTA mechanism. Each of the three legs, at azimuth φ, has an arm on a motor at the
// base and a parallelogram (forearm) to a platform that only translates. In the frame of a leg, with u
// outwards and v sideways:
//
//   (u + c - a cos θ)² + (w - a sin θ)² = (d + e + √(b² - (v + f)²))²
//   u = x cos φ + y sin φ - r,  v = -x sin φ + y cos φ - s,  w = z          (general: Stamper, thesis, 1997)
//
// In the simple geometry the joints are at the middle of the links, and positive θ turns the arms towards -z:
//   K = ((a + l1 cos θ) cos φ, (a + l1 cos θ) sin φ, -l1 sin θ),  |P - K| = l2.
//
// The constructors throw GeometryError, which names the parameter, for a DELTA that cannot exist: a value is
// not finite, a length is not positive, two legs have the same azimuth, or no pose closes the loops.

#include <array>

#include "common/core/geometry_error.hpp"
#include "common/spatial/sin_cos.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct DeltaSimple {
  double a = 0.0;   // base radius minus platform radius, m, >= 0
  double l1 = 0.0;  // upper arm, m, > 0
  double l2 = 0.0;  // forearm, m, > 0
  std::array<double, 3> azimuth_rad{};
};

struct DeltaGeneral {
  double a = 0.0;  // upper arm, m, > 0
  double b = 0.0;  // rods of the parallelogram, m, > 0
  double c = 0.0;  // from the centre of the platform to the platform joint, outwards, m
  double d = 0.0;  // from the end of the arm to the parallelogram, m, >= 0
  double e = 0.0;  // from the parallelogram to the platform joint, m, >= 0
  double f = 0.0;  // sideways offset of the platform joint, m
  double r = 0.0;  // from the centre of the base to the motor axis, outwards, m
  double s = 0.0;  // sideways offset of the arm, m
  std::array<double, 3> azimuth_rad{};
};

/// The minimal set of parameters on which the loop closure depends, as used in a device file.
struct DeltaDimensions {
  double arm_m = 0.0;     // > 0
  double rod_m = 0.0;     // > 0
  double radius_m = 0.0;  // radius at the motor axis minus radius at the platform joint
  double offset_m = 0.0;  // d + e, >= 0
  double side_m = 0.0;    // s - f
  bool upwards = false;   // positive θ turns the arms towards +z
  std::array<double, 3> azimuth_rad{};
};

/// Side of the plane through the three sphere centres K_i (delta_statics.hpp) on which the platform is: the
/// sign of det[n1 n2 n3], where n_i are the directions of the rods.
enum class DeltaAssembly : std::int8_t { kNegative = -1, kPositive = 1 };

/// One number per leg. The first leg is repeated as a fourth element, so that SIMD instructions process the
/// legs in pairs.
using DeltaLegs = Eigen::Array4d;
struct DeltaLegVectors {
  DeltaLegs x, y, z;
};
struct DeltaTurns {
  explicit DeltaTurns(const Vector3& theta_rad) {
    const auto turn = sin_cos(std::array{theta_rad[0], theta_rad[1], theta_rad[2], theta_rad[0]});
    sine = {turn[0].s, turn[1].s, turn[2].s, turn[3].s};
    cosine = {turn[0].c, turn[1].c, turn[2].c, turn[3].c};
  }
  DeltaLegs sine, cosine;
};

class DeltaGeometry {
 public:
  explicit DeltaGeometry(const DeltaSimple& simple);
  explicit DeltaGeometry(const DeltaGeneral& general);
  explicit DeltaGeometry(const DeltaDimensions& dimensions);

  [[nodiscard]] double arm_m() const { return arm_; }
  [[nodiscard]] double rod_m() const { return rod_; }
  /// Returns d + e. If this is 0, the forward kinematics has a closed form.
  [[nodiscard]] double offset_m() const { return offset_; }
  [[nodiscard]] double radius_m() const { return radius_; }  // as DeltaDimensions::radius_m
  [[nodiscard]] double side_m() const { return side_; }      // s - f
  [[nodiscard]] double up() const { return up_; }  // +1 or -1: positive θ turns the arms towards up * z
  [[nodiscard]] double size_m() const { return arm_ + rod_ + offset_; }

  [[nodiscard]] const DeltaLegs& cos_azimuth() const { return cos_; }
  [[nodiscard]] const DeltaLegs& sin_azimuth() const { return sin_; }

  /// Converts a vector from the frame of leg i to world coordinates.
  [[nodiscard]] Vector3 to_world(int i, const Vector3& leg) const {
    const double c = cos_[i], s = sin_[i];
    return {c * leg.x() - s * leg.y(), s * leg.x() + c * leg.y(), up_ * leg.z()};
  }
  /// Converts a vector from world coordinates to the frame of leg i (outwards, sideways, direction of
  /// positive θ).
  [[nodiscard]] Vector3 to_leg(int i, const Vector3& world) const {
    const double c = cos_[i], s = sin_[i];
    return {c * world.x() + s * world.y(), c * world.y() - s * world.x(), up_ * world.z()};
  }
  /// Returns the end of arm i minus the offset of the platform joint, in world coordinates, m, for the given
  /// cosine and sine of θ. If the forearms had zero length, the centre of the platform would be there.
  [[nodiscard]] Vector3 elbow(int i, double cos_theta, double sin_theta) const {
    return to_world(i, {radius_ + arm_ * cos_theta, side_, arm_ * sin_theta});
  }

  /// Returns elbow() for all legs.
  [[nodiscard]] DeltaLegVectors elbows(const DeltaTurns& turn) const {
    const DeltaLegs out = radius_ + arm_ * turn.cosine;
    return {cos_ * out - side_ * sin_, sin_ * out + side_ * cos_, (up_ * arm_) * turn.sine};
  }

  /// Returns the assembly in which the platform is on the side towards which positive angles turn the arms.
  /// Devices are used in this assembly.
  [[nodiscard]] DeltaAssembly working_assembly() const { return working_; }

 private:
  void place_legs(const std::array<double, 3>& azimuth_rad);
  void require_closed_loop() const;
  [[nodiscard]] double gap(const Vector3& p) const;

  double arm_, rod_, offset_, radius_, side_, up_;
  DeltaLegs cos_ = DeltaLegs::Zero(), sin_ = DeltaLegs::Zero();  // cosine and sine of the azimuths
  DeltaAssembly working_ = DeltaAssembly::kPositive;
};

}  // namespace longreach
