// The situations that are shown to the operator, against the truth of the scene: 23 scenarios over two links. At each moment the sentence
// must be true within its minimum duration, its numbers must be those of the scene at the time that the sentence names,
// and there are at most two changes a second.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "master/console/situation_watch.hpp"
#include "master/console/snapshot.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::situations_test {
namespace {

using enum Situation;

constexpr double kReaction_s = 0.6;  // minimum duration, and the period of the watch and of the telemetry
constexpr double kLeast_n = 0.5, kLeast_nm = 0.05;  // less may be noise of the sensor

constexpr std::string_view kWallStiffness = "scene.material.wall.stiffness_n_per_m=";

struct Act {
  double to_m = 0.0;  // position of the hand along x
  double wait_s = 2.0;
  std::function<void(Laboratory&)> begin{};
  double speed_m_per_s = 0.02;
  double turn_rad = 0.0;
  bool clutch = false, released = false;
  double aside_m = 0.0;  // position of the hand along y
};

struct Scenario {
  const char* name;
  std::vector<std::string> settings;
  std::vector<Act> acts;
  std::vector<Situation> shown;  // in this order, others may stand between them
};

/// What was true at each step of the watch.
struct Truth {
  double t_s = 0.0, tool_n = 0.0, hand_n = 0.0, tool_nm = 0.0;
  bool follows = false;  // the slave is engaged
};

class ScenarioRun {
 public:
  ScenarioRun(const std::string& profile, const Scenario& scenario)
      : bench_(settings(profile, scenario)),
        name_(profile + ", " + scenario.name),
        stiffness_n_per_m_(wall_of(scenario)),
        trip_s_(profile == "moon" ? 2.6 : 0.0) {
    lab().drive(hand_);
    run(3.0);
    lab().requests().engage = true;
    run(2.0 + 2.0 * trip_s_);
  }

  void act(const Act& act) {
    if (act.begin) act.begin(lab());
    hand_.buttons.clutch = act.clutch;
    hand_.grip = act.released ? Grip::kReleased : Grip::kFirm;
    const Vector3 from_m = hand_.position_m, to_m(act.to_m, act.aside_m, 0.0);
    const double turn_from = hand_.rotation_rad.z();
    const double moves_s =
        std::max((to_m - from_m).norm() / act.speed_m_per_s, std::abs(act.turn_rad - turn_from) / 0.1);
    const double begin_s = lab().now_s();
    const double lasts_s = moves_s + act.wait_s + 1.2 * trip_s_;
    while (lab().now_s() < begin_s + lasts_s) {
      const double share = moves_s > 0.0 ? std::min(1.0, (lab().now_s() - begin_s) / moves_s) : 1.0;
      hand_.position_m = from_m + share * (to_m - from_m);
      hand_.rotation_rad.z() = turn_from + share * (act.turn_rad - turn_from);
      lab().drive(hand_);
      step();
    }
  }

  void expect(const std::vector<Situation>& shown) const {
    auto at = keys_.begin();
    for (const Situation situation : shown) {
      at = std::find(at, keys_.end(), situation);
      if (at == keys_.end()) break;
    }
    std::string all;
    for (const Situation key : keys_) all += std::string(text_of(key).key) + "; ";
    EXPECT_TRUE(at != keys_.end() || shown.empty()) << name_ << ": " << all;
    std::printf("%s: %s\n", name_.c_str(), all.c_str());
  }

