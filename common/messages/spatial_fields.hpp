#pragma once
// The fields of vectors, poses, wrenches and joint values in proto/types.proto.

#include "common/schema/visit.hpp"
#include "common/spatial/joint_vector.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

template <class Visitor, Is<Vector3> S>
void visit_fields(Visitor& visit, S& v) {
  visit("x", v.x());
  visit("y", v.y());
  visit("z", v.z());
}

template <class Visitor, Is<Quaternion> S>
void visit_fields(Visitor& visit, S& q) {
  visit("x", q.x());
  visit("y", q.y());
  visit("z", q.z());
  visit("w", q.w());
}

template <class Visitor, Is<Pose> S>
void visit_fields(Visitor& visit, S& X) {
  visit("position_m", X.p);
  visit("orientation", X.q);
}

template <class Visitor, Is<Wrench> S>
void visit_fields(Visitor& visit, S& F) {
  visit("force_n", F.force);
  visit("moment_nm", F.moment);
}

template <class Visitor, Is<JointVector> S>
void visit_fields(Visitor& visit, S& q) {
  constexpr const char* kNames[] = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"};
  for (int i = 0; i < kMaxJoints; ++i) visit(kNames[i], q[i]);
}

}  // namespace longreach
