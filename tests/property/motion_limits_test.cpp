// Goals that go anywhere: straight through singular poses or close by, out of reach and back, in jumps, away
// for a while. LONGREACH_FULL: 10,005 paths.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "deploy/lab/campaign_size.hpp"
#include "tests/property/motion_drive.hpp"

namespace longreach::motion_limits_test {
namespace {

using namespace test;

// How much later than prompt: within this many times the swiftest, and some seconds.
double late_s(const Arrival& arrival) {
  constexpr double kPrompt = 2.0, kPromptS = 2.0;
  return arrival.s - kPrompt * arrival.swiftest_s - kPromptS;
}

struct Summary {
  int paths = 0, arrived = 0, prompt = 0;
  std::vector<double> arrived_s, off;  // off: share of the reach
  Worst worst{};
  double silent_m = 0.0, silent_rad = 0.0;

  void add(const Drive& drive) {
    ++paths;
    const Outcome& o = drive.outcome;
    if (o.arrived) ++arrived, arrived_s.push_back(o.from_rest.s);
    if (o.arrived && late_s(o.from_rest) <= 0.0) ++prompt;
    off.push_back(o.off_m / drive.arm.reach_m());
    silent_m = std::max(silent_m, o.silent_m);
    silent_rad = std::max(silent_rad, o.silent_rad);
    const Worst& w = drive.worst;
    worst.speed = std::max(worst.speed, w.speed);
    worst.acceleration = std::max(worst.acceleration, w.acceleration);
    worst.jerk = std::max(worst.jerk, w.jerk);
    worst.tool_m_per_s = std::max(worst.tool_m_per_s, w.tool_m_per_s);
    worst.tool_rad_per_s = std::max(worst.tool_rad_per_s, w.tool_rad_per_s);
    worst.singular = std::max(worst.singular, w.singular);
  }

  static double quantile(std::vector<double> x, double share) {
    if (x.empty()) return 0.0;
    std::sort(x.begin(), x.end());
    return x[static_cast<std::size_t>(share * static_cast<double>(x.size() - 1))];
  }

