#pragma once
// The dimensional synthesis of a DELTA device as a smooth optimisation problem in five variables: the
// dimensions a, l1 and l2, the depth of the centre of the cube below the base, and the objective g.
//
//   maximise g  subject to  s_jk(a, l1, l2, depth, side, conditioning) >= 0    (12 slacks k, 54 positions j)
//
// As in the paper, objective and constraint can be interchanged: g is either the side of the cube or the
// conditioning, and the other one is prescribed. The worst conditioning over the cube is a minimum and
// therefore not smooth; the problem becomes smooth if the worst conditioning is a variable that is bounded
// above by the conditioning at each position (epigraph form). Because the legs are at 0, 120 and 240 degrees,
// the half y >= 0 of the cube is sufficient. The constraints are evaluated at nine positions on each edge, where
// the worst values were found, and at the centres of the faces and of the cube. Lengths are in units of 0.1
// m.

#include <cstdint>
#include <vector>

#include "deploy/lab/synthesis/delta_design.hpp"

namespace longreach {

enum class SynthesisGoal : std::uint8_t { kConditioning, kSide };

struct SynthesisDesign {
  double a_m = 0.0;
  double l1_m = 0.0;
  double l2_m = 0.0;
  double depth_m = 0.0;  // depth of the centre of the cube below the base
  double side_m = 0.0;   // side of the cube
};
DeltaGeometry geometry(const SynthesisDesign& d);
DeltaCube cube(const SynthesisDesign& d);

class SynthesisProblem {
 public:
  using Variables = Eigen::Matrix<double, 5, 1>;  // a, l1, l2, depth, goal
  static constexpr int kPositions = 54;
  static constexpr int kSlacks = 12 * kPositions;
  using Slacks = Eigen::Matrix<double, kSlacks, 1>;
  static constexpr double kTolerance = 1e-6;  // violation above which a design is infeasible

  /// If the goal is kConditioning, the cube has the side `side_m`, and `demand.conditioning` is ignored. If
  /// the goal is kSide, `side_m` is ignored.
  SynthesisProblem(SynthesisGoal goal, const DeltaDemand& demand, double side_m)
      : goal_(goal), demand_(demand), side_m_(side_m) {}

  [[nodiscard]] Variables low() const { return {0.05, 0.3, 0.4, 0.2, 0.05}; }
  [[nodiscard]] Variables high() const { return {0.6, 1.5, 2.5, 2.5, aims_at_conditioning() ? 1.0 : 2.0}; }
  [[nodiscard]] Variables variables(const SynthesisDesign& d, double conditioning) const;
  [[nodiscard]] SynthesisDesign dimensions(const Variables& x) const;
  [[nodiscard]] bool aims_at_conditioning() const { return goal_ == SynthesisGoal::kConditioning; }

  struct Evaluation {
    Slacks slacks;       // margins in the epigraph form
    double value = 0.0;  // objective achieved by the dimensions: the worst conditioning, or the side in m
    /// Magnitude of the most negative margin of the dimensions. The variable of the objective is not used.
    double violation = 0.0;
  };
  [[nodiscard]] Evaluation evaluate(const Variables& x) const;

 private:
  SynthesisGoal goal_;
  DeltaDemand demand_;
  double side_m_;
};

}  // namespace longreach
