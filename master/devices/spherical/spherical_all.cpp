#include <algorithm>
#include <cmath>
#include <numbers>

#include "master/devices/spherical/octic_roots.hpp"
#include "master/devices/spherical/spherical_closure.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kSame = 1e-6;              // distance below which two solutions are the same, rad/2
constexpr double kClosed = 1e-13;           // residual of a closure equation that counts as zero
constexpr double kSingularSolution = 1e-6;  // 1 / |J^-1| below which a solution counts as singular
// Fraction of its largest value below which the linear elimination of ψ is not trusted.
constexpr double kDependentRows = 0.05;

Vector3 any_across(const Vector3& axis) { return axis.unitOrthogonal(); }

/// The closure equation of a leg at φ: A cos ψ + B sin ψ + C = 0.
struct Turn {
  double A = 0.0, B = 0.0, C = 0.0;
};

/// All orientations that keep v of the first leg on its cone: R = frame(φ, ψ) frame*ᵀ.
class Elimination {
 public:
  Elimination(const SphericalGeometry& g, const std::array<Vector3, 3>& w) : g_(g), w_(w) {
    choose_first();
    const Vector3& v = g.leg(first_).v;
    const Vector3 p = any_across(v);
    platform_ << v, p, v.cross(p);
    e_ = any_across(w[static_cast<std::size_t>(first_)]);
    f_ = w[static_cast<std::size_t>(first_)].cross(e_);
  }

  /// Returns the matrix with the columns v, dv/dφ / sin(alpha2), and their cross product.
  [[nodiscard]] Matrix3 frame(double phi) const {
    const double c = std::cos(phi), s = std::sin(phi);
    const Vector3 v =
        g_.cos_alpha2() * w_[static_cast<std::size_t>(first_)] + g_.sin_alpha2() * (c * e_ + s * f_);
    const Vector3 p = c * f_ - s * e_;
    Matrix3 columns;
    columns << v, p, v.cross(p);
    return columns;
  }

  [[nodiscard]] std::array<Turn, 2> turns(const Matrix3& at) const {
    std::array<Turn, 2> result;
    for (int n = 0; n < 2; ++n) {
      const int i = (first_ + 1 + n) % 3;
      const Vector3 v = platform_.transpose() * g_.leg(i).v;
      const Vector3 w = at.transpose() * w_[static_cast<std::size_t>(i)];
      result[static_cast<std::size_t>(n)] = {w.y() * v.y() + w.z() * v.z(), w.z() * v.y() - w.y() * v.z(),
                                             w.x() * v.x() - g_.cos_alpha2()};
    }
    return result;
  }

  [[nodiscard]] Quaternion orientation(const Matrix3& at, double psi) const {
    const double c = std::cos(psi), s = std::sin(psi);
    Matrix3 turn;
    turn << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
    return Quaternion(Matrix3(at * turn * platform_.transpose())).normalized();
  }

 private:
  /// Chooses the leg whose platform axis is farthest from being collinear with another one.
  void choose_first() {
    double best = -1.0;
    for (int i = 0; i < 3; ++i) {
      const Vector3& v = g_.leg(i).v;
      const double least =
          std::min(v.cross(g_.leg((i + 1) % 3).v).norm(), v.cross(g_.leg((i + 2) % 3).v).norm());
      if (least > best + 1e-9) best = least, first_ = i;
    }
  }

  const SphericalGeometry& g_;
  const std::array<Vector3, 3>& w_;
  int first_ = 0;
  Matrix3 platform_;
  Vector3 e_, f_;
};

/// Values of ψ at which both closure equations hold. They are found from both equations at once, or from one
/// of them if the two are nearly dependent.
struct Candidates {
  int count = 0;
  std::array<double, 5> psi_rad{};

  void add(double psi) { psi_rad[static_cast<std::size_t>(count++)] = psi; }

  explicit Candidates(const std::array<Turn, 2>& t) {
    const double x = t[0].B * t[1].C - t[1].B * t[0].C, y = t[0].C * t[1].A - t[1].C * t[0].A;
    const double d = t[0].A * t[1].B - t[1].A * t[0].B;
    const double size[2] = {std::hypot(t[0].A, t[0].B), std::hypot(t[1].A, t[1].B)};
    if (d != 0.0) add(std::atan2(y / d, x / d));
    if (std::abs(d) > kDependentRows * size[0] * size[1]) return;
    for (std::size_t n = 0; n < 2; ++n) {
      if (size[n] < 1e-9) continue;
      const double middle = std::atan2(t[n].B, t[n].A);
      const double half = std::acos(std::clamp(-t[n].C / size[n], -1.0, 1.0));
      add(middle + half);
      add(middle - half);
    }
  }
};

