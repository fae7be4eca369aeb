#pragma once
// The dimensions of a DELTA mechanism: three legs at azimuths φ, each an arm on a motor at the base and a
// parallelogram (forearm) to a platform that only translates. In the frame of a leg, u outwards, v sideways:
//
//   (u + c - a cos θ)² + (w - a sin θ)² = (d + e + √(b² - (v + f)²))²
//   u = x cos φ + y sin φ - r,  v = -x sin φ + y cos φ - s,  w = z          (general: Stamper, thesis, 1997)
//
// The simple geometry has its joints in the middle of the links, and θ turns the arms towards -z:
//   K = ((a + l1 cos θ) cos φ, (a + l1 cos θ) sin φ, -l1 sin θ),  |P - K| = l2.
//
// The constructors throw GeometryError, which names the parameter, for an impossible DELTA: a value that is
// not finite, a length that is not positive, two legs at one azimuth, a loop that no pose closes.

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
  double c = 0.0;  // platform joint from the platform's centre, outwards, m
  double d = 0.0;  // arm's end to the parallelogram, m, >= 0
  double e = 0.0;  // parallelogram to the platform joint, m, >= 0
  double f = 0.0;  // platform joint sideways, m
  double r = 0.0;  // motor axis from the centre, outwards, m
  double s = 0.0;  // arm sideways, m
  std::array<double, 3> azimuth_rad{};
};

/// The parameters on which the closure depends: the form used in a device file.
struct DeltaDimensions {
  double arm_m = 0.0;     // > 0
  double rod_m = 0.0;     // > 0
  double radius_m = 0.0;  // motor axis minus platform joint, outwards
  double offset_m = 0.0;  // d + e, >= 0
  double side_m = 0.0;    // s - f
  bool upwards = false;   // positive θ turns the arms to +z
  std::array<double, 3> azimuth_rad{};
};

/// Side of the plane through the three forearms' ends on which the platform is: sign of det[n1 n2 n3], n the
/// rods.
enum class DeltaAssembly : std::int8_t { kNegative = -1, kPositive = 1 };

/// One number per leg, with the first leg repeated at the end, so that two legs are processed at a time.
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
  [[nodiscard]] double offset_m() const { return offset_; }  // d + e; 0: three spheres, a closed form
  [[nodiscard]] double radius_m() const { return radius_; }  // motor axis minus platform joint, outwards
  [[nodiscard]] double side_m() const { return side_; }      // s - f
  [[nodiscard]] double up() const { return up_; }            // +1 or -1: positive θ turns the arms to up * z
  [[nodiscard]] double size_m() const { return arm_ + rod_ + offset_; }

  [[nodiscard]] const DeltaLegs& cos_azimuth() const { return cos_; }
  [[nodiscard]] const DeltaLegs& sin_azimuth() const { return sin_; }

  /// World coordinates of a vector in the frame of leg i.
  [[nodiscard]] Vector3 to_world(int i, const Vector3& leg) const {
    const double c = cos_[i], s = sin_[i];
    return {c * leg.x() - s * leg.y(), s * leg.x() + c * leg.y(), up_ * leg.z()};
  }
  /// Coordinates of a world vector in the frame of leg i (outwards, sideways, direction of positive θ).
  [[nodiscard]] Vector3 to_leg(int i, const Vector3& world) const {
    const double c = cos_[i], s = sin_[i];
    return {c * world.x() + s * world.y(), c * world.y() - s * world.x(), up_ * world.z()};
  }
  /// End of the arm minus the offset of the platform joint, for θ with the given cosine and sine: the
  /// position of the platform's centre for forearms of length zero.
  [[nodiscard]] Vector3 elbow(int i, double cos_theta, double sin_theta) const {
    return to_world(i, {radius_ + arm_ * cos_theta, side_, arm_ * sin_theta});
  }

  /// The same for all legs, in world coordinates.
  [[nodiscard]] DeltaLegVectors elbows(const DeltaTurns& turn) const {
    const DeltaLegs out = radius_ + arm_ * turn.cosine;
    return {cos_ * out - side_ * sin_, sin_ * out + side_ * cos_, (up_ * arm_) * turn.sine};
  }

  /// The assembly in which the platform is on the side to which positive angles turn the arms, as such
  /// devices are used.
  [[nodiscard]] DeltaAssembly working_assembly() const { return working_; }

 private:
  void place_legs(const std::array<double, 3>& azimuth_rad);
  void require_closed_loop() const;
  [[nodiscard]] double gap(const Vector3& p) const;

  double arm_, rod_, offset_, radius_, side_, up_;
  DeltaLegs cos_ = DeltaLegs::Zero(), sin_ = DeltaLegs::Zero();  // of the azimuths
  DeltaAssembly working_ = DeltaAssembly::kPositive;
};

}  // namespace longreach
