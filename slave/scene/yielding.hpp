#pragma once
// A tool that yields to contacts, over one step: under the mean wrench w it ends at
//   free ∘ C w,   C symmetric, positive semidefinite: displacement by the wrench (a mass: dt²/(2 m),
//                 joints: J c Jᵀ)
// and w is the mean wrench of the scene over this move (Scene::mean_contact): an implicit equation in w,
// solved by Newton iteration. For any C the contacts therefore receive exactly the energy that the tool
// loses, for any stiffness, also for several contacts at once.

#include "slave/scene/scene.hpp"

namespace longreach {

using Compliance = Eigen::Matrix<double, 6, 6>;  // of [turn; way] by [moment; force], rad and m, in W at E

struct Yielded {
  Vector6 wrench = Vector6::Zero();  // mean over the step, by the scene on the tool
  ToolMotion to{};                   // resulting motion of the tool
  bool converged = true;  // false: `wrench` acts, but differs from the response of the scene to the move
};

/// dt > 0, s.
Yielded yield(const Scene& scene, const ToolMotion& from, const ToolMotion& free,
              const Compliance& compliance, double dt);

}  // namespace longreach
