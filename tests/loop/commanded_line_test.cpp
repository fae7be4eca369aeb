// A hand holds the robot against the end of its reach or a joint limit, and lets it return, over the whole loop: the tool
// stays on its commanded line, keeps every limit, stands still and returns at once. Judged from the true pose of the arm
// and from the kinematics, for drawn directions. The device exerts nearly no force, so that the hand stays on its line.
// LONGREACH_FULL: 200 directions for each robot and mode; otherwise 20.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "slave/command/motion.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::commanded_line_test {
namespace {

constexpr double kHold_s = 10.0, kSide_m = 2e-3, kSide_rad = 10e-3, kTremble_m = 20e-6, kBack_s = 0.3;

constexpr double kEnd_m = 0.03;  // before its end, a line may be near a singular pose

const InverseTolerance kTolerance{1e-10, 50, 0};

/// A line of the tool: from a pose in a direction (a unit vector or zero) and about an axis (likewise).
struct ToolLine {
  JointVector start_rad = JointVector::Zero();
  Vector3 along = Vector3::Zero(), about = Vector3::Zero();

  [[nodiscard]] Pose at(const Pose& from, double way_m, double way_rad) const {
    return {from.p + way_m * along, exp_rotation(way_rad * about) * from.q};
  }
};

Vector3 drawn_direction(Random& random) {
  return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

double drawn_joint(const JointConfig& j, double middle, double width, Random& random) {
  const double margin = std::min(0.1, 0.1 * (j.max_rad - j.min_rad));
  return std::clamp(middle + width * random.uniform(-1.0, 1.0), j.min_rad + margin, j.max_rad - margin);
}

bool turns(const RobotConfig& robot) {
  return std::none_of(robot.joint.begin(), robot.joint.end(),
                      [](const JointConfig& j) { return j.kind == JointKind::kFixed; });
}

/// Every other line leads a joint towards its limit; the others lead anywhere.
ToolLine drawn_line(const RobotConfig& robot, int number, Random& random) {
  ToolLine line;
  const Inverse inverse(robot);
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    line.start_rad[i] = j.kind == JointKind::kFixed ? j.start_rad : drawn_joint(j, j.start_rad, 0.3, random);
  }
  if (number % 2 == 1) {
    const int limit = number / 2 % (2 * kMaxJoints), joint = limit / 2;
    const JointConfig& j = robot.joint[static_cast<std::size_t>(joint)];
    if (j.kind != JointKind::kFixed) {
      const double side = limit % 2 == 0 ? 1.0 : -1.0;
      line.start_rad[joint] = (side > 0.0 ? j.max_rad : j.min_rad) - side * 0.1;
      const auto column = inverse.kinematics().rigid_with_jacobian(line.start_rad).J.col(joint).eval();
      if (turns(robot)) line.about = (side * column.head<3>()).stableNormalized();
      if (column.tail<3>().norm() > 0.05) line.along = (side * column.tail<3>()).normalized();
      return line;
    }
  }
  const double kind = turns(robot) ? random.uniform() : 0.0;
  if (kind < 0.8) line.along = drawn_direction(random);
  if (kind > 0.6) line.about = drawn_direction(random);
  return line;
}

/// Moves along the line until the joints cannot follow; the joints before that, and how far.
struct LineWalk {
  JointVector joint_rad;
  double way = 0.0;
  bool ends = false;
  bool singular =
      false;  // at its end or before, the arm is near a singular pose beyond which poses can be reached
};

LineWalk walk(const Inverse& inverse, const JointVector& from_rad, const ToolLine& line, double step_m,
              double most_m) {
  constexpr double kRadPerM = 4.0;
  std::vector<double> conditionings;
  LineWalk out{from_rad};
  const Pose from = inverse.kinematics().forward(from_rad);
  for (double way = step_m; way < most_m; way += step_m) {
    const Pose X = line.at(from, way, kRadPerM * way);
    const InverseResult next = inverse.follow(X, out.joint_rad, kTolerance);
    if (next.status == InverseStatus::kNearest || inverse.reach_end(X, out.joint_rad, kTolerance).ends) {
      out.ends = true;
      break;
    }
    conditionings.push_back(next.conditioning);
    out.joint_rad = next.joint_rad;
    out.way = way;
  }
  constexpr double kStep_m = 0.01, kBeyond_m = 0.06;
  bool continues = false;
  for (double beyond = kStep_m; beyond < kBeyond_m && !continues; beyond += kStep_m)
    continues =
        inverse
            .solve(line.at(from, out.way + beyond, kRadPerM * (out.way + beyond)), out.joint_rad, kTolerance)
            .status != InverseStatus::kNearest;
  const auto end =
      conditionings.end() -
      (continues ? 0 : std::min<std::ptrdiff_t>(std::ssize(conditionings), std::lround(kEnd_m / step_m)));
  out.singular = std::any_of(conditionings.begin(), end, [](double c) { return c < kSingularBand; });
  return out;
}

/// The angle to the boundary is less than 5 degrees: beside the line, at that angle, it continues.
bool grazes(const Inverse& inverse, const JointVector& near_rad, const ToolLine& line) {
  constexpr double kAngle_rad = 5.0 * M_PI / 180.0, kStep = 1e-4, kFar = 6e-3;
  constexpr int kSides = 8;
  const auto beside = [&](const Vector3& d, int side) -> Vector3 {
    if (d.isZero(0.0)) return d;
    const Vector3 a = d.unitOrthogonal(), b = d.cross(a);
    const double turn = 2.0 * M_PI * side / kSides;
    return std::cos(kAngle_rad) * d + std::sin(kAngle_rad) * (std::cos(turn) * a + std::sin(turn) * b);
  };
  const double end = walk(inverse, near_rad, line, kStep, kFar).way;
  for (int side = 0; side < kSides; ++side) {
    for (int other = 0; other < (line.about.isZero(0.0) || line.along.isZero(0.0) ? 1 : kSides); ++other) {
      const ToolLine tilted{near_rad, beside(line.along, side), beside(line.about, (side + other) % kSides)};
      if (walk(inverse, near_rad, tilted, kStep, kFar).way > end + 1.5e-3) return true;
    }
  }
  return false;
}

struct LineResult {
  bool ran = false, stood = false, left_out = false;
  bool singular = false;  // the line passes a singular pose before its end
  double side_m = 0.0, side_rad = 0.0, tremble_m = 0.0, short_m = 0.0, back_s = 0.0;
  std::uint64_t violations = 0;
  Limit first = Limit::kCount;
  std::uint64_t clamped_by = 0;
};

class Holding {
 public:
  Holding(const std::string& robot_file, bool rate, int number) : rate_(rate) {
    Random random = Random(static_cast<std::uint64_t>(1000 * number + (rate ? 1 : 0))).child(robot_file);
    const std::vector<std::string> settings{"profile=lab",
                                            "robot_file=robots/" + robot_file,
                                            "scene_file=scenes/free.txtpb",
                                            std::string("mapping.mode=") + (rate ? "RATE" : "POSITION"),
                                            "mapping.scale=1",
                                            "mapping.base_rotation_rad=0,0,0",
                                            "command.workspace_m=20",
                                            "rendering.force_max_n=0.1",
                                            "rendering.moment_max_nm=0.001",
                                            "safety.engage_at_start=false"};
    const proto::LabConfig config = configure(settings, LONGREACH_DEPLOY);
    slave_ = to_struct(config.slave());
    line_ = drawn_line(slave_.robot, number, random);
    inverse_.emplace(slave_.robot);
    const double before_m = rate ? 0.06 : 0.015;
    const LineWalk whole = walk(*inverse_, line_.start_rad, line_, 2e-3, 3.0);
    singular_ = whole.singular;
    if (!whole.ends) return;
    if (whole.way > before_m)
      line_.start_rad = walk(*inverse_, line_.start_rad, line_, 2e-3, whole.way - before_m).joint_rad;
    for (int i = 0; i < kMaxJoints; ++i)
      slave_.robot.joint[static_cast<std::size_t>(i)].start_rad = line_.start_rad[i];
    lab_ = std::make_unique<Laboratory>(to_struct(config.master()), slave_, random.next());
  }

