#pragma once
// What a robot's file says: where its tool points, and where its joints may be.

#include <memory>
#include <string>

#include "common/spatial/spatial.hpp"

namespace longreach {

class DescribedRobot {
 public:
  /// A file as longreach-slave has it in robot_file. Throws UsageError.
  explicit DescribedRobot(const std::string& file);
  ~DescribedRobot();

  /// R_WE with its joints there: rad, m of a prismatic one.
  [[nodiscard]] Matrix3 orientation(const Vector6& joint_rad) const;
  /// What is wrong with the joints, and what to do: for whoever wrote an adapter. Empty: nothing.
  struct Wrong {
    std::string text, advice;
  };
  [[nodiscard]] Wrong look(const Vector6& joint_rad) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
