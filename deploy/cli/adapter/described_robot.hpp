#pragma once
// What an adapter check needs from a robot file: the orientation of the tool and the joint limits.

#include <memory>
#include <string>

#include "common/spatial/spatial.hpp"

namespace longreach {

class DescribedRobot {
 public:
  /// Reads a file in the same way as the setting robot_file of longreach-slave. Throws UsageError.
  explicit DescribedRobot(const std::string& file);
  ~DescribedRobot();

  /// R_WE at these joint positions, in rad (m for a prismatic joint).
  [[nodiscard]] Matrix3 orientation(const Vector6& joint_rad) const;
  /// The reason why joint positions are implausible, and a remedy, both addressed to the author of the
  /// adapter. Both are empty if the positions are plausible.
  struct Wrong {
    std::string text, advice;
  };
  [[nodiscard]] Wrong look(const Vector6& joint_rad) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