 private:
  static std::vector<std::string> settings(const std::string& profile, const Scenario& scenario) {
    std::vector<std::string> all{"profile=" + profile, "mapping.mode=POSITION"};
    if (scenario.settings.empty() || !scenario.settings.front().starts_with("scene_file="))
      all.emplace_back("scene.surface.wall.plane.point_m=0.02,0,0");
    all.insert(all.end(), scenario.settings.begin(), scenario.settings.end());
    return all;
  }
  /// Stiffness of the wall, N/m; 0: there is none, or it swings, so that it is not identified.
  static double wall_of(const Scenario& scenario) {
    if (std::string(scenario.name) == "a wall swings") return 0.0;
    for (const std::string& setting : scenario.settings)
      if (setting.starts_with(kWallStiffness)) return std::stod(setting.substr(kWallStiffness.size()));
    return 0.0;
  }
  Laboratory& lab() { return *bench_.lab; }
  void run(double seconds) {
    for (const double end_s = lab().now_s() + seconds; lab().now_s() < end_s;) step();
  }
  void step() {
    lab().step();
    if (ticks_++ % 20 != 0) return;
    ConsoleSnapshot s;
    s.view = lab().master();
    s.link = lab().link();
    s.seconds = lab().now_s();
    if (trip_s_ > 0.0) s.expected_rtt_s = trip_s_;
    const Shown shown = watch_.step(s);
    past_.push_back({s.seconds, lab().arm().true_wrench().force.norm(), s.view.spring_force_n.norm(),
                     lab().arm().true_wrench().moment.norm(), lab().slave().state == SafetyState::kEngaged});
    if (keys_.empty() || shown.situation != keys_.back()) {
      keys_.push_back(shown.situation);
      changed_s_.push_back(s.seconds);
      const std::size_t n = changed_s_.size();
      const bool urgent = shown.situation == kFault || shown.situation == kStopped;
      if (n >= 3 && !urgent) {
        EXPECT_GE(s.seconds - changed_s_[n - 3], 0.9) << name_ << ": " << shown.sentence;
      }
    }
    judge(s, shown);
  }
  /// Returns whether `is` held at some time in what the sentence can refer to.
  bool lately(double age_s, const std::function<bool(const Truth&)>& is) const {
    const double now_s = past_.back().t_s;
    for (auto it = past_.rbegin(); it != past_.rend() && it->t_s > now_s - age_s - kReaction_s; ++it)
      if (it->t_s <= now_s - age_s + 0.1 && is(*it)) return true;
    return past_.front().t_s > now_s - age_s - kReaction_s;
  }
  void judge(const ConsoleSnapshot& s, const Shown& shown) {
    if (failed_) return;
    const double age_s = s.view.far_known ? s.view.far_age_s + 0.5 * s.link.rtt_s.value_or(0.0) : 0.0;
    const std::string where = name_ + " at " + std::to_string(s.seconds) + " s: " + shown.sentence;
    const auto check = [&](bool holds, const char* what) {
      EXPECT_TRUE(holds) << where << ": " << what << " (true force " << past_.back().tool_n << " N)";
      failed_ = failed_ || !holds;
    };
    const Situation now = shown.situation;
    const auto is_one_of = [now](std::initializer_list<Situation> all) {
      return std::ranges::find(all, now) != all.end();
    };
    if (is_one_of({kTouching, kMeasuring, kFeltLess, kPushedBack, kUnsteady}))
      check(lately(age_s, [](const Truth& t) { return t.tool_n > 0.02 || t.tool_nm > 2e-3; }), "no contact");
    if (is_one_of({kFree, kRemembered, kSlow}))
      check(lately(age_s, [](const Truth& t) { return t.tool_n < kLeast_n && t.tool_nm < kLeast_nm; }),
            "something is touched");
    if (is_one_of({kFree, kTouching, kFeltLess, kPushedBack, kUnsteady, kGuarded, kAtLimit}))
      check(lately(age_s, [](const Truth& t) { return t.follows; }), "the robot does not follow");
    // In rate mode with the handle at home, the tool presses, but the hand feels no force; so it is until a spring is loaded.
    if (is_one_of({kTouching}) && s.view.mode == MotionMode::kPosition && s.view.stop_nm_per_rad == 0.0)
      check(lately(0.0, [](const Truth& t) { return t.hand_n > 0.0; }), "no force at the hand");
    if (is_one_of({kTouching, kFeltLess})) stiffness(shown.sentence, check);
    if (is_one_of({kHolding, kSilent, kStopped, kFault, kRestarted, kRecovered}))
      check(lately(0.0, [&](const Truth&) { return s.view.state != SafetyState::kEngaged; }) ||
                s.seconds - changed_s_.back() < kReaction_s,
            "the robot follows");
    numbers(shown.sentence, age_s, check);
  }
  /// What is displayed may be softer.
  void stiffness(const std::string& sentence, const std::function<void(bool, const char*)>& check) const {
    static const std::regex kSurface("a surface of ([0-9.]+) N/mm"), kStop("a stop of ([0-9.]+) N m/rad");
    std::smatch m;
    if (stiffness_n_per_m_ > 0.0 && std::regex_search(sentence, m, kSurface))
      check(std::abs(1e3 * std::stod(m[1]) / stiffness_n_per_m_ - 1.0) < 0.25, "stiffness of the surface");
    if (std::regex_search(sentence, m, kStop))
      check(std::abs(std::stod(m[1]) / 10.0 - 1.0) < 0.25, "stiffness of the stop");
  }
  void numbers(const std::string& sentence, double age_s,
               const std::function<void(bool, const char*)>& check) const {
    static const std::regex kTool("([0-9.]+) N at the tool"), kPress("presses with ([0-9.]+) N"),
        kHand("([0-9.]+) N at the hand");
    std::smatch m;
    if (std::regex_search(sentence, m, kHand))
      check(std::abs(std::stod(m[1]) - past_.back().hand_n) < 0.06 ||
                sentence.find("felt less") != std::string::npos,
            "force at the hand");
    if (!std::regex_search(sentence, m, kTool) && !std::regex_search(sentence, m, kPress)) return;
    const double shown_n = std::stod(m[1]), when_s = past_.back().t_s - age_s;
    double least = 1e9, most = 0.0;
    for (const Truth& t : past_)
      if (std::abs(t.t_s - when_s) < 0.15) least = std::min(least, t.tool_n), most = std::max(most, t.tool_n);
    check(least > most || (shown_n > least - 0.5 && shown_n < most + 0.5), "force at the tool");
  }

