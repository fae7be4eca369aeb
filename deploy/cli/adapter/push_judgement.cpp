#include "deploy/cli/adapter/push_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace longreach {
namespace {

constexpr double kAlike = 0.8;  // cosine: a person pushes within 37 degrees of an axis
constexpr std::array kAxis{"x", "y", "z"};

std::string in_text(const Vector3& v) {
  char text[80];
  std::snprintf(text, sizeof text, "%.1f %.1f %.1f", v.x(), v.y(), v.z());
  return text;
}

/// Returns whether each push was reported in the direction that `expected` returns for it.
template <class Expected>
bool fits(const PushedSensor& sensor, const Expected& expected) {
  for (int i = 0; i < 3; ++i) {
    const Push& push = sensor.push[static_cast<std::size_t>(i)];
    if (push.reported.normalized().dot(expected(push, Vector3::Unit(i))) < kAlike) return false;
  }
  return true;
}

Vector3 in_tool(const Push& push, const Vector3& axis) { return push.R_WE.transpose() * axis; }

/// Describes interchanged axes: reported = P f_E with a signed permutation P. Returns an empty string if
/// there is no such P.
std::string exchanged(const PushedSensor& sensor) {
  std::array<int, 3> order{0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      Matrix3 P = Matrix3::Zero();
      for (int i = 0; i < 3; ++i)
        P(i, order[static_cast<std::size_t>(i)]) = (signs >> static_cast<unsigned>(i) & 1U) != 0 ? -1.0 : 1.0;
      if (!fits(sensor,
                [&P](const Push& push, const Vector3& axis) { return Vector3(P * in_tool(push, axis)); }))
        continue;
      std::string text;
      for (int i = 0; i < 3; ++i) {
        const int from = order[static_cast<std::size_t>(i)];
        text += (i == 0 ? "" : ", ") + std::string(P(i, from) < 0.0 ? "-" : "") +
                kAxis[static_cast<std::size_t>(from)];
      }
      return text;
    }
  } while (std::ranges::next_permutation(order).found);
  return "";
}

Finding wrong(const PushedSensor& sensor, std::string text, std::string advice) {
  return {FindingVerdict::kFailure, sensor.what, std::move(text), std::move(advice), {}};
}

Finding judge_direction(const PushedSensor& sensor) {
  const auto in_base = [](const Push&, const Vector3& axis) { return axis; };
  const auto against_base = [](const Push&, const Vector3& axis) { return Vector3(-axis); };
  const auto against = [](const Push& push, const Vector3& axis) { return Vector3(-in_tool(push, axis)); };
  const std::string name = sensor.what;
  if (fits(sensor, in_tool)) {
    if (!fits(sensor, in_base))
      return {FindingVerdict::kOk, sensor.what, "has the correct sign and is reported in the tool frame"};
    return {FindingVerdict::kWarning, sensor.what,
            "has the correct sign, but the axes of tool frame and base frame coincide in this pose",
            "turn the tool by 90 degrees and repeat the check: this pose does not show whether the " + name +
                " is reported in the tool frame"};
  }
  if (fits(sensor, against))
    return wrong(sensor, "has the wrong sign",
                 "report the " + name + " that the environment exerts on the tool, not its opposite");
  if (fits(sensor, in_base))
    return wrong(sensor, "is reported in the base frame",
                 "rotate it into the tool frame: f_E = R^T f_W, where R is the present orientation of "
                 "the tool");
  if (fits(sensor, against_base))
    return wrong(sensor, "is reported in the base frame, and has the wrong sign",
                 "rotate it into the tool frame and change its sign");
  if (const std::string axes = exchanged(sensor); !axes.empty())
    return wrong(sensor, "has swapped axes: the reported x, y, z are " + axes + " of the tool",
                 "report them in the order x, y, z of the right-handed tool frame");
  std::string reported;
  for (std::size_t i = 0; i < 3; ++i)
    reported += (i == 0 ? "" : "; ") + std::string(kAxis[i]) + ": " + in_text(sensor.push[i].reported);
  return wrong(
      sensor,
      "matches neither frame: pushes along the base axes were reported as " + reported + " " + sensor.unit,
      "check how the sensor is mounted, and that the robot file describes this robot and this tool");
}

Finding judge_rest(const PushedSensor& sensor) {
  const std::string text = "is " + in_text(sensor.rest) + " " + sensor.unit + " without contact";
  if (sensor.rest.norm() <= sensor.rest_max) return {FindingVerdict::kOk, "rest", text};
  return {FindingVerdict::kFailure, "rest", text,
          "subtract the weight of the tool in the adapter, or describe the tool in sensing.tool and set "
          "its gravity; turn the tool over to distinguish its weight from a zero offset"};
}

}  // namespace

std::vector<Finding> judge_pushes(const PushedSensor& sensor) {
  std::vector<Finding> found{judge_rest(sensor)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!sensor.push[i].reported.isZero(0.0)) continue;
    found.push_back(wrong(sensor,
                          std::string("does not respond to a push along ") + kAxis[i] + " of the base",
                          "push harder; if this does not help, a channel is dead or its unit is not " +
                              std::string(sensor.unit)));
  }
  if (found.size() == 1) found.push_back(judge_direction(sensor));
  return found;
}

}  // namespace longreach
