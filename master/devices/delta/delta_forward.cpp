#include <cmath>

#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach {
namespace {

constexpr double kFlat = 1e-6;  // ratio of height to rod below which the two assemblies are indistinguishable
// Maximum displacement in a tick, over the rod length and the volume of the unit rods at the start.
constexpr double kTrusted = 10.0;
constexpr double kAnyWay = 1e300;  // no limit, if the initial guess is not a previous position
constexpr double kInLine = 1e-7;   // |sin| of an angle of the triangle of centres below which it is a line

using Points = std::array<Vector3, 3>;

double sign(DeltaAssembly assembly) { return static_cast<double>(assembly); }

struct Intersection {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 p = Vector3::Zero();
};

/// Returns the point at the distance `rod` from three centres, on the positive or negative side of their
/// triangle.
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

using Legs = DeltaLegs;

Legs next(const Legs& a) { return {a[1], a[2], a[0], a[1]}; }
Legs after_next(const Legs& a) { return {a[2], a[0], a[1], a[2]}; }
double sum(const Legs& a) { return a[0] + a[1] + a[2]; }

class OffsetSolver {
 public:
  OffsetSolver(const DeltaGeometry& g, const Vector3& theta) : g_(g), elbow_(g.elbows(DeltaTurns(theta))) {}

  /// Iterates from `start` to a position that closes all loops in `assembly`.
  [[nodiscard]] DeltaPosition solve(const Vector3& start, DeltaAssembly assembly, double trusted) const;
  [[nodiscard]] Points elbows() const {
    Points all;
    for (int i = 0; i < 3; ++i) all[i] = {elbow_.x[i], elbow_.y[i], elbow_.z[i]};
    return all;
  }

 private:
  const DeltaGeometry& g_;
  DeltaLegVectors elbow_;
};

DeltaPosition OffsetSolver::solve(const Vector3& start, DeltaAssembly assembly, double trusted) const {
  const double length = g_.rod_m(), length2 = length * length, side = sign(assembly);
  const Legs &cos = g_.cos_azimuth(), &sin = g_.sin_azimuth();
  DeltaPosition result{SolutionStatus::kNotConverged, start, 0};
  double trust = 0.0;
  while (result.iterations < DeltaKinematics::kMaxIterations) {
    // The vector from the elbow to p, its outward component, and the fraction that remains after the offset
    // in the plane of the leg. The parallelogram is folded through itself if `share` (offset over distance in
    // the plane) exceeds 1.
    const Legs x = result.p_m.x() - elbow_.x, y = result.p_m.y() - elbow_.y, z = result.p_m.z() - elbow_.z;
    const Legs out = cos * x + sin * y;
    const Legs share = g_.offset_m() / (out * out + z * z).sqrt();
    const Legs less = share * out;
    const DeltaLegVectors n{x - less * cos, y - less * sin, z - share * z};
    const Legs excess = 0.5 * (n.x * n.x + n.y * n.y + n.z * n.z - length2);
    // n2 x n3, n3 x n1, n1 x n2
    const DeltaLegVectors one{next(n.x), next(n.y), next(n.z)},
        two{after_next(n.x), after_next(n.y), after_next(n.z)};
    const DeltaLegVectors across{one.y * two.z - one.z * two.y, one.z * two.x - one.x * two.z,
                                 one.x * two.y - one.y * two.x};
    const double volume = n.x[0] * across.x[0] + n.y[0] * across.y[0] + n.z[0] * across.z[0];
    const double regularity = volume * side / (length2 * length);
    if (!(regularity > kFlat)) {
      result.status = SolutionStatus::kSingular;
      return result;
    }
    if (result.iterations++ == 0) trust = trusted * length * regularity;
    Vector3 step =
        Vector3(sum(excess * across.x), sum(excess * across.y), sum(excess * across.z)) * (1.0 / volume);
    const double step2 = step.squaredNorm();
    if (step2 > length2 / 16.0) step *= 0.25 * length / std::sqrt(step2);
    result.p_m -= step;
    // The iteration converges quadratically: the error after this step is below rounding.
    if (step2 < 1e-17 * length2 * regularity * regularity) {
      if (!(share.maxCoeff() < 1.0)) return result;
      const bool near = (result.p_m - start).squaredNorm() <= trust * trust;
      result.status = near ? SolutionStatus::kFound : SolutionStatus::kSingular;
      return result;
    }
  }
  return result;
}

}  // namespace

DeltaPosition DeltaKinematics::forward(const Vector3& theta_rad, DeltaAssembly assembly,
                                       const Vector3& near_m) const {
  const OffsetSolver solver(g_, theta_rad);
  DeltaPosition result;
  if (g_.offset_m() == 0.0) {
    const Intersection point = intersect(solver.elbows(), g_.rod_m(), sign(assembly));
    result = {point.status, point.p, 0};
  } else {
    result = solver.solve(near_m, assembly, kTrusted);
  }
  if (result.status == SolutionStatus::kFound) return result;
  result.p_m = near_m.allFinite() ? near_m : Vector3::Zero();
  if (!theta_rad.allFinite()) result.status = SolutionStatus::kNoSolution;
  return result;
}

namespace {

void add(DeltaPositions& all, const Vector3& p, double same) {
  for (int n = 0; n < all.count; ++n) {
    if ((all.p_m[n] - p).norm() < same) return;
  }
  if (all.count < DeltaPositions::kMost) all.p_m[all.count++] = p;
}

/// Searches without a closed form and without a previous position. The initial guesses are the solutions for
/// the outer spheres, and then points all around the ends of the arms.
void search(const OffsetSolver& solver, const DeltaGeometry& g, DeltaAssembly first, DeltaPositions& all) {
  const double same = 1e-6 * g.rod_m();
  const auto from = [&](const Vector3& start, double side) {
    const auto assembly = static_cast<DeltaAssembly>(static_cast<int>(side));
    const DeltaPosition found = solver.solve(start, assembly, kAnyWay);
    if (found.status == SolutionStatus::kFound) add(all, found.p_m, same);
  };
  for (const double side : {sign(first), -sign(first)}) {
    const Intersection start = intersect(solver.elbows(), g.rod_m() + g.offset_m(), side);
    if (start.status == SolutionStatus::kFound) from(start.p, side);
  }
  const Vector3 middle = (solver.elbows()[0] + solver.elbows()[1] + solver.elbows()[2]) / 3.0;
  for (const double share : {1.0, 0.5}) {
    for (int n = 0; n < 27; ++n) {
      const Vector3 direction = Vector3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).stableNormalized();
      for (const double side : {1.0, -1.0})
        from(middle + share * (g.rod_m() + g.offset_m()) * direction, side);
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
