#include "deploy/lab/solve/solve_robot.hpp"

#include <cmath>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "common/text/number_text.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;
using solve_json::Json;
using solve_json::number;

constexpr double kUnlimited = 4.0 * 3.14159265358979323846;

double element(const Json& list, std::size_t i, const std::string& name) {
  return solve_json::number(Json{{name, list[i]}}, name);
}

JointVector joints(const Json& request, const std::string& key, const RobotConfig& robot) {
  const Json& list = solve_json::member(request, key);
  if (!list.is_array() || list.size() != kMaxJoints)
    throw BadRequest("\"" + key + "\" must be a list of six numbers");
  JointVector q;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const double value = element(list, i, key);
    if (robot.joint[i].kind == JointKind::kRevolute && std::abs(value) > kUnlimited)
      throw BadRequest("\"" + key + "\" = " + format_number(value) +
                       " is more than two turns of a joint; the unit is rad, but this value seems to be in "
                       "degrees");
    q[static_cast<int>(i)] = value;
  }
  return q;
}

Json to_json(const JointVector& q) { return Json(std::vector<double>(q.begin(), q.end())); }

/// An angle of a row, with the limits that apply in robot files.
double angle(const Json& row, const std::string& key, double most) {
  const double value = number(row, key);
  if (std::abs(value) <= most) return value;
  throw BadRequest("\"" + key + "\" = " + format_number(value) + " in a row of \"dh\" is outside " +
                   format_number(-most) + " to " + format_number(most) +
                   "; the unit is rad, but this value seems to be in degrees");
}

RobotConfig rows(const Json& request) {
  const Json& dh = solve_json::member(request, "dh");
  if (!dh.is_array() || dh.size() != kMaxJoints)
    throw BadRequest("\"dh\" must be a list of six rows, not " +
                     std::to_string(dh.is_array() ? dh.size() : 0));
  RobotConfig robot;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    if (!dh[i].is_object()) throw BadRequest("a row of \"dh\" must be an object");
    solve_json::require_known(dh[i], "dh", {"a", "alpha", "d", "theta"});
    robot.joint[i].a_m = number(dh[i], "a");
    robot.joint[i].alpha_rad = angle(dh[i], "alpha", 3.2);
    robot.joint[i].d_m = number(dh[i], "d");
    robot.joint[i].theta_rad = dh[i].contains("theta") ? angle(dh[i], "theta", 6.3) : 0.0;
  }
  return robot;
}

RobotConfig named(const std::string& name) {
  const FileSearch search = installed_files();
  proto::SlaveConfig config;
  config.set_robot_file(search.first_in(working_folder()).find_named("robot", "robots", name).string());
  config.mutable_scene();
  resolve_files(config, search, nullptr);
  return to_struct(config).robot;
}

RobotConfig robot(const Json& request) {
  const bool by_name = request.contains("robot");
  if (by_name && request.contains("dh")) throw BadRequest("give either \"robot\" or \"dh\", not both");
  if (by_name && request.contains("convention"))
    throw BadRequest("\"convention\" requires \"dh\"; a robot file states its own convention");
  RobotConfig robot = by_name ? named(solve_json::text(request, "robot")) : rows(request);
  if (request.contains("convention")) {
    const std::string word = solve_json::text(request, "convention");
    if (word != "standard" && word != "modified")
      throw BadRequest("\"convention\" must be \"standard\" or \"modified\"");
    robot.convention = word == "modified" ? DhConvention::kModified : DhConvention::kStandard;
  }
  for (JointConfig& joint : robot.joint) {
    if (joint.kind == JointKind::kRevolute) joint.min_rad = -kUnlimited, joint.max_rad = kUnlimited;
  }
  return robot;
}

Pose pose(const Json& request) {
  const Json& rows = solve_json::member(request, "X");
  if (!rows.is_array() || rows.size() != 4) throw BadRequest("\"X\" must be a list of four rows");
  Eigen::Matrix4d X;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!rows[i].is_array() || rows[i].size() != 4)
      throw BadRequest("a row of \"X\" must be a list of four numbers");
    for (std::size_t k = 0; k < 4; ++k)
      X(static_cast<int>(i), static_cast<int>(k)) = element(rows[i], k, "X");
  }
  if (!(X.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-9))
    throw BadRequest("the last row of \"X\" must be 0 0 0 1");
  Json rotation = Json::array();
  for (std::size_t i = 0; i < 3; ++i)
    rotation.push_back(solve_json::to_json(Vector3(X.block<1, 3>(static_cast<int>(i), 0))));
  return {X.block<3, 1>(0, 3), solve_json::rotation(Json{{"X", rotation}}, "X")};
}

template <class Matrix>
Json matrix_to_json(const Matrix& m) {
  Json all = Json::array();
  for (int i = 0; i < m.rows(); ++i) {
    Json row = Json::array();
    for (int k = 0; k < m.cols(); ++k) row.push_back(m(i, k));
    all.push_back(row);
  }
  return all;
}

}  // namespace

Json solve_robot_fk(const Json& request) {
  solve_json::require_known(request, "", {"robot", "dh", "convention", "q"});
  const RobotConfig arm = robot(request);
  const RigidKinematics at = Kinematics(arm).rigid_with_jacobian(joints(request, "q", arm));
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = at.X_WE.R;
  X.topRightCorner<3, 1>() = at.X_WE.p;
  return {{"X", matrix_to_json(X)}, {"J", matrix_to_json(at.J)}};
}

Json solve_robot_ik(const Json& request) {
  solve_json::require_known(request, "", {"robot", "dh", "convention", "X", "near"});
  constexpr InverseTolerance kThorough{1e-12, 100, 200};
  const RobotConfig arm = robot(request);
  const Inverse inverse(arm);
  const Pose goal = pose(request);
  const JointVector near = request.contains("near") ? joints(request, "near", arm) : JointVector::Zero();
  const InverseSolutions all = inverse.all(goal, near, kThorough);
  const InverseResult best = inverse.solve(goal, near, kThorough);
  Json solutions = Json::array();
  for (int i = 0; i < all.count; ++i)
    solutions.push_back(to_json(all.joint_rad[static_cast<std::size_t>(i)]));
  Json answer = {{"status", to_string(best.status)},          {"solutions", solutions},
                 {"nearest", to_json(best.joint_rad)},        {"position_error", best.position_error_m},
                 {"rotation_error", best.rotation_error_rad}, {"kind", inverse.words()}};
  if (best.status == InverseStatus::kSingular)
    answer["lost"] = std::vector<double>(best.lost.begin(), best.lost.end());
  if (best.rotation_ignored) answer["rotation_ignored"] = true;
  return answer;
}

}  // namespace longreach
