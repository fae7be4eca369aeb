#include "deploy/library/include/longreach/robot_arm.hpp"

#include <cmath>

#include "common/config/config.hpp"
#include "deploy/library/files.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {
namespace {

constexpr std::uint32_t kSearches = 32;

RobotConfig read(const std::string& file, const ArmLinks& links) {
  const FileSearch search = library_search();
  proto::SlaveConfig config;
  config.set_robot_file(search.find_named("robot", "robots", file).string());
  config.mutable_scene();
  if (!links.base_link.empty()) config.mutable_robot()->set_base_link(links.base_link);
  if (!links.tip_link.empty()) config.mutable_robot()->set_tip_link(links.tip_link);
  resolve_files(config, search, nullptr);
  return to_struct(config).robot;
}

JointVector checked(const Eigen::VectorXd& joints) {
  if (joints.size() != kMaxJoints)
    throw InputError("the arm has " + std::to_string(kMaxJoints) + " joints, and " +
                     std::to_string(joints.size()) + " values were given");
  if (!joints.allFinite()) throw InputError("a joint value is not finite");
  return joints;
}

Pose checked(const Eigen::Isometry3d& X) {
  if (!X.matrix().allFinite()) throw InputError("the pose of the tool is not finite");
  return {X.translation(), Quaternion(X.rotation()).normalized()};
}

ArmStatus status_of(InverseStatus status) {
  return status == InverseStatus::kFound     ? ArmStatus::kFound
         : status == InverseStatus::kNearest ? ArmStatus::kNearest
                                             : ArmStatus::kSingular;
}

}  // namespace

struct RobotArm::State {
  explicit State(const RobotConfig& r) : robot(r), inverse(r) {}
  RobotConfig robot;
  Inverse inverse;
};

RobotArm::RobotArm(const std::string& file, const ArmLinks& links)
    : state_(with_input_errors([&] { return std::make_unique<State>(read(file, links)); })) {}
RobotArm::~RobotArm() = default;
RobotArm::RobotArm(RobotArm&&) noexcept = default;
RobotArm& RobotArm::operator=(RobotArm&&) noexcept = default;

std::string RobotArm::name() const { return state_->robot.name; }

std::vector<ArmJoint> RobotArm::joints() const {
  std::vector<ArmJoint> joints;
  for (const JointConfig& j : state_->robot.joint)
    joints.push_back({j.name, j.kind == JointKind::kPrismatic, j.min_rad, j.max_rad, j.speed_max_rad_per_s});
  return joints;
}

Eigen::VectorXd RobotArm::start() const { return start_joints(state_->robot); }
std::string RobotArm::inverse_kind() const { return std::string(state_->inverse.words()); }

Eigen::Isometry3d RobotArm::forward(const Eigen::VectorXd& joints) const {
  const Rigid X = state_->inverse.kinematics().rigid_forward(checked(joints));
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = X.R;
  result.translation() = X.p;
  return result;
}

Eigen::MatrixXd RobotArm::jacobian(const Eigen::VectorXd& joints) const {
  return state_->inverse.kinematics().rigid_with_jacobian(checked(joints)).J;
}

std::vector<Eigen::VectorXd> RobotArm::inverse_all(const Eigen::Isometry3d& X_WE,
                                                   const Eigen::VectorXd& near) const {
  const InverseSolutions all = state_->inverse.all(checked(X_WE), checked(near), {.restarts_max = kSearches});
  return {all.joint_rad.begin(), all.joint_rad.begin() + all.count};
}

ArmSolution RobotArm::inverse_nearest(const Eigen::Isometry3d& X_WE, const Eigen::VectorXd& near) const {
  const InverseResult r = state_->inverse.solve(checked(X_WE), checked(near), {.restarts_max = kSearches});
  return {.status = status_of(r.status),
          .joints = r.joint_rad,
          .position_error_m = r.position_error_m,
          .rotation_error_rad = r.rotation_error_rad,
          .conditioning = r.conditioning,
          .at_joint_limit = r.at_joint_limit};
}

}  // namespace longreach
