// What comes or lies, by the equations of slave/sensing/force_answer.hpp: a wall on a rail, a tool that goes
// as it is asked to, a sensor that may have the wrong sign.
#include "slave/sensing/force_answer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::force_answer_test {
namespace {

using State = ForceAnswer::State;

constexpr double kDt = 1e-3, kBound_n = 16.0, kAcceleration = 1.25;

/// From this depth on, what is met is stiffer by this.
struct Layer {
  double depth_m, n_per_m;
};

/// x is out of the wall. `wall_m` at time t is where its surface is; the tool begins at 0. The hand moves the
/// tool, but not while the tool rests or gives way, and into the wall up to the guard only.
struct OnTheRail {
  double wall_n_per_m = 2e3;
  std::vector<Layer> layers{};
  double hand_m_per_s = 0.0;  // out of the wall
  std::function<double(double)> wall_m = [](double) { return 0.0; };
  double sign = 1.0;  // of the sensor
  double noise_n = 0.0;
  std::function<double(double)> fault_n{};  // instead of the wall's force
  ForceAnswer answer{ForceAnswerLimits{}};
  bool may_move = true, known = true;
  double t_s = 0.0, tool_m = 0.0, speed_m_per_s = 0.0;
  double most_n = 0.0;
  Random random{3};

