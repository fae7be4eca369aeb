#pragma once
// Content of a robot file: orientation of the tool, and ranges of the joints.

#include <memory>
#include <string>

#include "common/spatial/spatial.hpp"

namespace longreach {

class DescribedRobot {
 public:
  /// Reads a file like robot_file of longreach-slave. Throws UsageError.
  explicit DescribedRobot(const std::string& file);
  ~DescribedRobot();

  /// R_WE at these joints: rad, m for a prismatic one.
  [[nodiscard]] Matrix3 orientation(const Vector6& joint_rad) const;
  /// What is wrong with the joints, and a remedy, for the author of an adapter. Empty: nothing.
  struct Wrong {
    std::string text, advice;
  };
  [[nodiscard]] Wrong look(const Vector6& joint_rad) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
