#pragma once
// Direct force reflection: the most recently received environment force is applied to the hand.
//
//   F_m = F_e[k-d]
//
// The last force is held until the next report arrives. The loop is unstable above a wall stiffness that
// depends on the delay.

#include "deploy/lab/comparison/comparison_port.hpp"

namespace longreach {

class DirectLaw {
 public:
  ComparisonOutput step(const ComparisonInput& in, double /*dt_s*/) {
    if (in.report) force_n_ = in.report->force_n;
    return {.force_n = force_n_, .command = {.position_m = in.position_m}};
  }

 private:
  Vector3 force_n_ = Vector3::Zero();
};

}  // namespace longreach
