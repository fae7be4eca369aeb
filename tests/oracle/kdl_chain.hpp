#pragma once
// Converts a robot to a chain of KDL (Orocos), which supports both Denavit-Hartenberg conventions.

#include <kdl/chain.hpp>
#include <kdl/frames.hpp>

#include "schema/config_slave.hpp"
#include "slave/robot/robot.hpp"

namespace longreach::oracle {

inline KDL::Chain kdl_chain(const RobotConfig& robot) {
  KDL::Chain chain;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    if (robot.convention == DhConvention::kModified) {
      // In the modified convention the fixed part of a row comes before the rotation of the joint.
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None),
                                    KDL::Frame::DH_Craig1989(j.a_m, j.alpha_rad, j.d_m, j.theta_rad)));
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ)));
    } else {
      chain.addSegment(
          KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(j.a_m, j.alpha_rad, j.d_m, j.theta_rad)));
    }
  }
  const Vector3 &p = robot.tool.position_m, &r = robot.tool.rotation_rad;
  const double angle = r.norm();
  const KDL::Rotation turn = angle > 0.0
                                 ? KDL::Rotation::Rot2(KDL::Vector(r.x(), r.y(), r.z()) / angle, angle)
                                 : KDL::Rotation::Identity();
  chain.addSegment(
      KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(turn, KDL::Vector(p.x(), p.y(), p.z()))));
  return chain;
}

inline KDL::JntArray kdl_joints(const JointVector& q) {
  KDL::JntArray joints(kMaxJoints);
  for (unsigned i = 0; i < kMaxJoints; ++i) joints(i) = q[static_cast<int>(i)];
  return joints;
}

}  // namespace longreach::oracle
