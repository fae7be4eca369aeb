#include <algorithm>
#include <cmath>

#include "common/spatial/sin_cos.hpp"
#include "master/devices/spherical/spherical_closure.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kSingularPose = 1e-6;  // 1 / |J^-1| below which a pose counts as singular
// 1 / |J^-1| below which an iteration that fails to converge was stopped by a singularity.
constexpr double kNear = 0.02;
constexpr double kSmall = 2e-2;  // contraction below which the first Jacobian is used until convergence
constexpr double kReuse = 1e-3;  // contraction below which a Jacobian is used for another step
constexpr double kDone = 5e-17;  // remaining error, rad/2

double square(double x) { return x * x; }

Vector3 times(const Adjugate& inverse, const Eigen::Array4d& r) { return inverse.times(r[0], r[1], r[2]); }

}  // namespace

SphericalKinematics::SphericalKinematics(const SphericalGeometry& geometry)
    : g_(geometry), curvature_(std::sqrt(3.0) * (1.0 + std::abs(geometry.cos_alpha2()))) {
  const auto set = [](Vectors& vectors, int lane, const Vector3& value) {
    vectors.x[lane] = value.x();
    vectors.y[lane] = value.y();
    vectors.z[lane] = value.z();
  };
  for (int lane = 0; lane < 4; ++lane) {
    const SphericalGeometry::Leg& leg = g_.leg(std::min(lane, 2));
    set(w_axial_, lane, leg.w_axial);
    set(w_cos_, lane, leg.w_cos);
    set(w_sin_, lane, leg.w_sin);
    set(v_, lane, leg.v);
  }
}

/// F of the three legs near the previous orientation.
struct SphericalKinematics::Closures {
  Vectors w, v, n;
  Eigen::Array4d half_gap;  // (k - c)/2
  Eigen::Array4d sum;       // k + c

  static Adjugate adjugate(const Vectors& rows) {
    return {Vector3(rows.x[0], rows.y[0], rows.z[0]), Vector3(rows.x[1], rows.y[1], rows.z[1]),
            Vector3(rows.x[2], rows.y[2], rows.z[2])};
  }
  static Eigen::Array4d dot(const Vectors& a, const Vector3& g) {
    return a.x * g.x() + a.y * g.y() + a.z * g.z();
  }

  [[nodiscard]] Eigen::Array4d second_order(const Vector3& g) const {
    return dot(w, g) * dot(v, g) - sum * (0.5 * g.squaredNorm());
  }
  [[nodiscard]] Eigen::Array4d at(const Vector3& g) const { return half_gap + dot(n, g) + second_order(g); }
  [[nodiscard]] Vectors gradient(const Vector3& g) const {
    const Eigen::Array4d gv = dot(v, g), gw = dot(w, g);
    return {n.x + gv * w.x + gw * v.x - sum * g.x(), n.y + gv * w.y + gw * v.y - sum * g.y(),
            n.z + gv * w.z + gw * v.z - sum * g.z()};
  }
};

/// The search for g.
struct SphericalKinematics::Search {
  Closures legs;
  Vector3 g;
  int iterations = 0;

  [[gnu::always_inline]] inline Search(const SphericalKinematics& k, const Vector3& theta_rad,
                                       const Quaternion& q) {
    Eigen::Array4d c, s;
    for (int i = 0; i < 3; ++i) {
      const SinCos turn = sin_cos(theta_rad[i]);
      c[i] = turn.c;
      s[i] = turn.s;
    }
    c[3] = c[2];
    s[3] = s[2];
    const Matrix3 R = q.toRotationMatrix();
    const Eigen::Array4d wx = k.w_axial_.x + c * k.w_cos_.x + s * k.w_sin_.x;
    const Eigen::Array4d wy = k.w_axial_.y + c * k.w_cos_.y + s * k.w_sin_.y;
    const Eigen::Array4d wz = k.w_axial_.z + c * k.w_cos_.z + s * k.w_sin_.z;
    const Eigen::Array4d vx = R(0, 0) * k.v_.x + R(0, 1) * k.v_.y + R(0, 2) * k.v_.z;
    const Eigen::Array4d vy = R(1, 0) * k.v_.x + R(1, 1) * k.v_.y + R(1, 2) * k.v_.z;
    const Eigen::Array4d vz = R(2, 0) * k.v_.x + R(2, 1) * k.v_.y + R(2, 2) * k.v_.z;
    legs.w.x = wx, legs.w.y = wy, legs.w.z = wz;
    legs.v.x = vx, legs.v.y = vy, legs.v.z = vz;
    legs.n.x = vy * wz - vz * wy, legs.n.y = vz * wx - vx * wz, legs.n.z = vx * wy - vy * wx;
    const Eigen::Array4d wv = wx * vx + wy * vy + wz * vz;
    legs.half_gap = 0.5 * (wv - k.g_.cos_alpha2());
    legs.sum = wv + k.g_.cos_alpha2();
  }

