// The oracle of the campaign of faults sees what is wrong: each invariant is given a run that breaks it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "slave/kinematics/kinematics.hpp"
#include "tests/faults/invariant.hpp"
#include "tests/faults/trial.hpp"

namespace longreach::faults_oracle_test {
namespace {

constexpr std::uint64_t kAnySeed = 1;

class Oracle : public testing::Test {
 protected:
  Oracle() {
    moment_.sent_log = &sent_log_;
    moment_.affected_s.fill(1e9);
    moment_.slave_ran = moment_.master_ran = moment_.moves = true;
    for (int i = 0; i < kMaxJoints; ++i)
      moment_.setpoint_rad[i] = scenario_.slave.robot.joint[static_cast<std::size_t>(i)].start_rad;
    moment_.truth.joint_rad = moment_.setpoint_rad;
    moment_.X_WE = Kinematics(scenario_.slave.robot).forward(moment_.setpoint_rad);
  }

  /// One tick after the other, changed by `change`.
  void run(int ticks, const std::function<void(Moment&, int)>& change) {
    for (int i = 0; i < ticks; ++i) {
      moment_.t_s += moment_.period_s;
      moment_.slave_gap_s = moment_.master_gap_s = moment_.period_s;
      moment_.report.reset();
      change(moment_, i);
      for (const auto& invariant : invariants_) invariant->see(moment_);
    }
  }
  void claim(SafetyState state, HoldCause cause = HoldCause::kNone) {
    moment_.report = StiffnessReport{.engagement = moment_.engagement, .state = state, .cause = cause};
    moment_.claimed = state;
    moment_.cause = cause;
  }
  [[nodiscard]] bool broken(std::string_view name) const {
    const auto at = std::ranges::find_if(invariants_, [&](const auto& i) { return i->name() == name; });
    return at != invariants_.end() && (*at)->violated() > 0;
  }
  [[nodiscard]] std::string all_broken() const {
    std::string names;
    for (const auto& i : invariants_)
      if (i->violated() > 0) names += std::string(i->name()) + " ";
    return names;
  }

  Scenario scenario_ = draw_scenario(kAnySeed);
  SentLog sent_log_{0.1, 1.0};
  Moment moment_{};
  Invariants invariants_ = all_invariants(scenario_);
};

TEST_F(Oracle, FindsNothingWrongWithARobotThatStands) {
  run(3000, [](Moment&, int) {});
  EXPECT_EQ(all_broken(), "");
}

TEST_F(Oracle, SeesASetpointThatIsNoNumber) {
  run(1, [](Moment& m, int) { m.setpoint_rad[2] = std::nan(""); });
  EXPECT_TRUE(broken("I1"));
}

TEST_F(Oracle, SeesASetpointThatLeaps) {
  run(20, [](Moment& m, int i) { m.setpoint_rad[0] += i == 10 ? 0.02 : 0.0; });
  for (const char* name : {"I3", "I4", "I5"}) EXPECT_TRUE(broken(name)) << name;
}

TEST_F(Oracle, SeesAJointBeyondItsLimit) {
  run(1, [this](Moment& m, int) { m.truth.joint_rad[1] = scenario_.slave.robot.joint[1].max_rad + 0.1; });
  EXPECT_TRUE(broken("I2"));
}

TEST_F(Oracle, SeesAToolThatIsTooFast) {
  run(1500, [](Moment& m, int) { m.v_WE.x() = 1.0; });
  EXPECT_TRUE(broken("I6"));
}

TEST_F(Oracle, SeesAToolThatLeavesItsWorkspace) {
  run(1, [](Moment& m, int) { m.X_WE.p.x() += 10.0; });
  EXPECT_TRUE(broken("I7"));
}

// A creep of 1 mm/s while a limit holds the robot back; where it stands, nothing is wrong.
TEST_F(Oracle, SeesAToolThatCreepsAlongABoundary) {
  for (const double m_per_s : {0.0, 1e-3}) {
    run(6000, [&](Moment& m, int) {
      claim(SafetyState::kEngaged);
      m.shown = SafetyState::kEngaged;
      m.telemetry.emplace();
      m.telemetry->clamps.joint_position = true;
      m.X_WE.p.y() += m_per_s * m.period_s;
    });
    EXPECT_EQ(broken("I37"), m_per_s > 0.0);
  }
}

TEST_F(Oracle, SeesARobotThatMovesWithoutTheRightTo) {
  run(6000, [](Moment& m, int) { m.X_WE.p.x() += 1e-6; });
  EXPECT_TRUE(broken("I8"));
  EXPECT_FALSE(broken("I6"));
}

TEST_F(Oracle, SeesARobotThatDoesNotStop) {
  run(6000, [](Moment& m, int) { m.v_WE.x() = 0.01; });
  EXPECT_TRUE(broken("I9"));
}

TEST_F(Oracle, SeesARobotThatGoesOnWithoutASlave) {
  run(3000, [](Moment& m, int) {
    m.slave_ran = m.moves = false;
    m.v_WE.x() = 0.01;
  });
  EXPECT_TRUE(broken("I28"));
}

TEST_F(Oracle, SeesAnEngagementThatNobodyAskedFor) {
  moment_.engagement = 1;
  run(1, [this](Moment&, int) { claim(SafetyState::kEngaged); });
  EXPECT_TRUE(broken("I11"));
}

TEST_F(Oracle, SeesAHoldWithoutACause) {
  run(1, [this](Moment&, int) { claim(SafetyState::kHolding, HoldCause::kPreempted); });
  EXPECT_TRUE(broken("I30"));
}

TEST_F(Oracle, SeesAWallThatIsTakenForAWrongSensor) {
  run(1, [this](Moment& m, int) {
    m.affected_s[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(AffectedSignal::kScene)))] =
        0.0;
    claim(SafetyState::kFault, HoldCause::kSensorSign);
  });
  EXPECT_TRUE(broken("I30"));
}

