#include <algorithm>
#include <cmath>

#include "master/devices/spherical/spherical_closure.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kSingular = 1e-6;  // 1 / |J^-1| below which a pose is called singular
constexpr double kNear =
    0.02;  // the same, where an iteration that does not arrive was stopped by a singularity
constexpr double kReuse = 1e-3;  // contraction below which the old Jacobian is good enough
constexpr double kDone = 3e-17;  // error that is left, rad/2

}  // namespace

SphericalKinematics::SphericalKinematics(const SphericalGeometry& geometry)
    : g_(geometry), curvature_(std::sqrt(3.0) * (1.0 + std::abs(geometry.cos_alpha2()))) {}

SphericalPose SphericalKinematics::forward(const Vector3& theta_rad, const SphericalPose& previous) const {
  const bool is_unit = std::abs(previous.q.squaredNorm() - 1.0) <= 1e-6;
  SphericalPose result{SolutionStatus::kNoSolution, is_unit ? previous.q : Quaternion::Identity(),
                       previous.side, 0};
  if (!theta_rad.allFinite()) return result;

  SphericalClosure leg[3];
  const Matrix3 R = result.q.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    const Vector3 w = g_.middle_axis(i, std::cos(theta_rad[i]), std::sin(theta_rad[i]));
    leg[i] = SphericalClosure(w, R * g_.leg(i).v, g_.cos_alpha2());
  }

  Vector3 g = Vector3::Zero();
  Vector3 a = leg[0].n, b = leg[1].n, c = leg[2].n;
  double conditioning = 0.0;
  while (result.iterations < kMaxIterations) {
    const Adjugate inverse(a, b, c);
    const double volume2 = inverse.volume * inverse.volume;
    const double norm2 = inverse.square();  // |J^-1|² = norm2 / volume2
    conditioning = volume2 / norm2;
    if (!(volume2 > kSingular * kSingular * norm2)) break;
    const int side = inverse.volume > 0.0 ? 1 : -1;
    if (side * result.side < 0) {  // the motors have moved across a singularity
      result.status = SolutionStatus::kSingular;
      return result;
    }
    result.side = side;
    const double bend = std::sqrt(norm2 / volume2) * curvature_;
    const double scale = -1.0 / inverse.volume;
    // Steps with this Jacobian, while they contract fast enough.
    double off = 0.0;  // how far g has come from where the Jacobian was taken
    for (;;) {
      ++result.iterations;
      const double half_square = 0.5 * g.squaredNorm();
      const Vector3 step = scale * inverse.times(leg[0].at(g, half_square), leg[1].at(g, half_square),
                                                 leg[2].at(g, half_square));
      const double length = step.norm();
      if (bend * length > 0.5) {  // outside of the radius that is known to be regular: go half of it
        g += step * (0.25 / (bend * length));
        break;
      }
      g += step;
      off += length;
      const double contraction = bend * off;
      if (contraction * length <= kDone) {
        result.status = SolutionStatus::kFound;
        result.q = turned(g, result.q);
        return result;
      }
      if (contraction > kReuse || result.iterations >= kMaxIterations) break;
    }
    a = leg[0].gradient(g);
    b = leg[1].gradient(g);
    c = leg[2].gradient(g);
  }
  result.side = previous.side;
  result.status = conditioning < kNear * kNear ? SolutionStatus::kSingular : SolutionStatus::kNotConverged;
  return result;
}

}  // namespace longreach