  LineResult run() {
    LineResult out;
    out.singular = singular_;
    if (!lab_) return out;
    Laboratory& lab = *lab_;
    lab.drive(hand(0.0));
    clocks::run(lab, 0.5);
    if (!clocks::engage(lab, 2.0)) return out;
    out.ran = true;
    from_ = lab.arm().true_pose();
    press(out);
    if (out.stood) back(out);
    out.singular = singular_;
    out.violations = lab.slave().limit_violations;
    out.first = lab.slave().violations_by_limit.first;
    return out;
  }

 private:
  [[nodiscard]] HandTarget hand(double share) const {
    constexpr double kMost_m = 0.04, kMost_rad = 0.3;
    HandTarget hand;
    hand.grip = Grip::kFirm;
    hand.position_m = share * kMost_m * line_.along;
    hand.rotation_rad = share * kMost_rad * line_.about;
    return hand;
  }
  [[nodiscard]] double way_m() const { return line_.along.dot(lab_->arm().true_pose().p - from_.p); }
  [[nodiscard]] Vector3 turned() const {
    return log_rotation(lab_->arm().true_pose().q * from_.q.conjugate());
  }
  void step(double share) {
    lab_->drive(hand(share));
    lab_->step();
  }
  // The handle of a device is up to 0.3 % of its way beside the hand's target, so the commanded line is that of the tool
  // before its last 20 mm.
  [[nodiscard]] Vector3 commanded_direction() const {
    constexpr double kLast_m = 0.02, kLong_m = 0.06;
    const Vector3 end = path_m_.back();
    if (!(line_.along.dot(end) > kLong_m)) return line_.along;
    const auto before =
        std::ranges::find_if(path_m_, [&](const Vector3& p) { return line_.along.dot(end - p) < kLast_m; });
    return before->normalized();
  }
  // Whether the tool can go back without the rotation, and turn back without the translation.
  [[nodiscard]] bool free_inward(bool moves, bool turns) const {
    constexpr double kStep_m = 5e-5, kFree_m = 2e-3;
    const ToolLine inward{*lab_->setpoint_rad(), moves ? Vector3(-line_.along) : Vector3::Zero(),
                          turns ? Vector3(-line_.about) : Vector3::Zero()};
    return !walk(*inverse_, inward.start_rad, inward, kStep_m, kFree_m).ends;
  }

