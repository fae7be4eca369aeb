#pragma once
// Vectors and poses in the arrays of MuJoCo.

#include <mujoco/mujoco.h>

#include "common/spatial/spatial.hpp"

namespace longreach {

inline Vector3 vector_at(const mjtNum* v) { return {v[0], v[1], v[2]}; }
inline Quaternion quaternion_at(const mjtNum* q) { return {q[0], q[1], q[2], q[3]}; }
inline Pose pose_at(const mjtNum* p, const mjtNum* q) { return {vector_at(p), quaternion_at(q)}; }
/// With a rotation matrix, 9 numbers.
inline Pose pose_with_matrix(const mjtNum* p, const mjtNum* matrix) {
  mjtNum q[4];
  mju_mat2Quat(q, matrix);
  return pose_at(p, q);
}

inline void put(const Vector3& v, mjtNum* to) { to[0] = v.x(), to[1] = v.y(), to[2] = v.z(); }
inline void put(const Quaternion& q, mjtNum* to) {
  to[0] = q.w(), to[1] = q.x(), to[2] = q.y(), to[3] = q.z();
}

}  // namespace longreach
