#include "deploy/cli/robot/robot_report.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/text/number_text.hpp"
#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kLost = 1e-3;  // conditioning below which a pose counts as singular

double conditioning_at(const Kinematics& kinematics, const JointVector& q) {
  return conditioning(kinematics.rigid_with_jacobian(q).J, kinematics.motion_length_m());
}

/// Returns whether the pose was already found. Half a turn to either side is the same pose.
bool known(const std::vector<SingularPose>& found, int joint, double value) {
  constexpr double kSame = 1e-3, kTurn = 6.283185307179586;
  return std::ranges::any_of(found, [&](const SingularPose& s) {
    return s.joint == joint && std::abs(std::remainder(s.value - value, kTurn)) < kSame;
  });
}

/// Searches for singular minima of the conditioning along one joint, with the other joints at their start.
void look_along(const Kinematics& kinematics, const RobotReport& report, int joint,
                std::vector<SingularPose>& found) {
  constexpr int kSteps = 720;
  const JointConfig& limits = report.robot.joint[static_cast<std::size_t>(joint)];
  const double low = std::max(limits.min_rad, -3.1416), high = std::min(limits.max_rad, 3.1416);
  const double step = (high - low) / kSteps;
  if (!(step > 0.0)) return;
  JointVector q = report.start;
  const auto at = [&](double value) {
    q[joint] = value;
    return conditioning_at(kinematics, q);
  };
  double before = std::numeric_limits<double>::infinity(), now = at(low);
  for (int i = 1; i <= kSteps + 1; ++i) {
    const double middle = low + step * (i - 1);
    const double next = i <= kSteps ? at(low + step * i) : std::numeric_limits<double>::infinity();
    if (now <= before && now < next) {
      double a = std::max(middle - step, low), b = std::min(middle + step, high);
      for (int n = 0; n < 60; ++n) {
        const double one = a + 0.382 * (b - a), two = b - 0.382 * (b - a);
        (at(one) < at(two) ? b : a) = at(one) < at(two) ? two : one;
      }
      const double value = 0.5 * (a + b);
      if (at(value) < kLost && !known(found, joint, value))
        found.push_back({joint, value,
                         lost_direction(kinematics.rigid_with_jacobian(q).J, kinematics.motion_length_m())});
    }
    before = now;
    now = next;
  }
}

void measure_reach(const NumericInverse& arm, RobotReport& report) {
  constexpr std::uint32_t kPlaces = 20000;
  const Vector3 foot = arm.kinematics().base().p;
  report.near_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t n = 1; n <= kPlaces; ++n) {
    const double distance_m = (arm.kinematics().rigid_forward(arm.start(n)).p - foot).stableNorm();
    report.near_m = std::min(report.near_m, distance_m);
    report.far_m = std::max(report.far_m, distance_m);
  }
}

std::string kind_text(JointKind kind) {
  return kind == JointKind::kFixed ? "fixed" : kind == JointKind::kPrismatic ? "prismatic" : "revolute";
}

// Formats a number with up to four decimals, without trailing zeros.
std::string short_number(double x) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::fixed, 4).ptr;
  std::string number(text.data(), end);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.pop_back();
  return number == "-0" ? "0" : number;
}

std::string in_column(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string joint_name(const RobotConfig& robot, std::size_t i) {
  return robot.joint[i].name.empty() ? "joint " + std::to_string(i + 1) : robot.joint[i].name;
}

}  // namespace

RobotReport report_of(const RobotConfig& robot) {
  RobotReport report;
  report.robot = robot;
  const NumericInverse numeric(robot);
  const Inverse inverse(robot);
  const Kinematics& kinematics = inverse.kinematics();
  report.inverse = inverse.words();
  report.start = start_joints(robot);
  report.X_WE = kinematics.forward(report.start);
  report.conditioning = conditioning_at(kinematics, report.start);
  measure_reach(numeric, report);
  const bool fixed =
      std::ranges::any_of(robot.joint, [](const JointConfig& j) { return j.kind == JointKind::kFixed; });
  if (fixed) {
    report.cannot.emplace_back("turn its tool: the arm has no wrist, so the rotation of a goal is ignored");
    return report;
  }
  for (int joint = 0; joint < kMaxJoints; ++joint) look_along(kinematics, report, joint, report.singular);
  if (report.conditioning < kLost)
    report.cannot.emplace_back(direction_text(lost_direction(kinematics.rigid_with_jacobian(report.start).J,
                                                             kinematics.motion_length_m())) +
                               " in its start pose, which is singular; set robot.start_rad");
  return report;
}

