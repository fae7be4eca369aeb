// The library as other programs see it: through its headers and the shared object alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <longreach/error.hpp>
#include <longreach/identification.hpp>
#include <longreach/link.hpp>
#include <longreach/passive_spring.hpp>
#include <longreach/robot_arm.hpp>
#include <longreach/virtual_loop.hpp>

namespace longreach::library_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The sentence of the InputError that `run` throws; empty: none.
template <class Run>
std::string refusal(const Run& run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Library, IdentifiesALinearWallWithItsUncertainty) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::vector<double> t, x, f;
  for (int i = 0; i < 2000; ++i) {
    t.push_back(1e-3 * i);
    x.push_back(0.004 * (1.0 - std::cos(6.0 * t.back())));
    f.push_back(std::max(0.0, 1500.0 * (x.back() - 0.003)) + noise(random));
  }
  const ContactResult c = identify(t, x, f, {.depth_m = 0.003});
  EXPECT_EQ(c.tangent.verdict, ContactVerdict::kIdentified);
  EXPECT_NEAR(c.tangent.value, 1500.0, 0.02 * 1500.0);
  EXPECT_NEAR(c.surface.value, 0.003, 5e-5);
  EXPECT_GT(c.tangent.sd, 0.0);
  EXPECT_TRUE(c.law_fits);
}

TEST(Library, IdentificationStatesWhatIsWrongWithSamples) {
  const std::vector<double> three{0.0, 1.0, 2.0}, two{0.0, 1.0}, still{0.0, 1.0, 1.0}, bad{0.0, kNan, 1.0};
  EXPECT_NE(refusal([&] { (void)identify(three, two, three); }).find("3, 2 and 3 samples"),
            std::string::npos);
  EXPECT_NE(refusal([&] { (void)identify(still, three, three); }).find("sample 2"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)identify(three, three, bad); }).find("sample 1"), std::string::npos);
  EXPECT_NE(refusal([] { ContactIdentifier identifier({.force_noise_n = -1.0}); }).find("force_noise_n = -1"),
            std::string::npos);
}

/// Energy that the port returned in 20 s of random motion and updates beyond what it received, J.
double returned_j(bool passive) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  PassiveSpring spring({.stiffness_max_n_per_m = 3000.0, .force_max_n = 1000.0, .slew_max_n_per_s = 1e9});
  spring.engage(0.0, 0.0);
  double energy_j = 0.0, lowest_j = 0.0, force_n = 0.0, s_m = 0.0, stiffness = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double phase = 6.0 * 1e-3 * i, before_m = s_m;
    s_m = 0.004 + 0.006 * std::sin(phase);
    energy_j += force_n * (s_m - before_m);
    lowest_j = std::min(lowest_j, energy_j);
    if (i % 40 == 0) {
      stiffness = 3000.0 * any(random);
      spring.update(0.008 * any(random) - 0.004, stiffness);
    }
    const double rendered_n = spring.step(s_m, 0.036 * std::cos(phase)).force_n;
    force_n = passive ? rendered_n : stiffness * std::max(0.0, s_m);
  }
  return -lowest_j;
}

TEST(Library, SpringReturnsNoMoreThanItsStore) {
  EXPECT_LE(returned_j(true), 0.021);
  EXPECT_GT(returned_j(false), 0.1) << "the control: a spring without the rules";
}

TEST(Library, SpringRefusesWhatIsNotFinite) {
  PassiveSpring spring;
  spring.engage(0.0, 0.0);
  EXPECT_FALSE(spring.update(0.0, kNan));
  EXPECT_FALSE(spring.update(kNan, 1.0));
  EXPECT_TRUE(std::isfinite(spring.step(kNan, kNan).force_n));
  EXPECT_NE(refusal([] { PassiveSpring bad({.period_s = 0.0}); }).find("period_s = 0 is outside"),
            std::string::npos);
}

TEST(Library, ArmSolvesItsOwnPosesAndStatesTheErrorOfOthers) {
  const RobotArm arm("ur5e");
  EXPECT_EQ(arm.joints().size(), 6u);
  const Eigen::VectorXd start = arm.start();
  const Eigen::Isometry3d X_WE = arm.forward(start);
  const ArmSolution there = arm.inverse_nearest(X_WE, start);
  EXPECT_EQ(there.status, ArmStatus::kFound);
  EXPECT_LT((there.joints - start).norm(), 1e-9);
  Eigen::Isometry3d far = X_WE;
  far.translation() *= 100.0;
  const ArmSolution nearest = arm.inverse_nearest(far, start);
  EXPECT_EQ(nearest.status, ArmStatus::kNearest);
  EXPECT_GT(nearest.position_error_m, 1.0);
  EXPECT_NE(refusal([] { RobotArm unknown("ur5x"); }).find("ur5e"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)arm.forward(Eigen::VectorXd::Zero(5)); }).find("6 joints"),
            std::string::npos);
}

TEST(Library, LoopIsNamedByItsSeedAndFollowsADrivenHand) {
  std::array<LoopState, 2> same;
  for (LoopState& state : same) {
    VirtualLoop loop({"profile=lab", "scene_file=scenes/free.txtpb"}, 5);
    loop.drive({.position_m = {0.01, 0.0, 0.0}});
    loop.run(5.0);
    state = loop.state();
  }
  EXPECT_EQ(same[0].X_WE.matrix(), same[1].X_WE.matrix());
  EXPECT_TRUE(same[0].engaged);
  EXPECT_NEAR(same[0].time_s, 5.0, 1e-9);
  EXPECT_GT(same[0].goal_m.norm(), 0.002);
  EXPECT_NE(refusal([] { VirtualLoop loop({"mapping.scale=7"}); }).find("0.05 to 1"), std::string::npos);
}

TEST(Library, LinkDelaysAndCounts) {
  SimulatedLink link("moon", 1);
  const std::array<std::byte, 3> datagram{};
  link.send(LinkEnd::kMaster, 0.0, datagram);
  EXPECT_FALSE(link.receive(LinkEnd::kSlave, 1.0));
  EXPECT_FALSE(link.receive(LinkEnd::kMaster, 2.0));
  const auto received = link.receive(LinkEnd::kSlave, 2.0);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->size(), 3u);
  EXPECT_EQ(link.counts(LinkEnd::kSlave).delivered, 1u);
  const std::vector<std::byte> large(601);
  EXPECT_NE(refusal([&] { link.send(LinkEnd::kMaster, 2.0, large); }).find("601 bytes"), std::string::npos);
  EXPECT_NE(refusal([] { SimulatedLink bad({.up = {.loss = 1.5}, .down = {}}, 1); }).find("loss"),
            std::string::npos);
  EXPECT_NE(refusal([] { (void)link_conditions("mars"); }).find("moon"), std::string::npos);
}

}  // namespace
}  // namespace longreach::library_test
