#pragma once
// Motion of a tool that yields to contacts over one step. Under the mean wrench w the tool ends at
//   free ∘ C w,   C symmetric, positive semidefinite: displacement by the wrench (a mass: dt²/(2 m),
//                 joints: J c Jᵀ)
// The pose `free` is the end pose without contact. w is the mean wrench of the scene over this move
// (Scene::mean_contact), so the equation for w is implicit; Newton iteration solves it. For any C, any
// stiffness, and several simultaneous contacts, the contacts receive exactly the energy that the tool loses.

#include "slave/simulation/scene/scene.hpp"

namespace longreach {

/// Derivative of [turn; way] with respect to [moment; force], in rad and m, in W at E.
using Compliance = Eigen::Matrix<double, 6, 6>;

struct Yielded {
  Vector6 wrench = Vector6::Zero();  // mean wrench of the scene on the tool over the step
  ToolMotion to{};                   // motion of the tool at the end of the step
  /// If false, `wrench` was applied but differs from the response of the scene to the move.
  bool converged = true;
};

/// Computes one step of `dt` > 0 s; `free` is the motion of the tool at the end of the step without contact.
Yielded yield(const Scene& scene, const ToolMotion& from, const ToolMotion& free,
              const Compliance& compliance, double dt);

}  // namespace longreach