  [[nodiscard]] double true_n() const {
    if (fault_n) return fault_n(t_s);
    const double depth_m = wall_m(t_s) - tool_m;
    double force_n = wall_n_per_m * std::max(depth_m, 0.0);
    for (const Layer& layer : layers) force_n += layer.n_per_m * std::max(depth_m - layer.depth_m, 0.0);
    return force_n;
  }
  [[nodiscard]] double wanted_m_per_s() const {
    if (answer.rests()) return 0.0;
    const double out = sign * answer.retreat_m_per_s();
    if (answer.gives_way()) return sign > 0.0 ? std::max(out, hand_m_per_s) : out;
    const double bleed = (true_n() - kBound_n / 0.8) / (2e4 * 0.2);
    return bleed > 0.0 && hand_m_per_s != 0.0 ? std::max(sign * bleed, hand_m_per_s) : hand_m_per_s;
  }
  State go(double seconds, const std::function<bool(State)>& until = {}) {
    for (int i = 0; i < std::lround(seconds / kDt); ++i) {
      const bool still = speed_m_per_s == 0.0;
      const double change = wanted_m_per_s() - speed_m_per_s;
      speed_m_per_s += std::clamp(change, -kAcceleration * kDt, kAcceleration * kDt);
      tool_m += speed_m_per_s * kDt;
      t_s += kDt;
      most_n = std::max(most_n, true_n());
      const double felt_n = true_n() + noise_n * random.normal();
      answer.step({tool_m * Vector3::UnitX(), felt_n, sign * Vector3::UnitX(), true_n() > 0.3, still,
                   may_move, kBound_n, kBound_n / 0.8, kDt, known});
      if (until && until(answer.state())) break;
    }
    return answer.state();
  }
};

auto coming(double m_per_s) {
  return [m_per_s](double t_s) { return m_per_s * t_s; };
}

TEST(ForceAnswer, AWallAtRestIsNotGivenWayTo) {
  OnTheRail rail;
  rail.wall_m = [](double) { return 9e-3; };
  rail.noise_n = 0.05;
  EXPECT_EQ(rail.go(5.0), State::kRest);
  EXPECT_EQ(rail.tool_m, 0.0);
  EXPECT_EQ(rail.answer.trend_n_per_s(), 0.0);
}

TEST(ForceAnswer, GrowthAtRestIsKnownSoonAfterTheTouch) {
  OnTheRail rail;
  rail.wall_m = coming(0.01);
  rail.go(1.0, [](State s) { return s == State::kGrowing; });
  EXPECT_NEAR(rail.t_s, 0.3 / 20.0 + 0.008 + 0.04, 3e-3);
  EXPECT_NEAR(rail.answer.trend_n_per_s(), 20.0, 1e-6);
}

// The tool lags behind its setpoint, or swings.
TEST(ForceAnswer, GrowthByTheToolsOwnWayIsNoGrowthAtRest) {
  ForceAnswer answer{ForceAnswerLimits{}};
  for (int i = 0; i < 200; ++i) {
    const double in_m = 1e-5 * i;
    answer.step({-in_m * Vector3::UnitX(), 2.0 + 5e3 * in_m, Vector3::UnitX(), true, true, true, kBound_n,
                 kBound_n / 0.8, kDt});
  }
  EXPECT_EQ(answer.state(), State::kRest);
}

TEST(ForceAnswer, AWallThatComesIsAnsweredAndFollowedAtItsSpeed) {
  for (const double k : {200.0, 2e3, 2e4}) {
    for (const double v : {1e-3, 0.01, 0.05}) {
      if (k * v > 250.0 || k * v < 1.0) continue;
      OnTheRail rail;
      rail.wall_n_per_m = k;
      rail.wall_m = coming(v);
      EXPECT_EQ(rail.go(2.0 * kBound_n / (k * v) + 2.0), State::kAnswered) << k << ' ' << v;
      EXPECT_LE(rail.most_n, 27.0) << k << ' ' << v;
      EXPECT_NEAR(rail.speed_m_per_s, v, 0.1 * v + 0.05 / k) << k;
      EXPECT_NEAR(rail.true_n(), kBound_n, 1.0) << k << ' ' << v;
    }
  }
}

TEST(ForceAnswer, AnUnknownWallIsLearntAtALightForce) {
  for (const double k : {200.0, 1e3, 5e3}) {
    for (const double v : {3e-4, 3e-3}) {
      OnTheRail rail;
      rail.wall_n_per_m = k;
      rail.wall_m = coming(v);
      rail.noise_n = 0.02;
      rail.known = false;
      EXPECT_EQ(rail.go(60.0, [](State s) { return s == State::kAnswered; }), State::kAnswered)
          << k << ' ' << v;
      EXPECT_LE(rail.most_n, 3.5) << k << ' ' << v;
      rail.go(0.2);
      EXPECT_LE(rail.tool_m, 4e-3) << k << ' ' << v;
      EXPECT_NEAR(rail.answer.coming_n_per_m(), k, 0.2 * k) << v;
    }
  }
}

// The force of a faulty sensor grows whether or not the tool retreats.
TEST(ForceAnswer, AForceThatDoesNotRespondMovesTheToolOnceByThreeMillimetres) {
  OnTheRail rail;
  rail.known = false;
  rail.fault_n = [](double t_s) { return 0.5 + t_s; };
  EXPECT_EQ(rail.go(10.0), State::kGrowing);
  EXPECT_GT(rail.tool_m, 2.9e-3);
  EXPECT_LT(rail.tool_m, 4e-3);
  EXPECT_EQ(rail.answer.coming_n_per_m(), 0.0);
}

TEST(ForceAnswer, AStiffnessThatWasKnownIsNotLearntAgain) {
  OnTheRail rail;
  rail.fault_n = [](double t_s) { return t_s < 1.0 ? 1.0 : t_s; };
  rail.go(1.0);
  rail.known = false;
  EXPECT_EQ(rail.go(10.0), State::kGrowing);
  EXPECT_EQ(rail.tool_m, 0.0);
}

TEST(ForceAnswer, AWrongSignIsFoundOnAWallThatComes) {
  for (const double k : {200.0, 2e3, 2e4}) {
    for (const double v : {1e-4, 1e-3, 0.01, 0.05}) {
      if (k * v > 250.0 || k * v < 0.1) continue;
      OnTheRail rail;
      rail.wall_n_per_m = k;
      rail.wall_m = coming(v);
      rail.sign = -1.0;
      rail.noise_n = 0.02;
      EXPECT_EQ(rail.go(200.0, [](State s) { return s == State::kWrongSign; }), State::kWrongSign)
          << k << ' ' << v;
      EXPECT_GT(rail.tool_m, -0.02) << "towards the wall";
      EXPECT_TRUE(rail.answer.rests());
      EXPECT_EQ(rail.answer.retreat_m_per_s(), 0.0);
    }
  }
}

/// The tool goes back as the guard asks it to, without a trend: into the wall where the sign is wrong.
State eased(double wall_n_per_m, double sign, double aside = 0.0) {
  ForceAnswer answer{ForceAnswerLimits{}};
  double out_m = 0.0, way_m = 0.0;
  for (int i = 0; i < 20000 && answer.state() != State::kWrongSign; ++i) {
    const double speed = answer.gives_way() ? answer.retreat_m_per_s() : answer.rests() ? 0.0 : 2e-3;
    const double force_n = 21.0 - sign * wall_n_per_m * out_m;
    if (force_n < 20.0 || way_m > 0.02) break;
    out_m += kDt * speed;
    way_m += kDt * speed * (aside > 0.0 ? std::sqrt(1.0 + aside * aside) : 1.0);
    answer.step({{out_m, aside * out_m, 0.0},
                 force_n,
                 Vector3::UnitX(),
                 true,
                 speed == 0.0,
                 true,
                 kBound_n,
                 20.0,
                 kDt});
  }
  return answer.state();
}

TEST(ForceAnswer, AWrongSignIsFoundAsTheGuardGivesWayToAWallAtRest) {
  for (const double k : {200.0, 2e3, 2e4}) {
    EXPECT_EQ(eased(k, -1.0), State::kWrongSign) << k;
    EXPECT_EQ(eased(k, 1.0), State::kRest) << k;
    EXPECT_NE(eased(k, -1.0, 0.5), State::kWrongSign) << k << ": it slides, and may meet more";
  }
}

// It follows the wall, so that its force neither falls nor grows; at rest it shows that it comes.
TEST(ForceAnswer, AWallThatTheGuardFollowsIsLookedAtAtRest) {
  ForceAnswer answer{ForceAnswerLimits{}};
  double out_m = 0.0, wall_m = 21.0 / 2e3;
  for (int i = 0; i < 6000 && !answer.answered(); ++i) {
    const double speed = answer.gives_way() ? answer.retreat_m_per_s() : answer.rests() ? 0.0 : 3e-3;
    out_m += kDt * speed;
    wall_m += kDt * 3e-3;
    answer.step({out_m * Vector3::UnitX(), 2e3 * (wall_m - out_m), Vector3::UnitX(), true, speed == 0.0, true,
                 kBound_n, 20.0, kDt});
  }
  EXPECT_TRUE(answer.answered());
  EXPECT_LT(out_m, 0.01);
}

TEST(ForceAnswer, AWallThatComesFasterAllTheTimeIsNoWrongSign) {
  for (const double m_per_s2 : {0.05, 0.5}) {
    OnTheRail rail;
    rail.wall_m = [=](double t_s) { return 0.5 * m_per_s2 * t_s * t_s; };
    bool wrong = false;
    rail.go(0.5, [&](State s) { return wrong = wrong || s == State::kWrongSign; });
    EXPECT_FALSE(wrong) << m_per_s2;
  }
}

/// Ever, as it comes; `wrong`: the sensor has the wrong sign.
bool called_wrong(double wall_n_per_m, double stiffer, double m_per_s, double hand_m_per_s,
                  bool wrong = false) {
  OnTheRail rail;
  rail.wall_n_per_m = wall_n_per_m;
  const double flesh_m = 0.5 * kBound_n / wall_n_per_m;
  const double bone_m = flesh_m + 0.53 * kBound_n / (stiffer * wall_n_per_m);
  rail.layers = {{flesh_m, (stiffer - 1.0) * wall_n_per_m},
                 {bone_m, stiffer * (stiffer - 1.0) * wall_n_per_m}};
  rail.wall_m = coming(m_per_s);
  rail.hand_m_per_s = hand_m_per_s;
  rail.noise_n = 0.02;
  rail.sign = wrong ? -1.0 : 1.0;
  bool sign = false;
  const double touches_s = 2.0 * kBound_n / (wall_n_per_m * m_per_s);
  rail.go(std::min(touches_s + 5.0, 60.0), [&](State s) { return sign = s == State::kWrongSign; });
  return sign;
}

// Its growth becomes many times as fast while the tool gives way.
TEST(ForceAnswer, ApproachingLayeredWallIsNotWrongSign) {
  for (const double k : {200.0, 600.0, 2e3}) {
    for (const double stiffer : {2.0, 4.0, 10.0}) {
      for (const double v : {1e-3, 3e-3, 0.01, 0.03}) {
        for (const double hand : {0.0, -0.02, -0.005, 0.2 * v, 0.8 * v}) {
          EXPECT_FALSE(called_wrong(k, stiffer, v, hand))
              << k << ' ' << stiffer << ' ' << v << " hand " << hand;
        }
        if (k * v >= 0.5) {
          EXPECT_TRUE(called_wrong(k, stiffer, v, 0.0, true)) << k << ' ' << stiffer << ' ' << v;
        }
      }
    }
  }
}

TEST(ForceAnswer, AWallThatSwingsIsNoWrongSign) {
  for (const double k : {500.0, 2e3, 1e4}) {
    for (const double hz : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
      for (const double amplitude_m : {1e-3, 2e-3, 3e-3, 6e-3, 0.01, 0.02}) {
        for (const double hand : {0.0, -0.02, -0.01, -0.005, 0.005, 0.01}) {
          OnTheRail rail;
          rail.wall_n_per_m = k;
          rail.noise_n = 0.02;
          rail.hand_m_per_s = hand;
          rail.wall_m = [=](double t_s) { return 1e-3 + amplitude_m * std::sin(6.2832 * hz * t_s); };
          bool sign = false;
          rail.go(20.0, [&](State s) { return sign = s == State::kWrongSign; });
          EXPECT_FALSE(sign) << k << ' ' << hz << " Hz " << amplitude_m << " hand " << hand << " at "
                             << rail.t_s;
        }
      }
    }
  }
}

TEST(ForceAnswer, AForceThatTheToolDoesNotMakeAnswersNothing) {
  OnTheRail drift;
  drift.fault_n = [](double t_s) { return 6.0 * t_s; };
  drift.noise_n = 0.02;
  drift.go(3.2);
  EXPECT_EQ(drift.answer.state(), State::kGivingWay);
  EXPECT_GT(drift.tool_m, 1e-3);
}

TEST(ForceAnswer, AWallThatStopsIsGivenWayToNoMoreAndCountsAsAtRest) {
  OnTheRail rail;
  rail.wall_m = [](double t_s) { return 0.01 * std::min(t_s, 2.0); };
  rail.go(2.0);
  ASSERT_EQ(rail.answer.state(), State::kAnswered);
  EXPECT_EQ(rail.go(3.0), State::kRest);
  EXPECT_EQ(rail.speed_m_per_s, 0.0);
  EXPECT_GT(rail.true_n(), 5.0) << "the contact lasts";
  EXPECT_LT(rail.true_n(), kBound_n + 0.5);
}

TEST(ForceAnswer, GivesWayToNothingWhereItMayNotMove) {
  OnTheRail rail;
  rail.wall_m = coming(0.01);
  rail.may_move = false;
  EXPECT_EQ(rail.go(2.0), State::kGrowing);
  EXPECT_EQ(rail.tool_m, 0.0);
}

TEST(ForceAnswer, EndsWithTheContact) {
  OnTheRail rail;
  rail.wall_m = [](double t_s) { return t_s < 2.0 ? 0.01 * t_s : -1.0; };
  rail.go(1.9);
  ASSERT_EQ(rail.answer.state(), State::kAnswered);
  EXPECT_EQ(rail.go(0.2), State::kRest);
  EXPECT_EQ(rail.answer.trend_n_per_s(), 0.0);
}

TEST(ForceAnswer, StaysFiniteWhateverItIsGiven) {
  for (const double force_n : {0.0, 1e-300, 1e15, 1e300}) {
    ForceAnswer answer{ForceAnswerLimits{.noise_n = 0.0}};
    for (int i = 0; i < 3000; ++i) {
      answer.step({Vector3::Constant(i % 3), force_n * (1.0 + 0.01 * i), Vector3::UnitX(), true, i % 100 < 60,
                   true, kBound_n, i % 2 == 0 ? kDt : 1e-12});
      ASSERT_TRUE(std::isfinite(answer.retreat_m_per_s()));
      ASSERT_GE(answer.retreat_m_per_s(), 0.0);
      ASSERT_LE(answer.retreat_m_per_s(), 0.25);
    }
  }
}

TEST(ForceAnswer, StopsToGiveWayWhereItMayMoveNoMore) {
  for (const State till : {State::kGivingWay, State::kAnswered}) {
    OnTheRail rail;
    rail.wall_m = coming(0.01);
    ASSERT_EQ(rail.go(5.0, [till](State s) { return s == till; }), till);
    rail.may_move = false;
    rail.go(kDt);
    EXPECT_EQ(rail.answer.state(), State::kGrowing);
    EXPECT_EQ(rail.answer.retreat_m_per_s(), 0.0);
    rail.may_move = true;
    EXPECT_EQ(rail.go(5.0), State::kAnswered);
  }
}

// It cannot rest, as the robot overshoots: what is known then decides.
TEST(ForceAnswer, ACheckEndsThoughTheToolDoesNotComeToRest) {
  OnTheRail rail;
  rail.wall_m = coming(0.01);
  rail.sign = -1.0;
  ASSERT_EQ(rail.go(50.0, [](State s) { return s == State::kChecking; }), State::kChecking);
  State last = State::kChecking;
  for (int i = 0; i < 5000 && last == State::kChecking; ++i) {
    const double in_m = rail.tool_m - 1e-6 * i;
    rail.t_s += kDt;
    const double force_n = 2e3 * std::max(0.01 * rail.t_s - in_m, 0.0);
    rail.answer.step({in_m * Vector3::UnitX(), force_n, -Vector3::UnitX(), true, false, true, kBound_n,
                      kBound_n / 0.8, kDt});
    last = rail.answer.state();
  }
  EXPECT_NE(last, State::kChecking);
}

}  // namespace
}  // namespace longreach::force_answer_test