/// Collects the distinct solutions of the closure equations.
class Collector {
 public:
  Collector(const SphericalGeometry& g, const std::array<Vector3, 3>& w) : g_(g), w_(w) {}

  /// Applies Newton's method to the closure equations, starting at q, and keeps the result.
  void polish(Quaternion q) {
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
      const Matrix3 R = q.toRotationMatrix();
      SphericalClosure leg[3];
      for (int i = 0; i < 3; ++i)
        leg[i] = SphericalClosure(w_[static_cast<std::size_t>(i)], R * g_.leg(i).v, g_.cos_alpha2());
      const Adjugate inverse(leg[0].n, leg[1].n, leg[2].n);
      const double residual =
          std::max({std::abs(leg[0].half_gap), std::abs(leg[1].half_gap), std::abs(leg[2].half_gap)});
      const double norm = std::sqrt(inverse.square());
      const bool singular = !(std::abs(inverse.volume) > kSingularSolution * norm);
      if (residual < kClosed && (singular || round == kRounds - 1)) return keep(q, singular);
      const Vector3 step = inverse.times(leg[0].half_gap, leg[1].half_gap, leg[2].half_gap) / -inverse.volume;
      const double length = step.norm();
      if (!(length < 1e3)) return;
      q = turned(clamp_norm(step, 0.5), q);
      if (length < 1e-8) return keep(q, false);
    }
  }

  [[nodiscard]] SphericalPoses result() const { return result_; }

 private:
  void keep(const Quaternion& q, bool singular) {
    if (singular) any_singular_ = true;
    for (int n = 0; n < result_.count; ++n) {
      const Quaternion other = result_.q[static_cast<std::size_t>(n)] * q.conjugate();
      if (other.vec().norm() < kSame) return;
    }
    if (result_.count == 8) return;
    result_.q[static_cast<std::size_t>(result_.count++)] = q;
    result_.status = any_singular_ ? SolutionStatus::kSingular : SolutionStatus::kFound;
  }

  const SphericalGeometry& g_;
  const std::array<Vector3, 3>& w_;
  bool any_singular_ = false;
  SphericalPoses result_;
};

}  // namespace

SphericalPoses SphericalKinematics::forward_all(const Vector3& theta_rad) const {
  if (!theta_rad.allFinite()) return {};
  std::array<Vector3, 3> w;
  for (int i = 0; i < 3; ++i)
    w[static_cast<std::size_t>(i)] = g_.middle_axis(i, std::cos(theta_rad[i]), std::sin(theta_rad[i]));
  const Elimination elimination(g_, w);
  std::array<double, OcticRoots::kSamples> F{};
  double scale = 0.0;
  for (std::size_t j = 0; j < F.size(); ++j) {
    const std::array<Turn, 2> t = elimination.turns(
        elimination.frame(2.0 * std::numbers::pi * static_cast<double>(j) / OcticRoots::kSamples));
    const double x = t[0].B * t[1].C - t[1].B * t[0].C, y = t[0].C * t[1].A - t[1].C * t[0].A;
    const double d = t[0].A * t[1].B - t[1].A * t[0].B;
    F[j] = x * x + y * y - d * d;
    scale = std::max(scale, x * x + y * y + d * d);
  }
  const OcticRoots roots = octic_roots(F, scale);
  Collector collector(g_, w);
  for (int r = 0; r < roots.count; ++r) {
    const Matrix3 at = elimination.frame(roots.phi_rad[static_cast<std::size_t>(r)]);
    const Candidates candidates(elimination.turns(at));
    for (int n = 0; n < candidates.count; ++n)
      collector.polish(elimination.orientation(at, candidates.psi_rad[static_cast<std::size_t>(n)]));
  }
  SphericalPoses result = collector.result();
  if (roots.outcome == OcticRoots::Outcome::kVanishes) result.status = SolutionStatus::kSingular;
  if (roots.outcome == OcticRoots::Outcome::kNotConverged) result.status = SolutionStatus::kNotConverged;
  return result;
}

}  // namespace longreach
