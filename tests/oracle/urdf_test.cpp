// URDF files as two other readers see them: urdfdom's model as a chain of KDL (Orocos), and MuJoCo's own
// reader. Forward kinematics agree.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <memory>

#include "common/config/config.hpp"
#include "common/config/robot/urdf.hpp"
#include "common/core/random.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "tests/support/random_urdf.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::urdf_test {
namespace {

constexpr int kPoses = 10000;
constexpr double kOfReach = 1e-12;

RobotConfig robot_of(const std::string& text) {
  proto::SlaveConfig config;
  proto::Robot wanted;
  wanted.set_tip_link("tip");
  *config.mutable_robot() = read_urdf("drawn.urdf", text, wanted);
  return to_struct(config).robot;
}

KDL::Vector to_kdl(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// As kdl_parser does it: the axis in the frame of the parent link.
KDL::Segment segment_of(const urdf::Joint& joint) {
  const urdf::Pose& X = joint.parent_to_joint_origin_transform;
  const KDL::Frame frame(KDL::Rotation::Quaternion(X.rotation.x, X.rotation.y, X.rotation.z, X.rotation.w),
                         to_kdl(X.position));
  const KDL::Vector axis = frame.M * to_kdl(joint.axis);
  if (joint.type == urdf::Joint::FIXED) return KDL::Segment(KDL::Joint(joint.name, KDL::Joint::None), frame);
  const auto type = joint.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
  return KDL::Segment(KDL::Joint(joint.name, frame.p, axis, type), frame);
}

KDL::Chain chain_of(const std::string& text, const std::string& tip) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  std::vector<KDL::Segment> segments;
  for (urdf::LinkConstSharedPtr link = model->getLink(tip); link->parent_joint; link = link->getParent())
    segments.insert(segments.begin(), segment_of(*link->parent_joint));
  KDL::Chain chain;
  for (const KDL::Segment& segment : segments) chain.addSegment(segment);
  return chain;
}

class MujocoArm {
 public:
  explicit MujocoArm(const std::string& file) {
    char error[300] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    if (!model_) throw std::runtime_error(error);
    data_.reset(mj_makeData(model_.get()));
    tip_ = mj_name2id(model_.get(), mjOBJ_BODY, "tip");
  }
  [[nodiscard]] bool is_like_ours() const { return tip_ > 0 && model_->nq == kMaxJoints; }
  Pose forward(const JointVector& q) {
    std::copy(q.begin(), q.end(), data_->qpos);
    mj_kinematics(model_.get(), data_.get());
    const mjtNum *p = data_->xpos + 3 * tip_, *r = data_->xquat + 4 * tip_;
    return {{p[0], p[1], p[2]}, {r[0], r[1], r[2], r[3]}};
  }

 private:
  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
  int tip_ = -1;
};

double apart(const Pose& a, const Pose& b) {
  return std::max((a.p - b.p).norm(), (a.q.toRotationMatrix() - b.q.toRotationMatrix()).norm());
}

TEST(Urdf, ForwardKinematicsEqualThoseOfKdlAndMujoco) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::string text = test::RandomUrdf(seed).text(seed > 6);
    const RobotConfig robot = robot_of(text);
    const Kinematics ours(robot);
    const KDL::Chain chain = chain_of(text, "tip");
    KDL::ChainFkSolverPos_recursive theirs(chain);
    ASSERT_EQ(chain.getNrOfJoints(), 6u);
    const TemporaryFolder folder;
    MujocoArm mujoco(folder.write("drawn.urdf", text).string());
    ASSERT_TRUE(mujoco.is_like_ours()) << seed;
    Random random(seed);
    double worst_kdl = 0.0, worst_mujoco = 0.0;
    for (int n = 0; n < kPoses; ++n) {
      JointVector q;
      KDL::JntArray joints(6);
      for (int i = 0; i < 6; ++i) joints(static_cast<unsigned>(i)) = q[i] = 4.0 * random.uniform() - 2.0;
      KDL::Frame frame;
      ASSERT_GE(theirs.JntToCart(joints, frame), 0);
      Pose X{{frame.p.x(), frame.p.y(), frame.p.z()}, {}};
      frame.M.GetQuaternion(X.q.x(), X.q.y(), X.q.z(), X.q.w());
      const Pose mine = ours.forward(q);
      worst_kdl = std::max(worst_kdl, apart(mine, X));
      worst_mujoco = std::max(worst_mujoco, apart(mine, mujoco.forward(q)));
    }
    EXPECT_LT(worst_kdl, kOfReach * std::max(ours.reach_m(), 1.0)) << seed;
    EXPECT_LT(worst_mujoco, kOfReach * std::max(ours.reach_m(), 1.0)) << seed;
  }
}

}  // namespace
}  // namespace longreach::urdf_test
