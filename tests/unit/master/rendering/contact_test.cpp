#include "master/rendering/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace longreach::contact_test {
namespace {

/// The goal moves along `direction` by 0.1 mm a command, from zero at sequence 1.
GoalHistory moving(const Vector3& direction, int commands) {
  GoalHistory history(1024);
  for (int i = 0; i < commands; ++i) history.push(static_cast<std::uint64_t>(i) + 1, 1e-4 * i * direction);
  return history;
}

/// A surface that is pressed along `inward`.
ReportedSurface pressed(const Vector3& inward, double k, double sequence, std::uint32_t touch = 1) {
  return {.normal = -inward, .stiffness = k, .touch_sequence = sequence, .touch = touch, .pressed = true};
}

ContactReport contact(const ReportedSurface& first, const ReportedSurface& second = {},
                      const ReportedSurface& third = {}) {
  return {.surfaces = {first, second, third}};
}

/// A contact and the mapping that it is felt through: position mode, scale 1, the handle at rest at `x`.
struct Bench {
  explicit Bench(const Vector3& direction, int commands = 400) : history(moving(direction, commands)) {
    mapping.reset({});
    mapping.step({{}, MotionMode::kPosition, 1.0, false}, 1e-3);
  }

  ContactChange report(const ContactReport& c) { return felt.on_report(c, history, at, mapping); }
  Vector3 press(const Vector3& x) {
    at.x = x;
    return felt.step(at, mapping, false, tank, 1e-3);
  }