std::string direction_text(const Vector6& lost) {
  const Vector3 angular = lost.head<3>(), linear = lost.tail<3>();
  const bool turns = angular.norm() > linear.norm();
  const Vector3 direction = (turns ? angular : linear).normalized();
  Eigen::Index axis;
  constexpr double kClear = 0.999;
  const std::string verb = turns ? "turn about " : "move along ";
  if (direction.cwiseAbs().maxCoeff(&axis) > kClear) return verb + std::string(1, "xyz"[axis]);
  return verb + "(" + short_number(direction.x()) + ", " + short_number(direction.y()) + ", " +
         short_number(direction.z()) + ")";
}

std::string report_text(const RobotReport& report) {
  const RobotConfig& robot = report.robot;
  std::string text = robot.name + (robot.basis.empty() ? "" : ": " + robot.basis) + "\n\n";
  std::size_t width = 7;
  for (std::size_t i = 0; i < kMaxJoints; ++i) width = std::max(width, joint_name(robot, i).size() + 2);
  text +=
      in_column("joint", width) + "kind       from      to        start     speed     acceleration  jerk\n";
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    text += in_column(joint_name(robot, i), width) + in_column(kind_text(j.kind), 11);
    if (j.kind != JointKind::kFixed)
      text += in_column(short_number(j.min_rad), 10) + in_column(short_number(j.max_rad), 10) +
              in_column(short_number(j.start_rad), 10) + in_column(short_number(j.speed_max_rad_per_s), 10) +
              in_column(short_number(j.acceleration_max_rad_per_s2), 14) +
              short_number(j.jerk_max_rad_per_s3);
    text += "\n";
  }
  const Vector3& p = report.X_WE.p;
  text += "units: rad or m, per s, s^2 and s^3; servo bandwidth " + format_number(robot.servo_hz) + " Hz\n";
  for (const std::string& limit : report.limits) text += "limits    " + limit + "\n";
  for (const std::string& what : report.ignored) text += what + "\n";
  text += "\n";
  text += "inverse   " + report.inverse + "\n";
  text += "reach     the tool can be " + short_number(report.near_m) + " to " + short_number(report.far_m) +
          " m from the base\n";
  text += "start     the tool is at (" + short_number(p.x()) + ", " + short_number(p.y()) + ", " +
          short_number(p.z()) + ") m, conditioning " + short_number(report.conditioning) +
          " (0 is singular, 0.3 is good)\n";
  for (const SingularPose& s : report.singular)
    text += "singular  with " + joint_name(robot, static_cast<std::size_t>(s.joint)) + " at " +
            short_number(s.value) + " and the other joints in the start pose, the tool cannot " +
            direction_text(s.lost) + "\n";
  for (const std::string& what : report.cannot) text += "cannot    " + what + "\n";
  return text;
}

std::string report_json(const RobotReport& report) {
  using Json = nlohmann::json;
  const RobotConfig& robot = report.robot;
  Json joints = Json::array(), singular = Json::array();
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[i];
    joints.push_back({{"name", joint_name(robot, i)},
                      {"kind", kind_text(j.kind)},
                      {"min", j.min_rad},
                      {"max", j.max_rad},
                      {"start", j.start_rad},
                      {"speed_max", j.speed_max_rad_per_s},
                      {"acceleration_max", j.acceleration_max_rad_per_s2},
                      {"jerk_max", j.jerk_max_rad_per_s3}});
  }
  for (const SingularPose& s : report.singular)
    singular.push_back({{"joint", joint_name(robot, static_cast<std::size_t>(s.joint))},
                        {"at", s.value},
                        {"lost", std::vector<double>(s.lost.begin(), s.lost.end())}});
  const Vector3& p = report.X_WE.p;
  return Json{{"name", robot.name},
              {"basis", robot.basis},
              {"joint", joints},
              {"servo_hz", robot.servo_hz},
              {"inverse", report.inverse},
              {"reach_m", {report.near_m, report.far_m}},
              {"start_m", {p.x(), p.y(), p.z()}},
              {"conditioning", report.conditioning},
              {"singular", singular},
              {"cannot", report.cannot},
              {"limits", report.limits},
              {"ignored", report.ignored}}
      .dump();
}

}  // namespace longreach