TEST_F(Oracle, SeesAHeldToolThatGivesWayTooFar) {
  run(700, [this](Moment& m, int i) {
    claim(SafetyState::kHolding, HoldCause::kOperator);
    m.X_WE.p.x() -= i == 0 ? 0.0 : 3e-4;
  });
  EXPECT_TRUE(broken("I21e"));
}

TEST_F(Oracle, SeesAStopThatIsNone) {
  run(2, [this](Moment& m, int i) {
    m.stop_at_slave = i == 0;
    claim(SafetyState::kHolding, HoldCause::kOperator);
  });
  EXPECT_TRUE(broken("I29"));
}

TEST_F(Oracle, SeesForgeryOldNumbersAndLooseLimits) {
  run(1, [](Moment& m, int) {
    m.given_badly = m.number_again = m.configured = true;
    m.datagrams = 1;
    m.loosened = "safety.gap_s is looser";
    m.received = 5;
    m.accounted = 4;
  });
  for (const char* name : {"I13-15", "I19", "I20", "I27"}) EXPECT_TRUE(broken(name)) << name;
}

TEST_F(Oracle, SeesThatItFollowsWhatIsOld) {
  MotionCommand command;
  command.engagement = moment_.engagement = 1;
  command.request = Request::kEngage;
  sent_log_.asked();
  for (std::uint64_t n = 1; n <= 4000; ++n) sent_log_.master_sent(1e-3 * static_cast<double>(n), n, command);
  run(4000, [&](Moment& m, int i) {
    // From the second second on time goes on and the commands stay those of then.
    const auto number = static_cast<std::uint64_t>(std::min(i, 1000) + 1);
    Received<MotionCommand> received;
    received.sequence = number;
    received.message = command;
    if (i <= 1000) sent_log_.slave_given(m.t_s, m.slave_gap_s, {&received, 1});
    claim(SafetyState::kEngaged);
  });
  EXPECT_TRUE(broken("I16"));
}

TEST_F(Oracle, SeesAForceAboveTheGuard) {
  run(1, [this](Moment& m, int) { m.F_E_W.force.x() = 1.4 * scenario_.slave.command.force_guard_n; });
  EXPECT_TRUE(broken("I21"));
}

