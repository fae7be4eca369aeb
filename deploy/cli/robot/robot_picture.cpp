#include "deploy/cli/robot/robot_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/text/number_text.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {
namespace {

constexpr double kSide = 360.0, kMargin = 46.0;  // size and margin of a view, px

struct Drawn {
  std::vector<Vector3> joint_m{}, axis{};  // position and axis of each joint
  std::vector<bool> slides{};
  std::vector<Vector3> corner_m{};  // polyline through the base, the links and the tool
  Pose tool{};
};

Drawn drawn(const RobotConfig& robot) {
  const Kinematics kinematics(robot);
  const JointVector q = start_joints(robot);
  Drawn d;
  Rigid X = kinematics.base();
  d.corner_m = {Vector3::Zero(), X.p};
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointKind kind = robot.joint[i].kind;
    const JointRow& row = kinematics.links()[i];
    const double value = q[static_cast<int>(i)], turn = kind == JointKind::kRevolute ? value : 0.0;
    d.joint_m.push_back(X.p);
    d.axis.emplace_back(X.R.col(2));
    d.slides.push_back(kind != JointKind::kRevolute);
    X = X * Rigid{exp_rotation({0.0, 0.0, turn + row.theta_rad}).toRotationMatrix(), Vector3::Zero()};
    const double along_m = row.d_m + (kind == JointKind::kPrismatic ? value : 0.0);
    d.corner_m.emplace_back(X.p + along_m * X.R.col(2));
    X = X * Rigid{rotation_behind(row), Vector3(row.a_m, 0.0, along_m)};
    d.corner_m.push_back(X.p);
  }
  const Rigid tool = X * kinematics.tool();
  d.corner_m.push_back(tool.p);
  d.tool = to_pose(tool);
  return d;
}

/// The axes of W that point right and up.
struct View {
  const char* title;
  int right, up;
};

std::string number(double x) { return format_number(0.1 * std::round(10.0 * x)); }

class Sheet {
 public:
  Sheet(const Drawn& d, const View& view, double left) : view_(view), left_(left) {
    Vector3 low = d.corner_m.front(), high = low;
    for (const Vector3& p : d.corner_m) low = low.cwiseMin(p), high = high.cwiseMax(p);
    middle_m_ = 0.5 * (low + high);
    size_m_ = std::max((high - low).maxCoeff(), 1e-3);
  }

  [[nodiscard]] double x(const Vector3& p) const {
    return left_ + 0.5 * kSide + (p[view_.right] - middle_m_[view_.right]) * scale();
  }
  [[nodiscard]] double y(const Vector3& p) const {
    return 0.5 * kSide + kMargin - (p[view_.up] - middle_m_[view_.up]) * scale();
  }
  [[nodiscard]] std::string at(const Vector3& p) const { return number(x(p)) + "," + number(y(p)); }
  [[nodiscard]] double scale() const { return (kSide - 2.0 * kMargin) / size_m_; }
  [[nodiscard]] double size_m() const { return size_m_; }

  [[nodiscard]] std::string line(const Vector3& a, const Vector3& b, const std::string& style) const {
    return "<polyline points=\"" + at(a) + " " + at(b) + "\" fill=\"none\" " + style + "/>\n";
  }

 private:
  View view_;
  double left_;
  Vector3 middle_m_;
  double size_m_;
};

/// Draws the numbers of the joints. Joints at the same place share one label.
std::string labels(const Drawn& d, const Sheet& sheet) {
  constexpr double kOnePlace = 12.0;  // px
  std::string text;
  std::vector<bool> done(d.joint_m.size(), false);
  for (std::size_t i = 0; i < d.joint_m.size(); ++i) {
    if (done[i]) continue;
    const double x = sheet.x(d.joint_m[i]), y = sheet.y(d.joint_m[i]);
    std::string numbers;
    for (std::size_t k = i; k < d.joint_m.size(); ++k) {
      if (std::hypot(sheet.x(d.joint_m[k]) - x, sheet.y(d.joint_m[k]) - y) > kOnePlace) continue;
      numbers += (numbers.empty() ? "" : " ") + std::to_string(k + 1);
      done[k] = true;
    }
    text += "<text x=\"" + number(x + 11.0) + "\" y=\"" + number(y - 9.0) + "\" font-size=\"12\">" + numbers +
            "</text>\n";
  }
  return text;
}

std::string view_of(const Drawn& d, const View& view, double left) {
  const Sheet sheet(d, view, left);
  std::string text = "<text x=\"" + number(left + 0.5 * kSide) + "\" y=\"24\" text-anchor=\"middle\">" +
                     view.title + "</text>\n<polyline points=\"";
  for (const Vector3& p : d.corner_m) text += sheet.at(p) + " ";
  text +=
      "\" fill=\"none\" stroke=\"#5b7083\" stroke-width=\"7\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"/>\n";
  for (std::size_t i = 0; i < d.joint_m.size(); ++i) {
    const Vector3& p = d.joint_m[i];
    const Vector3 reach = 0.06 * sheet.size_m() * d.axis[i];
    text += sheet.line(p - reach, p + reach, "stroke=\"#c2571a\" stroke-width=\"2\"");
    text += d.slides[i] ? "<rect x=\"" + number(sheet.x(p) - 6.0) + "\" y=\"" + number(sheet.y(p) - 6.0) +
                              "\" width=\"12\" height=\"12\" fill=\"#f4a259\" stroke=\"#7a3b10\"/>\n"
                        : "<circle cx=\"" + number(sheet.x(p)) + "\" cy=\"" + number(sheet.y(p)) +
                              "\" r=\"7\" fill=\"#f4a259\" stroke=\"#7a3b10\"/>\n";
  }
  text += labels(d, sheet);
  constexpr std::array<const char*, 3> kColours{"#c62828", "#2e7d32", "#1565c0"};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 tip = d.tool.p + 0.1 * sheet.size_m() * (d.tool.q * Vector3(Vector3::Unit(axis)));
    text += sheet.line(
        d.tool.p, tip,
        std::string("stroke=\"") + kColours[static_cast<std::size_t>(axis)] + "\" stroke-width=\"3\"");
  }
  const Vector3& base = d.corner_m.front();
  if (view.up != 2) return text;  // the base plate is drawn in side views only
  return text + "<rect x=\"" + number(sheet.x(base) - 14.0) + "\" y=\"" + number(sheet.y(base)) +
         "\" width=\"28\" height=\"6\" fill=\"#37474f\"/>\n";
}

}  // namespace

std::string robot_picture(const RobotConfig& robot) {
  const Drawn d = drawn(robot);
  const double width = 2.0 * kSide, height = kSide + 2.0 * kMargin;
  std::string title;
  for (const char c : robot.name) title += c == '<' || c == '&' || c == '>' ? '_' : c;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
         "\" width=\"" + number(width) + "\" height=\"" + number(height) +
         "\" font-family=\"sans-serif\" font-size=\"15\" fill=\"#263238\">\n<title>" + title +
         "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         view_of(d, {"from the side: x to the right, z up", 0, 2}, 0.0) +
         view_of(d, {"from above: x to the right, y up", 0, 1}, kSide) + "<text x=\"12\" y=\"" +
         number(height - 14.0) + "\" font-size=\"13\">" + title +
         " in its start pose; joints 1 to 6 with their axes (squares: prismatic); tool frame: x red, y green, "
         "z blue</text>\n"
         "</svg>\n";
}

}  // namespace longreach
