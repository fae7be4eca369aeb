#pragma once
// A tool that gives way to what it touches, over one step: with the wrench w that acts on average it ends at
//   free ∘ C w,   C symmetric, positive semidefinite: what the wrench moves it by (a mass: dt²/(2 m),
//                 joints: J c Jᵀ)
// and w is the mean of the scene over that very move (Scene::mean_contact): implicit, one equation in w, by
// Newton. So whatever stands behind C, the contacts take as much energy as they get, for any stiffness, also
// several at once.

#include "slave/scene/scene.hpp"

namespace longreach {

using Compliance = Eigen::Matrix<double, 6, 6>;  // of [turn; way] by [moment; force], rad and m, in W at E

struct Yielded {
  Vector6 wrench = Vector6::Zero();  // mean over the step, by the scene on the tool
  ToolMotion to{};                   // where that brings the tool
  bool converged = true;  // false: `wrench` acts, but the scene would answer the move with another one
};

/// dt > 0, s.
Yielded yield(const Scene& scene, const ToolMotion& from, const ToolMotion& free,
              const Compliance& compliance, double dt);

}  // namespace longreach