  // Outward until the tool has stood for half a second, then for ten seconds.
  void press(LineResult& out) {
    constexpr double kLongest_s = 25.0, kStands_s = 0.5, kStill_m = 1e-4, kStill_rad = 3e-4;
    const double begin_s = lab_->now_s();
    double moved_s = begin_s, at_m = 0.0, at_rad = 0.0;
    while (lab_->now_s() < begin_s + kLongest_s && lab_->now_s() < moved_s + kStands_s) {
      const double t_s = lab_->now_s() - begin_s;
      share_ = rate_ ? std::min(t_s / 0.2, 1.0) : std::min(t_s / 1.0, 1.0);
      step(share_);
      path_m_.emplace_back(lab_->arm().true_pose().p - from_.p);
      if (lab_->slave().clamps.singularity) singular_at_m_.emplace_back(path_m_.back());
      const double rad = line_.about.dot(turned());
      if (share_ < 1.0 || std::abs(way_m() - at_m) > kStill_m || std::abs(rad - at_rad) > kStill_rad) {
        moved_s = lab_->now_s();
        at_m = way_m();
        at_rad = rad;
      }
    }
    out.stood = lab_->now_s() < begin_s + kLongest_s;
    if (!out.stood) return;
    singular_ = singular_ || std::ranges::any_of(singular_at_m_, [&](const Vector3& p) {
                  return line_.along.dot(path_m_.back() - p) > kEnd_m;
                });
    const Vector3 along = commanded_direction();
    double least = INFINITY, most = -INFINITY;
    for (const double end_s = lab_->now_s() + kHold_s; lab_->now_s() < end_s;) {
      step(1.0);
      const Vector3 way = lab_->arm().true_pose().p - from_.p;
      out.side_m = std::max(out.side_m, (way - along.dot(way) * along).norm());
      out.side_rad = std::max(out.side_rad, (turned() - line_.about.dot(turned()) * line_.about).norm());
      if (lab_->now_s() < end_s - 2.0) continue;
      const double x = way.dot(line_.along.isZero(0.0) ? Vector3(Vector3::UnitX()) : line_.along);
      least = std::min(least, x);
      most = std::max(most, x);
    }
    out.tremble_m = most - least;
    judge_place(out);
  }

  void judge_place(LineResult& out) {
    const Clamps& clamps = lab_->slave().clamps;
    if (!clamps.joint_position && !clamps.unreachable) {
      out.stood = false;  // nothing holds it: in position mode the hand ended before the boundary
      return;
    }
    const JointVector q = *lab_->setpoint_rad();
    const LineWalk on = walk(*inverse_, q, line_, 5e-5, 6e-3);
    out.short_m = on.way;
    out.left_out = !on.ends || grazes(*inverse_, on.joint_rad, line_);
  }

  void back(LineResult& out) {
    constexpr double kLongest_s = 12.0, kInward_m = 1e-4, kInward_rad = 4e-4, kMoved_m = 5e-5,
                     kMoved_rad = 2e-4;
    const double begin_s = lab_->now_s(), held_m = way_m(), held_rad = line_.about.dot(turned());
    double inward_s = INFINITY;
    out.back_s = INFINITY;
    while (lab_->now_s() < begin_s + kLongest_s && std::isinf(out.back_s)) {
      const double t_s = lab_->now_s() - begin_s;
      step(rate_ ? std::max(1.0 - t_s / 0.2, -0.5) : std::max(1.0 - t_s / 2.0, -0.5));
      const Pose& X = lab_->slave().X_WE;
      const Pose& goal = lab_->slave().X_WE_goal;
      const bool goes = line_.along.dot(goal.p - X.p) < -kInward_m;
      const bool turns = line_.about.dot(log_rotation(goal.q * X.q.conjugate())) < -kInward_rad;
      if ((goes || turns) && std::isinf(inward_s) && free_inward(goes, turns)) inward_s = lab_->now_s();
      const bool moved = way_m() < held_m - kMoved_m || line_.about.dot(turned()) < held_rad - kMoved_rad;
      if (moved) out.back_s = std::max(0.0, lab_->now_s() - inward_s);
    }
  }

