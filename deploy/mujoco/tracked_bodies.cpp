#include "deploy/mujoco/tracked_bodies.hpp"

#include <algorithm>

namespace longreach {

TrackedBodies::TrackedBodies(const mjModel& model) {
  for (int i = 1; i < model.nbody; ++i) {
    if (model.body_jntnum[i] != 1 || model.jnt_type[model.body_jntadr[i]] != mjJNT_FREE) continue;
    if (body_.size() < adapter::kBodiesMost) {
      body_.push_back(i);
      continue;
    }
    const char* name = mj_id2name(&model, mjOBJ_BODY, i);
    left_out_.push_back(name != nullptr ? name : "number " + std::to_string(i));
  }
}

adapter::BodiesDatagram TrackedBodies::poses(const mjData& data, double age_s) const {
  adapter::BodiesDatagram out;
  for (const int i : body_) {
    adapter::TrackedBody& one = out.body[out.count++];
    std::copy_n(data.xpos + 3 * i, 3, one.position_m);
    std::copy_n(data.xquat + 4 * i, 4, one.orientation);
    one.age_s = age_s;
  }
  return out;
}

}  // namespace longreach