  GoalHistory history;
  Mapping mapping{MappingConfig{}};
  EnergyTank tank{0.02};
  Contact felt{ContactMotion::kTranslation, ContactConfig{}};
  ContactHandle at{};
};

TEST(GoalHistory, InterpolatesBetweenCommandsAndKnowsItsEnds) {
  const GoalHistory history = moving(Vector3::UnitX(), 100);
  EXPECT_NEAR(history.at(50.25)->x(), 49.25e-4, 1e-15);
  EXPECT_TRUE(history.at(1.0).has_value());
  EXPECT_TRUE(history.at(100.0).has_value());
  EXPECT_FALSE(history.at(0.5).has_value());
  EXPECT_FALSE(history.at(100.5).has_value());
  EXPECT_FALSE(history.at(std::nan("")).has_value());
  EXPECT_FALSE(history.at(1e300).has_value());
}

TEST(GoalHistory, ForgetsTheOldestWhenFull) {
  GoalHistory history(16);
  for (std::uint64_t i = 1; i <= 40; ++i) history.push(i, Vector3(static_cast<double>(i), 0.0, 0.0));
  EXPECT_FALSE(history.at(24.0).has_value());
  EXPECT_NEAR(history.at(25.0)->x(), 25.0, 1e-12);
  EXPECT_NEAR(history.at(40.0)->x(), 40.0, 1e-12);
  EXPECT_TRUE(history.forgotten(24.0));
  EXPECT_FALSE(history.forgotten(25.0));
  EXPECT_FALSE(history.forgotten(41.0));
  EXPECT_FALSE(history.forgotten(std::nan("")));
}

TEST(Contact, LiesWhereTheGoalWasAtTheTouch) {
  const Vector3 n = Vector3(1.0, 2.0, -2.0).normalized();
  Bench b(n);
  EXPECT_EQ(b.report(contact(pressed(n, 1000.0, 101.5))), ContactChange::kUpdated);
  const ContactAxis& axis = b.felt.foremost();
  EXPECT_NEAR((axis.n_W - n).norm(), 0.0, 1e-9);
  EXPECT_NEAR(axis.surface, 100.5e-4, 1e-12);
  EXPECT_NEAR(axis.reported, 1000.0, 1e-9);
}

TEST(Contact, FeelsTheTangentFromItsFootOn) {
  const Vector3 n = Vector3::UnitX();
  Bench b(n);
  ReportedSurface surface = pressed(n, 1500.0, 101.0);  // at 10 mm
  surface.foot = 1e-3;
  b.report(contact(surface));
  b.press(0.005 * n);
  EXPECT_TRUE(b.press(0.0109 * n).isZero(0.0));
  EXPECT_NEAR(b.press(0.013 * n).x(), -3.0, 1e-6);
}

TEST(Contact, ASurfaceOlderThanTheEngagementLiesAtItsOffset) {
  const Vector3 n = Vector3(0.0, -0.6, 0.8);
  Bench b(Vector3::UnitX());
  ReportedSurface surface = pressed(n, 1000.0, 0.0);
  surface.offset = 0.005;  // in front of where the engagement began
  b.report(contact(surface));
  EXPECT_NEAR(b.felt.foremost().surface, -0.005, 1e-12);
  b.tank.fill(0.02);
  for (int i = 0; i < 5000; ++i) b.press(Vector3::Zero());
  EXPECT_NEAR(b.press(Vector3::Zero()).dot(n), -5.0, 0.05);
}

TEST(Contact, FeelsBothSidesOfASlot) {
  Bench b(Vector3::UnitX());
  ReportedSurface right = pressed(Vector3::UnitX(), 1000.0, 101.0, 1);
  right.pressed = false;
  ReportedSurface left = pressed(-Vector3::UnitX(), 2000.0, 0.0, 2);
  left.offset = -0.01;
  b.report(contact(left, right));
  b.press(Vector3::Zero());
  EXPECT_NEAR(b.press({0.012, 0.0, 0.0}).x(), -2.0, 1e-6);
  b.press(Vector3::Zero());
  EXPECT_NEAR(b.press({-0.012, 0.0, 0.0}).x(), 4.0, 1e-6);
}

// A damper that appeared at once with its spring would be a step.
TEST(Contact, ADamperNeverExceedsItsSpring) {
  Bench b(Vector3::UnitX());
  b.felt = Contact(ContactMotion::kTranslation, {.damping = 20.0});
  (void)b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  const auto force_n = [&b](double m_per_s) {
    Bench moved = b;
    moved.at.rate.x() = m_per_s;
    return -moved.press({0.011, 0.0, 0.0}).x();
  };
  const double spring_n = force_n(0.0);
  EXPECT_GT(spring_n, 0.0);
  EXPECT_NEAR(force_n(10.0), 2.0 * spring_n, 1e-9);
  EXPECT_NEAR(force_n(-10.0), 0.0, 1e-9) << "it does not pull, either";
}

// The ramp of a force that must vanish is that of the spring and its damper together.
TEST(Contact, VanishesByTheSameRampWithItsDamper) {
  for (const double m_per_s : {0.0, 0.02, 0.2, 2.0}) {
    Bench b(Vector3::UnitX());
    b.felt = Contact(ContactMotion::kTranslation, {.damping = 20.0});
    (void)b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
    (void)b.press({0.005, 0.0, 0.0});
    b.at.rate.x() = m_per_s;
    double before_n = -b.press({0.013, 0.0, 0.0}).x(), largest_n = 0.0;
    EXPECT_GE(before_n, 3.0 - 1e-9);
    b.at.clutched = true;
    for (int i = 0; i < 200; ++i) {
      const double now_n = -b.press({0.013, 0.0, 0.0}).x();
      largest_n = std::max(largest_n, before_n - now_n);
      before_n = now_n;
    }
    EXPECT_LE(largest_n, 0.3 + 1e-9) << m_per_s;
    EXPECT_EQ(before_n, 0.0);
  }
}

TEST(Contact, PushesAgainstDepthAndNotAlongTheSurface) {
  const Vector3 n = Vector3(1.0, 2.0, -2.0).normalized();
  Bench b(n);
  b.report(contact(pressed(n, 1000.0, 101.0)));
  const Vector3 beside = n.cross(Vector3::UnitX()).normalized();
  b.press(0.005 * n);  // before the surface
  const Vector3 force = b.press(0.012 * n + 0.003 * beside);
  EXPECT_NEAR(force.dot(n), -2.0, 1e-6);
  EXPECT_NEAR(force.dot(beside), 0.0, 1e-9);
}

TEST(Contact, EasesOnAHandleThatIsLetGoAndGrowsAgainFromNothing) {
  const Vector3 n = Vector3::UnitX();
  Bench b(n);
  b.tank.fill(0.02);
  b.report(contact(pressed(n, 1000.0, 101.0)));
  b.press(0.005 * n);
  EXPECT_NEAR(b.press(0.012 * n).norm(), 2.0, 1e-6);
  b.at.held = false;
  for (int i = 0; i < 200; ++i) b.press(0.012 * n);
  // The stiffness fades, and the anchor comes to the handle.
  EXPECT_NEAR(b.press(0.012 * n).norm(), 2.0 * std::exp(-2.0 * 201e-3 / 0.2), 1e-6);
  for (int i = 0; i < 2000; ++i) b.press(0.012 * n);
  b.at.held = true;
  const double first_n = b.press(0.012 * n).norm();
  EXPECT_LT(first_n, 0.1);
  for (int i = 0; i < 3000; ++i) b.press(0.012 * n);
  EXPECT_NEAR(b.press(0.012 * n).norm(), 2.0, 1e-3);
}

TEST(Contact, FeelsEveryPlaneOfACorner) {
  const Vector3 diagonal = Vector3::Ones().normalized();
  Bench b(diagonal);
  b.report(contact(pressed(Vector3::UnitX(), 500.0, 101.0, 1), pressed(Vector3::UnitY(), 1000.0, 101.0, 2),
                   pressed(Vector3::UnitZ(), 2000.0, 101.0, 3)));
  b.press(Vector3::Zero());
  const double surface = 100e-4 / std::sqrt(3.0);
  const Vector3 force = b.press(Vector3::Constant(surface + 1e-3));
  EXPECT_LT((force - Vector3(-0.5, -1.0, -2.0)).norm(), 1e-6);
}

TEST(Contact, KeepsAPlaneThatHoldsWhenASecondOneIsMet) {
  Bench b(Vector3(1.0, 1.0, 0.0));
  const ReportedSurface first = pressed(Vector3::UnitX(), 1000.0, 101.0, 1);
  b.report(contact(first));
  b.press(Vector3::Zero());
  const Vector3 pressing(12e-3, 11e-3, 0.0);
  const double before_n = b.press(pressing).x();
  b.report(contact(pressed(Vector3::UnitY(), 1000.0, 111.0, 2), first));
  EXPECT_NEAR(b.press(pressing).x(), before_n, 1e-9);
  EXPECT_NEAR(b.press(pressing + Vector3(0.0, 1e-3, 0.0)).y(), -1.0, 0.02);
}

TEST(Contact, IsForgottenWhenTheSlaveHasForgottenIt) {
  Bench b(Vector3::UnitX());
  ReportedSurface surface = pressed(Vector3::UnitX(), 1000.0, 101.0);
  b.report(contact(surface));
  surface.pressed = false;
  b.report(contact(surface));
  EXPECT_TRUE(b.felt.known());
  b.press({0.005, 0.0, 0.0});
  EXPECT_NEAR(b.press({0.012, 0.0, 0.0}).x(), -2.0, 1e-6) << "what is remembered is felt at once";
  b.report(contact({}));
  EXPECT_FALSE(b.felt.known());
}

// Both programs stood still, and the handle went on without force: what is known is old in the first tick.
TEST(Contact, FadingContactIsNotReloadedByDeeperHandle) {
  const Vector3 n = Vector3::UnitX();
  for (const bool stale : {true, false}) {
    Bench b(n);
    b.report(contact(pressed(n, 1000.0, 101.0)));
    b.press(0.005 * n);
    const double before_n = b.press(0.0105 * n).norm();
    EXPECT_NEAR(before_n, 0.5, 1e-6);
    if (!stale) b.report(contact({}));
    b.at.x = 0.0185 * n;
    for (int i = 0; i < 300; ++i)
      ASSERT_LE(b.felt.step(b.at, b.mapping, stale, b.tank, 1e-3).norm(), before_n + 1e-9) << i;
  }
}

constexpr double kRamp_n = 0.3;  // a tick: 15 N in 50 ms

TEST(Contact, HasNoForceWhileTheGoalIsInFrontInRateMode) {
  Bench b(Vector3::UnitX());
  b.at.rate_mode = true;
  b.at.deflection = {0.1, 0.0, 0.0};
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  b.at.goal = {0.009, 0.0, 0.0};
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(b.press({1e-3 * i, 0.0, 0.0}).isZero(0.0)) << i;
  b.tank.fill(0.02);
  b.at.goal = {0.012, 0.0, 0.0};
  for (int i = 0; i < 1000; ++i) b.press({0.1, 0.0, 0.0});
  EXPECT_NEAR(b.press({0.1, 0.0, 0.0}).x(), -2.0, 0.05);
  b.at.goal = {0.009, 0.0, 0.0};
  EXPECT_NEAR(b.press({0.1, 0.0, 0.0}).x(), -2.0 + kRamp_n, 0.05) << "a ramp, not a step";
  for (int i = 0; i < 10; ++i) b.press({0.1, 0.0, 0.0});
  EXPECT_TRUE(b.press({0.1, 0.0, 0.0}).isZero(0.0));
}

TEST(Contact, NeverDrivesTheHandleBeyondTheCentreOfRateMode) {
  Bench b(Vector3::UnitX());
  b.at.rate_mode = true;
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  b.at.goal = {0.02, 0.0, 0.0};  // 10 mm in
  for (const double deflection_m : {0.004, 0.001, 0.0, -0.002}) {
    b.tank.fill(0.02);
    b.at.deflection = {deflection_m, 0.0, 0.0};
    for (int i = 0; i < 2000; ++i) b.press({0.1, 0.0, 0.0});
    EXPECT_NEAR(b.press({0.1, 0.0, 0.0}).x(), -1000.0 * std::max(0.0, deflection_m), 0.05) << deflection_m;
  }
}

TEST(Contact, HasNoForceWhileClutchedAndGrowsAgain) {
  Bench b(Vector3::UnitX());
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  for (int i = 0; i <= 30; ++i) b.press({1e-4 * i + 0.01, 0.0, 0.0});
  EXPECT_NEAR(b.press({0.013, 0.0, 0.0}).x(), -3.0, 1e-6);
  b.at.clutched = true;
  for (int i = 1; i < 5; ++i)
    EXPECT_NEAR(b.press({0.013 + 1e-3 * i, 0.0, 0.0}).x(), -3.0 + kRamp_n * i, 1e-6) << "no hand loads it";
  for (int i = 0; i < 7; ++i) b.press({0.018, 0.0, 0.0});
  for (const double x : {0.013, 0.02, 0.011}) EXPECT_TRUE(b.press({x, 0.0, 0.0}).isZero(0.0)) << x;
  b.at.clutched = false;
  b.tank.fill(0.02);
  for (int i = 0; i < 2000; ++i) b.press({0.013, 0.0, 0.0});
  EXPECT_NEAR(b.press({0.013, 0.0, 0.0}).x(), -3.0, 0.05);
}

TEST(Contact, GoesOnInATouchThatIsOlderThanWhatIsRemembered) {
  Bench b(Vector3::UnitX());
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  for (std::uint64_t i = 401; i <= 2000; ++i) b.history.push(i, Vector3(0.04, 0.0, 0.0));
  ASSERT_FALSE(b.history.at(101.0).has_value());
  EXPECT_EQ(b.report(contact(pressed(Vector3::UnitX(), 1500.0, 101.0))), ContactChange::kUpdated);
  EXPECT_NEAR(b.felt.foremost().reported, 1500.0, 1e-9);
  EXPECT_NEAR(b.felt.foremost().surface, 100e-4, 1e-12);
  // One that is new cannot be placed.
  EXPECT_EQ(b.report(contact(pressed(Vector3::UnitY(), 1000.0, 101.0, 2))), ContactChange::kNone);
  EXPECT_FALSE(b.felt.known());
}

TEST(Contact, DoesNotTurnWhileForceIsRenderedButFadesAndTurnsThen) {
  Bench b(Vector3(1.0, 1.0, 0.0));
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0)));
  b.press(Vector3::Zero());
  const Vector3 pressing(12e-3, 12e-3, 0.0);
  const Vector3 before = b.press(pressing);
  ASSERT_NEAR(before.x(), -2.0, 1e-6);
  const Vector3 oblique = Vector3(1.0, 1.0, 0.0).normalized();
  b.report(contact(pressed(oblique, 900.0, 150.0, 2)));
  EXPECT_LT((b.press(pressing) - before).norm(), 0.02);
  for (int i = 0; i < 3000; ++i) b.press(pressing);
  EXPECT_LT(b.press(pressing).norm(), 0.05);  // what was wrong has eased away
  b.press(Vector3::Zero());
  b.report(contact(pressed(oblique, 900.0, 150.0, 2)));
  EXPECT_NEAR(b.felt.foremost().n_W.dot(oblique), 1.0, 1e-9);
}