  void print(const std::string& name) const {
    std::printf("%s: of %d, %d arrived promptly, %d later, having said why; the others stand and say why\n",
                name.c_str(), paths, prompt, arrived - prompt);
    std::printf("  after %.2f s (median), %.2f s (last)\n", quantile(arrived_s, 0.5),
                quantile(arrived_s, 1.0));
    std::printf("  off the way %.1e (median), %.1e (most) of the reach; untold %.3f m, %.3f rad\n",
                quantile(off, 0.5), quantile(off, 1.0), silent_m, silent_rad);
    std::printf("  of the joint limits %.4f speed, %.4f acceleration, %.4f jerk; tool %.4f m/s, %.4f rad/s; ",
                worst.speed, worst.acceleration, worst.jerk, worst.tool_m_per_s, worst.tool_rad_per_s);
    std::printf("branches change at singular values <= %.1e\n", worst.singular);
    std::fflush(stdout);
  }
};

class Motion : public testing::TestWithParam<Kind> {};

void expect_limits(const Drive& drive) {
  const Worst& worst = drive.worst;
  EXPECT_LE(worst.position, 0.0);
  EXPECT_LE(worst.speed, 1.0 + 1e-9);
  EXPECT_LE(worst.acceleration, 1.0 + 1e-7);
  EXPECT_LE(worst.jerk, 1.0 + 1e-6);
  constexpr double kMean = 1.01;  // the setpoint is a mean of joints, and the tool at it is not
  EXPECT_LE(worst.tool_m_per_s, kMean * drive.command.speed_max_m_per_s);
  EXPECT_LE(worst.tool_rad_per_s, kMean * drive.command.speed_max_rad_per_s);
  // In one tick no joint gets farther from a singular pose than this.
  EXPECT_LE(worst.singular, 0.01);
}

// Braking for a goal that comes towards the tool and the few ms of the jerk limit go without saying; whatever
// is more is told.
void expect_reported(const Drive& drive) {
  constexpr double kBraking = 0.8, kLateS = 0.008;  // share of the acceleration (vector_limit.hpp)
  const CommandConfig& c = drive.command;
  const double v = c.speed_max_m_per_s, w = c.speed_max_rad_per_s;
  EXPECT_LE(drive.outcome.silent_m, 2.0 * v * v / (kBraking * c.acceleration_max_m_per_s2) + kLateS * v);
  EXPECT_LE(drive.outcome.silent_rad, 2.0 * w * w / (kBraking * c.acceleration_max_rad_per_s2) + kLateS * w);
}

// The arm arrives promptly once nothing is in its way any more, or stands and says why.
void expect_prompt(const Outcome& outcome) {
  EXPECT_TRUE(outcome.arrived || outcome.hindered);
  if (!outcome.arrived) return;
  EXPECT_LE(late_s(outcome.from_free), 0.0) << outcome.from_free.s << " s";
}

// An arm that stands in its own way leaves when its goal does: to joints that lie nearer to the middle.
void expect_it_leaves(Drive& drive) {
  const JointVector q = drive.motion.joint_setpoint_rad();
  JointVector inner = q;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = drive.robot.joint[static_cast<std::size_t>(i)];
    inner[i] += 0.05 * (0.5 * (j.min_rad + j.max_rad) - q[i]);
  }
  drive.settle(drive.arm.forward(inner));
  EXPECT_TRUE(drive.outcome.arrived);
  EXPECT_LE(late_s(drive.outcome.from_rest), 0.0) << drive.outcome.from_rest.s << " s";
}

void expect_path(Kind kind, const NamedArm& arm, int number, Summary& summary) {
  SCOPED_TRACE(arm.name + std::string(", ") + kNames[kind] + ' ' + std::to_string(number));
  const Kinematics kinematics(arm.robot);
  CommandConfig command;
  command.workspace_m = 4.0 * kinematics.reach_m();
  Random random = Random(static_cast<std::uint64_t>(1000 * kind + number)).child(arm.name);
  const Tour tour = make_tour(kind, arm.robot, kinematics, command, random);
  Drive drive(arm.robot, kinematics, command, tour);
  drive.follow(random);
  drive.settle(tour.legs.back().to);
  expect_prompt(drive.outcome);
  expect_reported(drive);
  summary.add(drive);
  if (!drive.outcome.arrived) expect_it_leaves(drive);
  expect_limits(drive);
}

TEST_P(Motion, KeepsEveryLimitOnEveryPathAndArrivesOrSaysWhyNot) {
  const Kind kind = GetParam();
  for (const NamedArm& arm : limited_arms()) {
    Summary summary;
    for (int n = campaign(667, 3); n > 0; --n) expect_path(kind, arm, n, summary);
    summary.print(arm.name + std::string(", ") + kNames[kind]);
    // Goals on the way between two poses of one branch may still lie behind a joint limit of it.
    const double least = kind == kLimits ? 0.5 : 0.97;
    EXPECT_GE(summary.prompt, static_cast<int>(least * summary.paths)) << arm.name << ' ' << kNames[kind];
  }
}

INSTANTIATE_TEST_SUITE_P(Goals, Motion, testing::Values(kSingular, kBeside, kOutOfReach, kJumps, kLimits));

// Paths of the full campaign that fail without one of the rules (tests/rules).
TEST(MotionRules, AreEachNeededOnSomePath) {
  constexpr std::size_t kSpaceArm = 0, kPuma = 1, kUr10 = 2;
  struct Path {
    Kind kind;
    std::size_t arm;
    int number;
    bool arrives;
  };
  const std::vector<NamedArm> arms = limited_arms();
  for (const Path& path : {Path{kSingular, kPuma, 107, true}, Path{kSingular, kSpaceArm, 146, true},
                           Path{kSingular, kSpaceArm, 42, true}, Path{kLimits, kUr10, 12, false},
                           Path{kLimits, kPuma, 114, false}, Path{kLimits, kPuma, 525, false},
                           Path{kLimits, kUr10, 178, true}, Path{kLimits, kUr10, 368, false}}) {
    Summary summary;
    expect_path(path.kind, arms[path.arm], path.number, summary);
    EXPECT_EQ(summary.prompt, path.arrives ? 1 : 0) << kNames[path.kind] << ' ' << path.number;
  }
}

}  // namespace
}  // namespace longreach::motion_limits_test