  clocks::Bench bench_;
  std::string name_;
  double stiffness_n_per_m_;  // of the wall; 0: not a spring
  double trip_s_;
  HandTarget hand_{.grip = Grip::kFirm};
  SituationWatch watch_;
  std::uint64_t ticks_ = 0;
  bool failed_ = false;
  std::vector<Truth> past_;
  std::vector<Situation> keys_;
  std::vector<double> changed_s_;
};

Session session(std::uint64_t number) {
  Session out;
  out.number = number;
  return out;
}

void impair(Laboratory& lab, double loss) {
  ImpairmentConfig c;
  c.loss = loss;
  lab.impair_slave(c);
  lab.impair_master(c);
}

std::string wall(double n_per_m) { return std::string(kWallStiffness) + std::to_string(n_per_m); }

const std::vector<Scenario> kScenarios = {
    {"moves freely", {}, {{.to_m = 0.01}, {.to_m = -0.03}}, {kReady, kFree}},
    {"presses and leaves",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 6.0}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree, kTouching, kFree}},
    {"a soft wall",
     {wall(200)},
     {{.to_m = 0.045, .wait_s = 6.0}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree, kTouching, kFree}},
    {"a stiff wall",
     {wall(20000)},
     {{.to_m = 0.028, .wait_s = 6.0}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree, kTouching, kFree}},
    {"presses fast and deep",
     {wall(1000)},
     {{.to_m = 0.05, .wait_s = 8.0, .speed_m_per_s = 0.15}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree, kTouching, kFree}},
    {"taps",
     {wall(1000)},
     {{.to_m = 0.03, .wait_s = 0.1, .speed_m_per_s = 0.1},
      {.to_m = 0.0, .wait_s = 2.0, .speed_m_per_s = 0.1},
      {.to_m = 0.03, .wait_s = 0.1, .speed_m_per_s = 0.1},
      {.to_m = 0.0, .wait_s = 4.0, .speed_m_per_s = 0.1}},
     {kFree}},
    {"releases in contact",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 6.0}, {.to_m = 0.035, .wait_s = 5.0, .released = true}},
     {kTouching, kReleased}},
    {"clutches in contact",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 6.0},
      {.to_m = 0.02, .wait_s = 3.0, .clutch = true},
      {.to_m = 0.02, .wait_s = 3.0}},
     {kTouching, kClutch}},
    {"changes the scale in contact",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 6.0},
      {.to_m = 0.035, .wait_s = 4.0, .begin = [](Laboratory& l) { l.requests().scale = 0.4; }}},
     {kTouching}},
    {"stops in contact",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 6.0},
      {.to_m = 0.035, .begin = [](Laboratory& l) { l.requests().stop = true; }},
      {.to_m = 0.035, .wait_s = 6.0, .begin = [](Laboratory& l) { l.requests().engage = true; }}},
     {kTouching, kStopped}},
    {"stops while it holds",
     {},
     {{.to_m = 0.01, .begin = [](Laboratory& l) { l.requests().hold = true; }},
      {.to_m = 0.01, .begin = [](Laboratory& l) { l.requests().stop = true; }}},
     {kFree, kHolding, kStopped}},
    {"loses the link",
     {},
     {{.to_m = 0.01, .wait_s = 4.0, .begin = [](Laboratory& l) { impair(l, 1.0); }},
      {.to_m = 0.01, .wait_s = 4.0, .begin = [](Laboratory& l) { impair(l, 0.0); }},
      {.to_m = 0.01, .wait_s = 4.0, .begin = [](Laboratory& l) { l.requests().engage = true; }}},
     {kFree, kSilent, kRecovered, kFree}},
    {"the slave is restarted",
     {},
     {{.to_m = 0.01, .wait_s = 3.0, .begin = [](Laboratory& l) { l.hand_slave(session(7)); }},
      {.to_m = 0.01, .wait_s = 3.0, .begin = [](Laboratory& l) { l.hand_master(session(7)); }}},
     {kFree, kRestarted}},
    {"the slave ends",
     {},
     {{.to_m = 0.01, .wait_s = 4.0, .begin = [](Laboratory& l) { l.kill_slave(); }}},
     {kFree, kSilent}},
    {"the robot fails",
     {},
     {{.to_m = 0.01,
       .wait_s = 3.0,
       .begin =
           [](Laboratory& l) {
             static OnRobot fails([](Time, RobotState& robot) { robot.ok = false; });
             l.set_fault_hooks(fails);
           }}},
     {kFree, kFault}},
    {"a wall approaches",
     {wall(1000), "scene.surface.wall.plane.point_m=0.3,0,0",
      "scene.surface.wall.movement.velocity_m_per_s=-0.02,0,0"},
     {{.wait_s = 20.0}},
     {kFree, kPushedBack}},
    {"a wall swings",
     {wall(1000), "scene.surface.wall.movement.amplitude_m=0.001,0,0",
      "scene.surface.wall.movement.frequency_hz=3"},
     {{.to_m = 0.032, .wait_s = 10.0}},
     {kFree, kUnsteady}},
    {"touches in rate mode",
     {wall(1000), "mapping.mode=RATE"},
     {{.to_m = 0.015, .wait_s = 8.0}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree, kTouching}},
    {"begins rate mode away from home",
     {"scene.surface.wall.plane.point_m=0.9,0,0"},
     {{.to_m = 0.03},
      {.to_m = 0.04, .wait_s = 3.0, .begin = [](Laboratory& l) { l.requests().mode = MotionMode::kRate; }},
      {.to_m = 0.0, .wait_s = 3.0},
      {.to_m = 0.015, .wait_s = 3.0}},
     {kFree, kBringHome, kFree}},
    {"turns a lever to its stop",
     {"scene_file=scenes/hinge.txtpb"},
     {{.wait_s = 6.0, .turn_rad = 0.12}, {.wait_s = 4.0, .turn_rad = 0.0}},
     {kFree, kTouching, kFree}},
    {"pushes a free body",
     {"scene_file=scenes/dock.txtpb"},
     {{.to_m = 0.05, .wait_s = 4.0, .speed_m_per_s = 0.03}, {.to_m = 0.0, .wait_s = 4.0}},
     {kFree}},
    {"slides along a wall",
     {wall(1000)},
     {{.to_m = 0.035, .wait_s = 5.0},
      {.to_m = 0.035, .wait_s = 2.0, .aside_m = 0.03},
      {.to_m = 0.0, .wait_s = 4.0, .aside_m = 0.03}},
     {kFree, kTouching, kFree}},
    {"leaves the workspace",
     {"command.workspace_m=0.05", "scene.surface.wall.plane.point_m=0.9,0,0", "mapping.scale=1"},
     {{.to_m = 0.065, .wait_s = 4.0}, {.to_m = 0.0, .wait_s = 3.0}},
     {kFree, kAtLimit, kFree}},
};

class Situations : public testing::TestWithParam<std::size_t> {};

TEST_P(Situations, AreTrueAtEachMoment) {
  const Scenario& scenario = kScenarios[GetParam()];
  for (const char* profile : {"lab", "moon"}) {
    ScenarioRun run(profile, scenario);
    for (const Act& act : scenario.acts) run.act(act);
    run.expect(scenario.shown);
  }
}

INSTANTIATE_TEST_SUITE_P(Loop, Situations, testing::Range<std::size_t>(0, kScenarios.size()),
                         [](const auto& info) {
                           std::string name = kScenarios[info.param].name;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace longreach::situations_test