TEST(Contact, TellsTheForceOfAllSprings) {
  Bench b(Vector3(1.0, 1.0, 0.0));
  b.report(contact(pressed(Vector3::UnitX(), 1000.0, 101.0), pressed(Vector3::UnitY(), 500.0, 101.0, 2)));
  b.press(Vector3::Zero());
  const Vector3 force = b.press({12e-3, 14e-3, 0.0});
  EXPECT_LT(force.x(), -0.5);
  EXPECT_LT(force.y(), -0.5);
  EXPECT_LT((b.felt.spring_force() - force).norm(), 1e-9);
}

TEST(Contact, RejectsWhatIsImpossibleOrWasNeverCommanded) {
  Bench b(Vector3::UnitX(), 100);
  const ReportedSurface good = pressed(Vector3::UnitX(), 1000.0, 50.0);
  const auto rejected = [&b, &good](auto change) {
    ReportedSurface bad = good;
    change(bad);
    return b.report(contact(bad)) == ContactChange::kRejected && !b.felt.known();
  };
  const double nan = std::nan("");
  EXPECT_TRUE(rejected([&](ReportedSurface& s) { s.normal.y() = nan; }));
  EXPECT_TRUE(rejected([](ReportedSurface& s) { s.normal *= 1.01; }));
  EXPECT_TRUE(rejected([](ReportedSurface& s) { s.normal.setZero(); }));
  EXPECT_TRUE(rejected([&](ReportedSurface& s) { s.stiffness = nan; }));
  EXPECT_TRUE(rejected([](ReportedSurface& s) { s.stiffness = -100.0; }));
  EXPECT_TRUE(rejected([&](ReportedSurface& s) { s.foot = nan; }));
  EXPECT_TRUE(rejected([](ReportedSurface& s) { s.foot = -1e-3; }));
  EXPECT_TRUE(rejected([&](ReportedSurface& s) { s.offset = nan; }));
  EXPECT_TRUE(rejected([&](ReportedSurface& s) { s.touch_sequence = nan; }));
  EXPECT_TRUE(rejected([](ReportedSurface& s) { s.touch_sequence = 5000.0; }));
  ReportedSurface twice = good;
  twice.touch = 2;
  EXPECT_EQ(b.report(contact(good, twice)), ContactChange::kRejected) << "one surface, two springs";
  EXPECT_FALSE(b.felt.known());
}

TEST(Contact, TakesNothingFromAContactThatIsNotIdentifiedYet) {
  Bench b(Vector3::UnitX(), 100);
  EXPECT_EQ(b.report(contact(pressed(Vector3::UnitX(), 0.0, 50.0))), ContactChange::kNone);
  EXPECT_FALSE(b.felt.known());
}

TEST(Contact, InRotationPushesAgainstTheRotationVector) {
  const Vector3 axis = Vector3(0.0, 1.0, 1.0).normalized();
  Bench b(100.0 * axis);  // 0.01 rad a command
  Contact turn(ContactMotion::kRotation, {.damping = 0.0});
  turn.on_report(contact(pressed(axis, 0.2, 21.0)), b.history, b.at, b.mapping);
  ContactHandle at;
  turn.step(at, b.mapping, false, b.tank, 1e-3);
  at.x = 0.3 * axis;  // 0.1 rad behind
  const Vector3 moment = turn.step(at, b.mapping, false, b.tank, 1e-3);
  EXPECT_LT((moment + 0.02 * axis).norm(), 1e-6);
}

}  // namespace
}  // namespace longreach::contact_test
