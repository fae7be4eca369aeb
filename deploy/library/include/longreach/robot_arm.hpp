#pragma once
// Kinematics of a robot arm from its file: Denavit-Hartenberg rows (.txtpb) or URDF. Frames: W is the robot's world, E the
// tool; X_WE is the pose of E in W. Closed form where the arm has one, numeric search otherwise. Joints are in the order of
// the chain; revolute joints in rad, prismatic joints in m. An arm has six joints in this version.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace longreach {

enum class ArmStatus : std::uint8_t {
  kFound,    // the tool reaches the goal
  kNearest,  // out of reach or beyond joint limits: the errors give the deviation
  kSingular  // the tool reaches the goal, and cannot move from there in one direction
};

struct ArmSolution {
  ArmStatus status = ArmStatus::kNearest;
  Eigen::VectorXd joints;           // within the joint limits
  double position_error_m = 0.0;    // of the tool from the goal
  double rotation_error_rad = 0.0;  // likewise
  double conditioning = 0.0;        // smallest singular value of the scaled Jacobian: 0 at a singular pose
  bool at_joint_limit = false;
};

struct ArmJoint {
  std::string name;
  bool prismatic = false;
  double min = 0.0, max = 0.0;  // rad or m
  double speed_max = 0.0;       // rad/s or m/s
};

/// The chain of a URDF, where the file leaves a choice.
struct ArmLinks {
  std::string base_link, tip_link;  // empty: the only possible ones
};

class [[gnu::visibility("default")]] RobotArm {
 public:
  /// `file`: a .txtpb or .urdf file, or the name of an installed robot, e.g. "ur5e". Throws InputError with file and line.
  explicit RobotArm(const std::string& file, const ArmLinks& links = {});
  ~RobotArm();
  RobotArm(RobotArm &&) noexcept;
  RobotArm& operator=(RobotArm&&) noexcept;

  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::vector<ArmJoint> joints() const;
  [[nodiscard]] Eigen::VectorXd start() const;     // joints where the robot starts
  [[nodiscard]] std::string inverse_kind() const;  // description of the inverse that applies

  /// Throw InputError unless `joints` has one finite value a joint.
  [[nodiscard]] Eigen::Isometry3d forward(const Eigen::VectorXd& joints) const;
  /// 6 rows: angular velocity of E in W, then linear velocity of its origin; per rad/s or m/s of each joint.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& joints) const;

  /// Returns all solutions, ignoring joint limits, with each angle shifted by full turns to be nearest to `near`. Without
  /// a closed form, returns the solutions found by a search from 32 starting points. Throws InputError if the goal is not finite.
  [[nodiscard]] std::vector<Eigen::VectorXd> inverse_all(const Eigen::Isometry3d& X_WE,
                                                         const Eigen::VectorXd& near) const;
  /// The preferred solution within the joint limits, else the nearest pose. Throws InputError likewise.
  [[nodiscard]] ArmSolution inverse_nearest(const Eigen::Isometry3d& X_WE, const Eigen::VectorXd& near) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