  bool rate_;
  bool singular_ = false;
  double share_ = 0.0;
  SlaveConfig slave_;
  ToolLine line_;
  std::optional<Inverse> inverse_{};
  std::unique_ptr<Laboratory> lab_{};
  Pose from_{};
  std::vector<Vector3> path_m_{};         // of the tool, from from_
  std::vector<Vector3> singular_at_m_{};  // where it was near a singular pose
};

class CommandedLines : public testing::TestWithParam<const char*> {};

/// Results of the lines of one robot and mode.
struct LineSum {
  int ran = 0, stood = 0, grazing = 0, singular = 0, judged = 0, kept = 0;
  LineResult worst;  // of those that were kept

  void add(const LineResult& r) {
    ran += r.ran ? 1 : 0;
    stood += r.stood ? 1 : 0;
    grazing += r.stood && r.left_out ? 1 : 0;
    singular += r.stood && r.singular && !r.left_out ? 1 : 0;
    if (!r.stood || r.left_out || r.singular) return;
    ++judged;
    if (!keeps(r)) return;
    ++kept;
    worst.side_m = std::max(worst.side_m, r.side_m);
    worst.side_rad = std::max(worst.side_rad, r.side_rad);
    worst.tremble_m = std::max(worst.tremble_m, r.tremble_m);
    worst.short_m = std::max(worst.short_m, r.short_m);
    worst.back_s = std::max(worst.back_s, r.back_s);
  }
  static bool keeps(const LineResult& r) {
    return r.violations == 0 && r.side_m <= kSide_m && r.side_rad <= kSide_rad && r.tremble_m <= kTremble_m &&
           r.back_s <= kBack_s;
  }
};

// Lines that pass a singular pose, or end near one beyond which the arm continues, are counted, but not judged: there the
// tool leaves the straight path by up to 0.5 % of the reach and may exceed its acceleration limit.
TEST_P(CommandedLines, HoldTheToolAtEveryBoundary) {
  const int count = campaign(200, 20);
  const double kept = campaign(985, 1000) / 1000.0;  // share of the judged lines
  for (const bool rate : {true, false}) {
    std::vector<LineResult> results(static_cast<std::size_t>(count));
    on_all_cores(results.size(),
                 [&](std::size_t i) { results[i] = Holding(GetParam(), rate, static_cast<int>(i)).run(); });
    LineSum sum;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const LineResult& r = results[i];
      sum.add(r);
      EXPECT_LE(r.side_m, 0.05) << i;
      if (!r.stood || r.left_out || r.singular || LineSum::keeps(r)) continue;
      std::printf(
          "%s, %s, line %zu: %.2f mm and %.1f mrad aside, tremble %.0f um, back after %.2f s, %.0f setpoints "
          "beyond a limit (%s)\n",
          GetParam(), rate ? "rate" : "position", i, 1e3 * r.side_m, 1e3 * r.side_rad, 1e6 * r.tremble_m,
          r.back_s, static_cast<double>(r.violations), std::string(name_of(r.first)).c_str());
    }
    const LineResult& worst = sum.worst;
    std::printf(
        "%s, %s: of %d lines, %d held at a boundary; %d grazing, %d singular; %d of %d keep all bounds, with at most "
        "%.2f mm and %.1f mrad aside, tremble %.0f um, %.1f mm before the end, back after %.2f s\n",
        GetParam(), rate ? "rate" : "position", count, sum.stood, sum.grazing, sum.singular, sum.kept,
        sum.judged, 1e3 * worst.side_m, 1e3 * worst.side_rad, 1e6 * worst.tremble_m, 1e3 * worst.short_m,
        worst.back_s);
    EXPECT_GE(sum.judged, count / 4);
    EXPECT_GE(sum.kept, kept * sum.judged);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, CommandedLines,
                         testing::Values("cartesian.txtpb", "gantry.urdf", "irb120.txtpb", "kr6.txtpb",
                                         "puma560.txtpb", "space_arm.txtpb", "ur10.txtpb", "ur5e.txtpb"));

}  // namespace
}  // namespace longreach::commanded_line_test