  /// Iterates g <- step - J^-1 (terms of second order). For a small step the contraction is so strong that
  /// the first Jacobian suffices. The observed contraction (half of it in the first round) determines when
  /// the remaining error is below rounding.
  [[gnu::always_inline]] inline bool small_step(const Adjugate& inverse, double scale, const Vector3& step) {
    const Vector3 x = scale * inverse.x, y = scale * inverse.y, z = scale * inverse.z;
    double before2 = step.squaredNorm();
    g = step;
    while (iterations < kMaxIterations) {
      ++iterations;
      const Eigen::Array4d r = legs.second_order(g);
      const Vector3 next = step + (r[0] * x + r[1] * y + r[2] * z);
      const double change2 = (next - g).squaredNorm();
      g = next;
      if (change2 * change2 <= square(0.5 * kDone) * before2) return true;
      before2 = change2;
    }
    return false;
  }

  /// Performs Newton steps with one Jacobian, starting where it was evaluated (`off` = 0), while they
  /// contract fast.
  bool steps(const Adjugate& inverse, double bend) {
    const double scale = -1.0 / inverse.volume;
    double off = 0.0;
    while (iterations < kMaxIterations) {
      ++iterations;
      const Vector3 step = scale * times(inverse, legs.at(g));
      const double length = step.norm();
      if (bend * length > 0.5) {  // outside the radius that is known to be regular: go half that radius
        g += step * (0.25 / (bend * length));
        return false;
      }
      g += step;
      off += length;
      if (bend * off * length <= kDone) return true;
      if (bend * off > kReuse) return false;
    }
    return false;
  }
};

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)  // TSan's runtime starts after the choice is made
// Compiled twice; the version for the processor is selected when the program starts. Instructions with three
// operands save a third of the moves. Floating-point contraction is off, so the results are bit-identical.
#ifndef __clang__  // Clang 14 leaves the symbol itself undefined
[[gnu::target_clones("avx", "default")]]
#endif
#endif
SphericalPose
SphericalKinematics::forward(const Vector3& theta_rad, const SphericalPose& previous) const {
  const bool is_unit = std::abs(previous.q.squaredNorm() - 1.0) <= 1e-6;
  SphericalPose result{SolutionStatus::kNoSolution, is_unit ? previous.q : Quaternion::Identity(),
                       previous.side, 0};

  Search search(*this, theta_rad, result.q);
  const Closures& legs = search.legs;
  double conditioning = 0.0;  // 1 / |J^-1|²
  bool found = false;
  Adjugate inverse = Closures::adjugate(legs.n);
  for (bool first = true; !found && search.iterations < kMaxIterations; first = false) {
    if (!first) inverse = Closures::adjugate(legs.gradient(search.g));
    const double volume2 = square(inverse.volume), norm2 = inverse.square();
    conditioning = volume2 / norm2;
    if (!(volume2 > square(kSingularPose) * norm2)) break;
    const int side = inverse.volume > 0.0 ? 1 : -1;
    if (side * result.side < 0) {  // the motors have moved across a singularity
      conditioning = 0.0;
      break;
    }
    result.side = side;
    if (first) {
      const double scale = -1.0 / inverse.volume;
      const Vector3 step = scale * times(inverse, legs.half_gap);
      const double squared_rate = square(curvature_) * step.squaredNorm() / conditioning;
      if (squared_rate < square(kSmall)) {
        found = search.small_step(inverse, scale, step);
        break;
      }
      search.g.setZero();
    }
    found = search.steps(inverse, curvature_ / std::sqrt(conditioning));
  }
  result.iterations = search.iterations;
  if (found) {
    result.status = SolutionStatus::kFound;
    result.q = turned(search.g, result.q);
    return result;
  }
  result.side = previous.side;
  // Angles that are not finite are rejected here.
  if (!theta_rad.allFinite()) return result;
  result.status = conditioning < square(kNear) ? SolutionStatus::kSingular : SolutionStatus::kNotConverged;
  return result;
}

}  // namespace longreach
