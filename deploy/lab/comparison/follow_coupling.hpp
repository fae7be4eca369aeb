#pragma once
// Direct force reflection at the slave: the tool moves to the delayed position of the handle, x_s = x_m[k-d],
// and the measured force is reported.

#include "deploy/lab/comparison/coupling_port.hpp"

namespace longreach {

class FollowCoupling {
 public:
  CouplingOutput step(const CouplingInput& in, double /*dt_s*/) {
    const Vector3 at_m = x_m_;
    if (in.command) x_m_ = in.command->position_m;
    return {.setpoint_m = x_m_, .report = {.position_m = at_m, .force_n = in.force_n}};
  }

 private:
  Vector3 x_m_ = Vector3::Zero();
};

}  // namespace longreach