TEST_F(Oracle, SeesAHoldThatGoesOnPressing) {
  run(3000, [this](Moment& m, int) {
    m.F_E_W.force.x() = 0.9 * scenario_.slave.command.force_guard_n;
    claim(SafetyState::kHolding, HoldCause::kLinkSilent);
  });
  EXPECT_TRUE(broken("I21b"));
  EXPECT_FALSE(broken("I21d"));
}

TEST_F(Oracle, SeesAHoldThatGoesOnTurning) {
  run(3000, [this](Moment& m, int) {
    m.F_E_W.moment.x() = 0.9 * scenario_.slave.command.moment_guard_nm;
    claim(SafetyState::kHolding, HoldCause::kLinkSilent);
  });
  EXPECT_TRUE(broken("I21d"));
  EXPECT_FALSE(broken("I21b"));
}

TEST_F(Oracle, SeesAHandThatIsPushedTooHard) {
  run(1, [](Moment& m, int) { m.F_H_M.force.x() = 100.0; });
  EXPECT_TRUE(broken("I22"));
}

TEST_F(Oracle, SeesAForceOnTheHandThatLeaps) {
  moment_.shown = SafetyState::kEngaged;
  run(1, [](Moment& m, int) { m.F_H_M.force.x() = 2.0; });
  EXPECT_FALSE(broken("I22"));
  run(1, [](Moment& m, int) { m.F_H_M.force.x() = 9.0; });
  EXPECT_TRUE(broken("I22"));
}

TEST_F(Oracle, SeesAForceOnAHandThatIsNotEngaged) {
  moment_.handle.held = true;
  moment_.F_H_M.force.x() = 0.01;  // may be the damping of a hand that was freed
  run(600, [](Moment&, int) {});
  EXPECT_FALSE(broken("I22"));
  run(100, [](Moment&, int) {});
  EXPECT_TRUE(broken("I22"));
}

TEST_F(Oracle, SeesMoreThanDampingOnAHandThatWasFreed) {
  moment_.handle.held = true;
  run(100, [](Moment& m, int) {
    m.x_MH.x() += 1e-5;  // 0.01 m/s
    m.F_H_M.force.x() = -0.3;
  });
  EXPECT_FALSE(broken("I22"));
  run(1, [](Moment& m, int) { m.F_H_M.force.x() = -3.0; });
  EXPECT_TRUE(broken("I22"));
}

TEST_F(Oracle, SeesAStiffnessThatRisesWithoutAReport) {
  moment_.felt = true;
  run(5000, [](Moment& m, int) { m.rendered_n_per_m = 500.0; });
  EXPECT_FALSE(broken("I24"));
  run(1, [](Moment& m, int) { m.rendered_n_per_m = 501.0; });
  EXPECT_TRUE(broken("I24"));
}

TEST_F(Oracle, SeesAGoalThatRunsAwayFromARobotThatStands) {
  moment_.shown = SafetyState::kEngaged;
  claim(SafetyState::kEngaged);
  moment_.anchor_m = moment_.X_WE.p;
  run(8000, [](Moment& m, int) { m.goal_m.x() = 0.004; });
  EXPECT_FALSE(broken("I31"));
  run(8000, [](Moment& m, int i) { m.goal_m.x() += i < 100 ? 1e-4 : 0.0; });
  EXPECT_TRUE(broken("I31"));
}

TEST_F(Oracle, SeesAForceWhereNothingIs) {
  moment_.shown = SafetyState::kEngaged;
  claim(SafetyState::kEngaged);
  moment_.anchor_m = moment_.X_WE.p - Vector3(0.1, 0.0, 0.0);
  run(10, [](Moment&, int) {});
  EXPECT_FALSE(broken("I32"));
  run(1, [](Moment& m, int) { m.contact_n = 0.5; });
  EXPECT_TRUE(broken("I32"));
}

TEST_F(Oracle, SeesATickWithoutEnd) {
  run(1, [](Moment& m, int) { m.given = 1000; });
  EXPECT_TRUE(broken("I26"));
}

