#pragma once
// The dimensional synthesis of a DELTA as a smooth problem in five variables: the dimensions a, l1, l2, the
// depth of the cube's centre below the base, and the goal g.
//
//   maximise g  subject to  s_jk(a, l1, l2, depth, side, conditioning) >= 0    (12 slacks k, 54 positions j)
//
// The paper interchanges objective and constraint: either side or conditioning is g, and the other one is
// required. The worst conditioning over the cube, a minimum, is not smooth; as a variable below the
// conditioning of each position (epigraph) it is. Legs are at 0, 120, 240 degrees, so the half y >= 0 of the
// cube is sufficient: nine positions per edge, where the worst values were found, and the middles of its
// faces and of itself. Lengths in units of 0.1 m.

#include <cstdint>
#include <vector>

#include "deploy/lab/synthesis/delta_design.hpp"

namespace longreach {

enum class SynthesisGoal : std::uint8_t { kConditioning, kSide };

struct SynthesisDesign {
  double a_m = 0.0;
  double l1_m = 0.0;
  double l2_m = 0.0;
  double depth_m = 0.0;  // of the centre of the cube below the base
  double side_m = 0.0;   // of the cube
};
DeltaGeometry geometry(const SynthesisDesign& d);
DeltaCube cube(const SynthesisDesign& d);

class SynthesisProblem {
 public:
  using Variables = Eigen::Matrix<double, 5, 1>;  // a, l1, l2, depth, goal
  static constexpr int kPositions = 54;
  static constexpr int kSlacks = 12 * kPositions;
  using Slacks = Eigen::Matrix<double, kSlacks, 1>;
  static constexpr double kTolerance = 1e-6;  // margin below which a design is infeasible

  /// Goal kConditioning: a cube of `side_m`; `demand.conditioning` is ignored. Goal kSide: vice versa.
  SynthesisProblem(SynthesisGoal goal, const DeltaDemand& demand, double side_m)
      : goal_(goal), demand_(demand), side_m_(side_m) {}

  [[nodiscard]] Variables low() const { return {0.05, 0.3, 0.4, 0.2, 0.05}; }
  [[nodiscard]] Variables high() const { return {0.6, 1.5, 2.5, 2.5, aims_at_conditioning() ? 1.0 : 2.0}; }
  [[nodiscard]] Variables variables(const SynthesisDesign& d, double conditioning) const;
  [[nodiscard]] SynthesisDesign dimensions(const Variables& x) const;
  [[nodiscard]] bool aims_at_conditioning() const { return goal_ == SynthesisGoal::kConditioning; }

  struct Evaluation {
    Slacks slacks;           // of the epigraph form
    double value = 0.0;      // result of the dimensions: worst conditioning, or the side in m
    double violation = 0.0;  // largest negative margin of the dimensions, without the variable of the goal
  };
  [[nodiscard]] Evaluation evaluate(const Variables& x) const;

 private:
  SynthesisGoal goal_;
  DeltaDemand demand_;
  double side_m_;
};

}  // namespace longreach
