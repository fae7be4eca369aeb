#pragma once
// What the slave sends for display alone: telemetry and the poses of free bodies, with their ages. The age of the telemetry
// is the time since its arrival; the age of a body is its age when it was sent plus this time. Neither includes the time on
// the link. When a new session starts, the bodies of the previous one are forgotten, because the slave may have another
// scene.

#include "master/master_node.hpp"

namespace longreach {

class FarPicture {
 public:
  void receive(const MasterInput& input, MasterView& view) {
    for (const auto& received : input.telemetry) {
      if (!received.newest) continue;
      view.far = received.message;
      telemetry_at_ = input.now;
      view.far_known = true;
    }
    if (input.peer_restarts != restarts_) view.bodies = bodies_ = {};
    restarts_ = input.peer_restarts;
    for (const auto& received : input.bodies) {
      if (!received.newest) continue;
      bodies_ = received.message;
      bodies_at_ = input.now;
    }
  }

  void publish_ages(Time now, MasterView& view) const {
    view.far_age_s = view.far_known ? to_seconds(now - telemetry_at_) : 0.0;
    if (bodies_.empty() && view.bodies.empty()) return;
    view.bodies = bodies_;
    for (auto& body : view.bodies.body)
      if (body) body->age_s += to_seconds(now - bodies_at_);
  }

 private:
  Time telemetry_at_{}, bodies_at_{};  // arrival of the newest ones
  BodyPoses bodies_{};                 // as received
  std::uint32_t restarts_ = 0;
};

}  // namespace longreach
