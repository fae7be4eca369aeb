#pragma once
// Random paths of a goal along straight lines from a start pose through a middle pose to an end pose. The
// joint positions at the start and at the end have equal and opposite offsets from those of the middle pose.
// The middle pose is singular, close to a singular pose, out of reach or random; for the tests of joint
// limits the offsets are large.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slave/config/command_config.hpp"
#include "tests/property/limited_arm.hpp"

namespace longreach::test {

inline JointVector inside(const RobotConfig& robot, const JointVector& q, double margin_rad) {
  JointVector result;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    result[i] = std::clamp(q[i], j.min_rad + margin_rad, j.max_rad - margin_rad);
  }
  return result;
}

inline JointVector anywhere(const RobotConfig& robot, Random& random) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    q[i] = random.uniform(j.min_rad + 0.1, j.max_rad - 0.1);
  }
  return q;
}

inline JointVector spread(Random& random, double size) {
  JointVector q;
  for (double& x : q) x = size * random.uniform(-1.0, 1.0);
  return q;
}

// Motion from one pose to another along a straight line and about a fixed axis, at a constant speed.
struct Leg {
  Pose from, to;
  double seconds;

  [[nodiscard]] Pose at(double share) const {
    const Vector3 turn = log_rotation(to.q * from.q.conjugate());
    return {from.p + share * (to.p - from.p), exp_rotation(share * turn) * from.q};
  }
};

inline double seconds_for(const Pose& a, const Pose& b, const CommandConfig& command, double pace) {
  return std::max((b.p - a.p).norm() / command.speed_max_m_per_s,
                  a.q.angularDistance(b.q) / command.speed_max_rad_per_s) /
             pace +
         0.1;
}

enum Kind : std::size_t { kSingular, kBeside, kOutOfReach, kJumps, kLimits };
constexpr std::array<const char*, 5> kNames{"through singular", "beside singular", "out of reach", "jumps",
                                            "joint limits"};

struct Tour {
  JointVector start;
  std::vector<Leg> legs;
  bool jumps = false;
};

// Moves joint `i` in `q` to a zero of the determinant of J. Returns false if there is none within the joint
// limits.
inline bool make_singular(const Kinematics& kinematics, const RobotConfig& robot, int i, JointVector& q) {
  const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
  const auto determinant = [&](double x) {
    JointVector at = q;
    at[i] = x;
    return kinematics.rigid_with_jacobian(at).J.determinant();
  };
  for (double low = j.min_rad + 0.15; low + 0.05 < j.max_rad - 0.15; low += 0.05) {
    double a = low, b = low + 0.05;
    const bool sign = determinant(a) < 0.0;
    if ((determinant(b) < 0.0) == sign) continue;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (a + b);
      ((determinant(middle) < 0.0) == sign ? a : b) = middle;
    }
    q[i] = a;
    return true;
  }
  return false;
}

inline Tour make_tour(Kind kind, const RobotConfig& robot, const Kinematics& kinematics,
                      const CommandConfig& command, Random& random) {
  Tour tour;
  JointVector middle = anywhere(robot, random);
  if (kind == kSingular || kind == kBeside) {
    for (int n = 0; n < 30; ++n) {
      middle = anywhere(robot, random);
      if (make_singular(kinematics, robot, 1 + static_cast<int>(random.next() % 4), middle)) break;
    }
  }
  const double far = kinematics.reach_m() > 5.0 ? 0.05 : 0.2;
  const JointVector way = spread(random, kind == kLimits ? 10.0 * far : far);
  tour.start = inside(robot, middle - way, 0.02);
  const JointVector end = inside(robot, middle + way, kind == kLimits ? 0.0 : 0.02);
  Pose via = kinematics.forward(middle);
  if (kind == kBeside) via.p += std::pow(10.0, random.uniform(-12.0, -2.0)) * Vector3(0.6, -0.64, 0.48);
  if (kind == kOutOfReach) via.p = via.p.normalized() * kinematics.reach_m() * random.uniform(1.05, 1.5);
  const Pose first = kinematics.forward(tour.start);
  const Pose last = kind == kOutOfReach ? first : kinematics.forward(end);
  const double pace = random.uniform(0.3, 1.2);
  const auto add = [&](const Pose& a, const Pose& b) {
    tour.legs.push_back({a, b, std::min(seconds_for(a, b, command, pace), 30.0)});
  };
  add(first, via);
  add(via, last);
  tour.jumps = kind == kJumps;
  return tour;
}

}  // namespace longreach::test
