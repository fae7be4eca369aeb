#pragma once
// The free bodies of an MJCF file, which a robot that MuJoCo simulates tracks: those with a free joint, in the order of the
// file, at most adapter::kBodiesMost.

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "common/link/adapter_datagram.hpp"

namespace longreach {

class TrackedBodies {
 public:
  explicit TrackedBodies(const mjModel& model);

  /// Whether the file has at least one.
  [[nodiscard]] bool any() const { return !body_.empty(); }
  /// Names of the free bodies that are not tracked, because the file has too many; "number N" for one without a name.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }
  /// The poses of the bodies' frames in the world of the file, with the age `age_s`.
  [[nodiscard]] adapter::BodiesDatagram poses(const mjData& data, double age_s) const;

 private:
  std::vector<int> body_;  // indices in the model
  std::vector<std::string> left_out_;
};

}  // namespace longreach
