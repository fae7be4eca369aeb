#include <cmath>

#include "common/spatial/sin_cos.hpp"
#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kFlat = 1e-6;    // height over rod below which the two assemblies cannot be told apart
constexpr double kInLine = 1e-7;  // |sin| of the angle in the triangle of centres below which it is a line

using Points = std::array<Vector3, 3>;

double sign(DeltaAssembly assembly) { return static_cast<double>(assembly); }

struct Intersection {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 p = Vector3::Zero();
};

/// The point at distance `rod` from three centres, on the positive or negative side of their triangle.
Intersection intersect(const Points& centre, double rod, double side) {
  const Vector3 a = centre[1] - centre[0];
  const Vector3 b = centre[2] - centre[0];
  const Vector3 n = a.cross(b);
  const double a2 = a.squaredNorm(), b2 = b.squaredNorm(), n2 = n.squaredNorm();
  Intersection result;
  if (!(n2 > kInLine * kInLine * a2 * b2)) {
    if (n2 >= 0.0) result.status = SolutionStatus::kSingular;
    return result;
  }
  const Vector3 middle = (a2 * b - b2 * a).cross(n) * (0.5 / n2);
  const double height2 = rod * rod - middle.squaredNorm();
  const double flat2 = kFlat * kFlat * rod * rod;
  if (!(height2 > -flat2)) return result;
  if (height2 < flat2) {
    result.status = SolutionStatus::kSingular;
    return result;
  }
  result.status = SolutionStatus::kFound;
  result.p = centre[0] + middle + side * std::sqrt(height2 / n2) * n;
  return result;
}

class OffsetSolver {
 public:
  OffsetSolver(const DeltaGeometry& g, const Vector3& theta) : g_(g) {
    for (int i = 0; i < 3; ++i) {
      const SinCos turn = sin_cos(theta[i]);
      elbow_[i] = g.elbow(i, turn.c, turn.s);
    }
  }

  /// Centres of the spheres that touch the three surfaces as seen from p.
  [[nodiscard]] Points centres(const Vector3& p) const {
    Points centre;
    for (int i = 0; i < 3; ++i) {
      Vector3 in_plane = g_.to_leg(i, p - elbow_[i]);
      in_plane.y() = 0.0;
      const double distance = in_plane.norm();
      const Vector3 shift = distance > 0.0 ? Vector3(in_plane * (g_.offset_m() / distance)) : Vector3::Zero();
      centre[i] = elbow_[i] + g_.to_world(i, shift);
    }
    return centre;
  }

  /// From the spheres that touch at `start`; ends in `assembly` or without a result.
  [[nodiscard]] DeltaPosition solve(const Vector3& start, DeltaAssembly assembly) const;
  /// From `start` to any position that closes all loops.
  [[nodiscard]] DeltaPosition newton(Vector3 p) const;
  [[nodiscard]] const Points& elbows() const { return elbow_; }

  /// Volume of the three rods: its sign is the assembly.
  [[nodiscard]] double volume(const Vector3& p) const {
    const Points centre = centres(p);
    return (p - centre[0]).dot((p - centre[1]).cross(p - centre[2]));
  }

 private:
  /// Beyond the offset in every leg: the parallelograms cannot fold through themselves.
  [[nodiscard]] bool is_outside(const Vector3& p) const {
    for (int i = 0; i < 3; ++i) {
      const Vector3 in_leg = g_.to_leg(i, p - elbow_[i]);
      if (!(std::hypot(in_leg.x(), in_leg.z()) >= g_.offset_m())) return false;
    }
    return true;
  }

  const DeltaGeometry& g_;
  Points elbow_;
};

