#pragma once
// Kinematics of a robot arm from its file: Denavit-Hartenberg rows (.txtpb) or URDF. Frames: W is the robot's
// world, E the tool; X_WE is the pose of E in W. The inverse is in closed form if the arm has one, otherwise
// numeric. Joints are in the order of the chain; revolute joints are in rad, prismatic joints in m. Only arms
// with six joints are supported.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace longreach {

enum class ArmStatus : std::uint8_t {
  kFound,    // the tool reaches the goal
  kNearest,  // out of reach or beyond the joint limits; the errors give the deviation
  kSingular  // the tool reaches the goal but cannot move from there in one direction
};

struct ArmSolution {
  ArmStatus status = ArmStatus::kNearest;
  Eigen::VectorXd joints;           // within the joint limits
  double position_error_m = 0.0;    // distance of the tool from the goal
  double rotation_error_rad = 0.0;  // rotation of the tool relative to the goal
  double conditioning = 0.0;        // minimum singular value of the scaled Jacobian; 0 at a singular pose
  bool at_joint_limit = false;
};

struct ArmJoint {
  std::string name;
  bool prismatic = false;
  double min = 0.0, max = 0.0;  // rad or m
  double speed_max = 0.0;       // rad/s or m/s
};

/// The first and last link of the arm in a URDF. Needed only if the file contains several chains.
struct ArmLinks {
  std::string base_link, tip_link;  // empty: the only possible link
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
  [[nodiscard]] Eigen::VectorXd start() const;     // joint positions of the start pose
  [[nodiscard]] std::string inverse_kind() const;  // the method in use, in words

  /// forward() and jacobian() throw InputError unless `joints` has one finite value per joint.
  [[nodiscard]] Eigen::Isometry3d forward(const Eigen::VectorXd& joints) const;
  /// 6 rows: angular velocity of E in W, then linear velocity of the origin of E, per rad/s or m/s of each joint.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& joints) const;

  /// Returns all solutions, ignoring joint limits, with each angle shifted by full turns to be as close as
  /// possible to `near`. Without a closed form, returns the solutions found by a search from 32 starting
  /// points. Throws InputError if the goal is not finite.
  [[nodiscard]] std::vector<Eigen::VectorXd> inverse_all(const Eigen::Isometry3d& X_WE,
                                                         const Eigen::VectorXd& near) const;
  /// Returns the preferred solution within the joint limits, or the closest pose if there is none. Throws
  /// InputError if a value is not finite.
  [[nodiscard]] ArmSolution inverse_nearest(const Eigen::Isometry3d& X_WE, const Eigen::VectorXd& near) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
