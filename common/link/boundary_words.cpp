#include "common/link/boundary_words.hpp"

#include <cmath>

#include "common/text/number_text.hpp"

namespace longreach {
namespace {

std::string axis_in_words(const Vector3& d) {
  int axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  return std::string(d[axis] < 0.0 ? "-" : "+") + "xyz"[axis];
}

std::string direction_in_words(const Pose& X_WE, const Pose& X_WE_goal) {
  constexpr double kFar_m = 1e-3, kFar_rad = 5e-3;
  const Vector3 missing_m = X_WE_goal.p - X_WE.p;
  const Vector3 missing_rad = log_rotation(X_WE_goal.q * X_WE.q.conjugate());
  if (norm(missing_m) > kFar_m) return ", towards " + axis_in_words(missing_m);
  return norm(missing_rad) > kFar_rad ? ", about " + axis_in_words(missing_rad) : "";
}

}  // namespace

std::string boundary_in_words(const Clamps& clamps, const Pose& X_WE, const Pose& X_WE_goal) {
  if (!clamps.joint_position && !clamps.unreachable) return "";
  std::string words = "end of the reach";
  if (clamps.joint_position)
    words = clamps.joint == 0 ? "a joint is at its limit"
                              : "joint " + std::to_string(std::abs(clamps.joint)) + " is at its " +
                                    (clamps.joint < 0 ? "lower" : "upper") + " limit";
  return words + direction_in_words(X_WE, X_WE_goal);
}

std::string load_limit_in_words(double acceleration_m_per_s2, double acceleration_rad_per_s2) {
  const bool moves = acceleration_m_per_s2 > 0.0, turns = acceleration_rad_per_s2 > 0.0;
  if (!moves && !turns) return "";
  const auto number = [](double limit) { return format_number(1e-3 * std::round(1e3 * limit)); };
  std::string words = "acceleration limited to ";
  if (moves) words += number(acceleration_m_per_s2) + " m/s²";
  if (moves && turns) words += " and ";
  if (turns) words += number(acceleration_rad_per_s2) + " rad/s²";
  return words + ": load in the gripper";
}

}  // namespace longreach