DeltaPosition OffsetSolver::newton(Vector3 p) const {
  const double rod = g_.rod_m();
  DeltaPosition result{SolutionStatus::kNotConverged, p, 0};
  while (result.iterations < DeltaKinematics::kMaxIterations) {
    ++result.iterations;
    const Points centre = centres(p);
    Points n;
    Vector3 excess;
    for (int i = 0; i < 3; ++i) {
      n[i] = p - centre[i];
      const double length = n[i].norm();
      if (!(length > 0.0)) return {SolutionStatus::kSingular, p, result.iterations};
      n[i] /= length;
      excess[i] = length - rod;
    }
    const Vector3 c23 = n[1].cross(n[2]);
    const double volume = n[0].dot(c23);
    if (!(std::abs(volume) > kFlat)) return {SolutionStatus::kSingular, p, result.iterations};
    const Vector3 step =
        (excess[0] * c23 + excess[1] * n[2].cross(n[0]) + excess[2] * n[0].cross(n[1])) / volume;
    p -= clamp_norm(step, 0.25 * rod);
    // The iteration squares its error: what is left after this step is below rounding.
    if (step.squaredNorm() < 1e-18 * rod * rod * volume * volume) {
      result.status = is_outside(p) ? SolutionStatus::kFound : SolutionStatus::kNotConverged;
      result.p_m = p;
      break;
    }
  }
  return result;
}

DeltaPosition OffsetSolver::solve(const Vector3& start, DeltaAssembly assembly) const {
  const Intersection first = intersect(centres(start), g_.rod_m(), sign(assembly));
  DeltaPosition result = newton(first.status == SolutionStatus::kFound ? first.p : start);
  if (result.status == SolutionStatus::kFound && !(volume(result.p_m) * sign(assembly) > 0.0))
    result.status = SolutionStatus::kSingular;
  return result;
}

}  // namespace

DeltaPosition DeltaKinematics::forward(const Vector3& theta_rad, DeltaAssembly assembly,
                                       const Vector3& near_m) const {
  const Vector3 previous = near_m.allFinite() ? near_m : Vector3::Zero();
  if (!theta_rad.allFinite()) return {SolutionStatus::kNoSolution, previous, 0};
  const OffsetSolver solver(g_, theta_rad);
  if (g_.offset_m() == 0.0) {
    const Intersection point = intersect(solver.elbows(), g_.rod_m(), sign(assembly));
    return {point.status, point.status == SolutionStatus::kFound ? point.p : previous, 0};
  }
  DeltaPosition result = solver.solve(previous, assembly);
  if (result.status != SolutionStatus::kFound) result.p_m = previous;
  return result;
}

namespace {

void add(DeltaPositions& all, const Vector3& p, double same) {
  for (int n = 0; n < all.count; ++n) {
    if ((all.p_m[n] - p).norm() < same) return;
  }
  if (all.count < DeltaPositions::kMost) all.p_m[all.count++] = p;
}

/// Without a closed form and without a previous position: from the outer spheres, then from all around the
/// arms' ends.
void search(const OffsetSolver& solver, const DeltaGeometry& g, DeltaAssembly first, DeltaPositions& all) {
  const double same = 1e-6 * g.rod_m();
  for (const double side : {sign(first), -sign(first)}) {
    const Intersection start = intersect(solver.elbows(), g.rod_m() + g.offset_m(), side);
    if (start.status != SolutionStatus::kFound) continue;
    const DeltaPosition found = solver.solve(start.p, static_cast<DeltaAssembly>(static_cast<int>(side)));
    if (found.status == SolutionStatus::kFound) add(all, found.p_m, same);
  }
  const Vector3 middle = (solver.elbows()[0] + solver.elbows()[1] + solver.elbows()[2]) / 3.0;
  for (const double share : {1.0, 0.5}) {
    for (int n = 0; n < 27; ++n) {
      const Vector3 direction = Vector3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).stableNormalized();
      const DeltaPosition found = solver.newton(middle + share * (g.rod_m() + g.offset_m()) * direction);
      if (found.status == SolutionStatus::kFound) add(all, found.p_m, same);
    }
  }
}

}  // namespace

DeltaPositions DeltaKinematics::forward_all(const Vector3& theta_rad) const {
  DeltaPositions result;
  if (!theta_rad.allFinite()) return result;
  const OffsetSolver solver(g_, theta_rad);
  const DeltaAssembly first = g_.working_assembly();
  if (g_.offset_m() > 0.0) {
    search(solver, g_, first, result);
  } else {
    for (const double side : {sign(first), -sign(first)}) {
      const Intersection point = intersect(solver.elbows(), g_.rod_m(), side);
      if (point.status == SolutionStatus::kFound) result.p_m[result.count++] = point.p;
      result.status = point.status;
    }
  }
  if (result.count > 0) result.status = SolutionStatus::kFound;
  return result;
}

}  // namespace longreach
