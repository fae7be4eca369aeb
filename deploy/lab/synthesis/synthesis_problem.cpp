#include "deploy/lab/synthesis/synthesis_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/core/check.hpp"

namespace longreach {
namespace {

constexpr double kUnit_m = 0.1;

using Positions = std::array<Vector3, SynthesisProblem::kPositions>;

/// In a cube from -1 to 1.
Positions half_cube() {
  Positions positions;
  std::size_t count = 0;
  for (int n = 0; n < 9 * 5 * 9; ++n) {
    const Vector3 place = Vector3(n % 9 - 4, n / 9 % 5, n / 45 - 4) / 4.0;
    const Vector3 size = place.cwiseAbs();
    const bool on_edge = (size.array() == 1.0).count() >= 2;
    const bool is_middle = (size.array() == 0.0 || size.array() == 1.0).all();
    if (on_edge || is_middle) positions.at(count++) = place;
  }
  CHECK(count == positions.size());
  return positions;
}

}  // namespace

DeltaGeometry geometry(const SynthesisDesign& d) {
  constexpr double kThird = 2.0 * std::numbers::pi / 3.0;
  return DeltaGeometry(DeltaSimple{d.a_m, d.l1_m, d.l2_m, {0.0, kThird, 2.0 * kThird}});
}

DeltaCube cube(const SynthesisDesign& d) { return {{0.0, 0.0, -d.depth_m}, d.side_m}; }

SynthesisProblem::Variables SynthesisProblem::variables(const SynthesisDesign& d, double conditioning) const {
  Variables x;
  x << d.a_m, d.l1_m, d.l2_m, d.depth_m, d.side_m;
  x /= kUnit_m;
  if (aims_at_conditioning()) x[4] = conditioning;
  return x;
}

SynthesisDesign SynthesisProblem::dimensions(const Variables& x) const {
  return {kUnit_m * x[0], kUnit_m * x[1], kUnit_m * x[2], kUnit_m * x[3],
          aims_at_conditioning() ? side_m_ : kUnit_m * x[4]};
}

SynthesisProblem::Evaluation SynthesisProblem::evaluate(const Variables& x) const {
  static const Positions kPlaces = half_cube();
  const SynthesisDesign d = dimensions(x);
  const DeltaGeometry g = geometry(d);
  const DeltaCube c = cube(d);
  DeltaDemand demand = demand_;
  if (aims_at_conditioning()) demand.conditioning = x[4];
  Evaluation result;
  double conditioning = 1.0, least = 0.0;
  Eigen::Index row = 0;
  for (const Vector3& place : kPlaces) {
    const DeltaFigures at = figures(g, c.centre_m + 0.5 * c.side_m * place);
    const DeltaSlacks slack = slacks(g, demand, c, at);
    result.slacks.segment<12>(row) = slack;
    row += slack.size();
    conditioning = std::min(conditioning, at.conditioning);
    least = std::min(least, slack.head<kDeltaConditioningSlack>().minCoeff());
    if (!aims_at_conditioning()) least = std::min(least, slack[kDeltaConditioningSlack]);
  }
  result.violation = std::abs(least);
  result.value = aims_at_conditioning() ? conditioning : d.side_m;
  return result;
}

}  // namespace longreach