TEST_F(Oracle, SeesMoreEnergyComeOutOfTheHandleThanTheStoreHas) {
  const auto push = [](Moment& m, int) {
    m.F_H_M.force.x() = 1.0;
    m.x_MH.x() += 1e-5;
  };
  run(2000, push);
  EXPECT_FALSE(broken("I23"));
  run(200, push);
  EXPECT_TRUE(broken("I23"));
}

TEST_F(Oracle, SeesEnergyComeOutAfterALieOnlyFromAPortThatRested) {
  const auto push = [](Moment& m, int) {
    m.F_H_M.force.x() = 1.0;
    m.x_MH.x() += 1e-5;
  };
  const auto affected =
      static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(AffectedSignal::kHandle)));
  moment_.affected_s[affected] = 0.0;
  run(200, push);
  moment_.affected_s[affected] = 1e9;
  run(1000, push);  // what a spring that was stretched meanwhile gives back
  EXPECT_FALSE(broken("I23"));
  run(1, [](Moment& m, int) { m.F_H_M.force.setZero(); });
  run(1, [](Moment&, int) {});
  run(1000, push);  // what was put into the tanks meanwhile
  EXPECT_FALSE(broken("I23"));
  run(6000, push);
  EXPECT_TRUE(broken("I23"));
}

TEST_F(Oracle, DetectsMissingOrFalseRefusalReason) {
  const double late_s = scenario_.round_trip_s + 1.3;
  const int ticks = static_cast<int>(late_s / moment_.period_s);
  run(ticks, [](Moment& m, int i) { m.engage_asked = i == 0; });
  EXPECT_TRUE(broken("I33"));
  const auto shows = [&](HoldCause reason, double beyond_m) {
    invariants_ = all_invariants(scenario_);
    moment_.X_WE.p.x() += beyond_m;
    run(ticks, [&](Moment& m, int i) {
      m.engage_asked = i == 0;
      m.reason = reason;
    });
    moment_.X_WE.p.x() -= beyond_m;
    return broken("I33");
  };
  EXPECT_TRUE(shows(HoldCause::kToolOutside, 0.0)) << "it is not";
  EXPECT_FALSE(shows(HoldCause::kToolOutside, 2.0 * scenario_.slave.command.workspace_m));
}

TEST_F(Oracle, SeesAPictureOfWhatWasNot) {
  run(1, [](Moment& m, int) { m.seen = Telemetry{.X_WE = Pose{{1.0, 2.0, 3.0}}}; });
  EXPECT_TRUE(broken("I25"));
}

TEST_F(Oracle, SeesThatItDoesNotComeBack) {
  moment_.faults_over = true;
  run(20000, [](Moment& m, int i) { m.engage_asked = i == 15000; });
  EXPECT_TRUE(broken("L1"));
  EXPECT_TRUE(broken("L2"));
}

/// A product without a guard is found within this many seeds.
constexpr std::uint64_t kFound = 60;

class FaultsControl : public testing::TestWithParam<int> {};

TEST_P(FaultsControl, IsFound) {
  const DefectFacts& facts = kInjectedDefects[static_cast<std::size_t>(GetParam())];
  std::string others;
  for (std::uint64_t seed = 1; seed <= kFound; ++seed) {
    Schedule schedule = schedule_of(seed);
    if (!facts.fault.empty()) schedule.faults.push_back({std::string(facts.fault), 8.0, 3.0, 0.9, seed});
    std::ranges::stable_sort(schedule.faults, {}, &Fault::start_s);
    for (const Breach& v : run_trial(schedule, static_cast<InjectedDefect>(GetParam())).violations) {
      if (v.invariant == facts.invariant) return;
      others += v.invariant + " ";
    }
  }
  ADD_FAILURE() << facts.name << ": " << facts.invariant << " has not seen it; seen by " << others;
}

INSTANTIATE_TEST_SUITE_P(Sabotages, FaultsControl,
                         testing::Range(1, static_cast<int>(InjectedDefect::kCount)));

}  // namespace
}  // namespace longreach::faults_oracle_test
