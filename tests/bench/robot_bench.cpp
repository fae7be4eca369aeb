// Cost of the robot's kinematics, with KDL beside. Nanoseconds are a reading; the measure is the count of
// instructions:
//   valgrind --tool=callgrind --toggle-collect='longreach::ClosedInverse::solve(*' bench_robot
//     --benchmark_filter=AllBranches/puma560 --benchmark_min_time=0.01

#include <benchmark/benchmark.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "deploy/lab/robot/random_arm.hpp"
#include "slave/kinematics/inverse.hpp"
#include "tests/oracle/kdl_chain.hpp"

namespace longreach {
namespace {

constexpr std::size_t kPoses = 256;

struct Motion {
  explicit Motion(const RobotConfig& robot) : inverse(robot) {
    Random random(1);
    for (std::size_t n = 0; n < kPoses; ++n) {
      q[n] = test::random_joints(random);
      before[n] = q[n] + test::random_joints(random, 1e-3);
      goal[n] = inverse.kinematics().forward(q[n]);
      rigid[n] = to_rigid(goal[n]);
      known[n] = inverse.closed().known(before[n]);
    }
  }
  Inverse inverse;
  std::array<JointVector, kPoses> q, before;
  std::array<Pose, kPoses> goal;
  std::array<Rigid, kPoses> rigid;
  std::array<KnownJoints, kPoses> known;
};

RobotConfig arm(benchmark::State& state) {
  const auto ready = test::ready_arms();
  const auto n = static_cast<std::size_t>(state.range(0));
  if (n < ready.size()) {
    state.SetLabel(ready[n].name);
    return ready[n].robot;
  }
  Random random(2);
  state.SetLabel("fourth degree");
  return test::random_arm(random, ArmFamily::kSpherical, 3);
}

void ForwardAndJacobian(benchmark::State& state) {
  const Motion m(arm(state));
  std::size_t n = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(m.inverse.kinematics().forward_with_jacobian(m.q[n++ % kPoses]));
}
BENCHMARK(ForwardAndJacobian)->DenseRange(0, 3);

void AllBranches(benchmark::State& state) {
  const Motion m(arm(state));
  Branches branches;
  std::size_t n = 0;
  for (auto _ : state) {
    m.inverse.closed().solve(m.rigid[n % kPoses], m.known[n % kPoses], branches);
    benchmark::DoNotOptimize(branches);
    ++n;
  }
}
BENCHMARK(AllBranches)->DenseRange(0, 3);

/// That of the known joints, which is proven to be the nearest.
void OneBranch(benchmark::State& state) {
  const Motion m(arm(state));
  Branches branches;
  std::size_t n = 0;
  for (auto _ : state) {
    m.inverse.closed().solve(m.rigid[n % kPoses], m.known[n % kPoses], branches, true);
    benchmark::DoNotOptimize(branches);
    ++n;
  }
}
BENCHMARK(OneBranch)->DenseRange(0, 3);

/// Once for all poses next to some joints.
void KnowBranch(benchmark::State& state) {
  const Motion m(arm(state));
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(m.inverse.closed().known(m.before[n++ % kPoses]));
}
BENCHMARK(KnowBranch)->DenseRange(0, 3);

/// The whole: nearest of all branches, checked and reported.
void NearestBranch(benchmark::State& state) {
  const Motion m(arm(state));
  std::size_t n = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(m.inverse.solve(m.goal[n % kPoses], m.before[n % kPoses], {}));
    ++n;
  }
}
BENCHMARK(NearestBranch)->DenseRange(0, 3);

void NumericAnyArm(benchmark::State& state) {
  Random random(3);
  const Motion m(test::random_arm(random));
  std::size_t n = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(m.inverse.solve(m.goal[n % kPoses], m.q[(n + 1) % kPoses], {1e-10, 30, 200}));
    ++n;
  }
}
BENCHMARK(NumericAnyArm);

void KdlForwardAndJacobian(benchmark::State& state) {
  const Motion m(arm(state));
  const KDL::Chain chain = oracle::kdl_chain(arm(state));
  KDL::ChainFkSolverPos_recursive position(chain);
  KDL::ChainJntToJacSolver velocity(chain);
  std::vector<KDL::JntArray> q;
  for (const JointVector& joints : m.q) q.push_back(oracle::kdl_joints(joints));
  KDL::Frame frame;
  KDL::Jacobian J(kMaxJoints);
  std::size_t n = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(position.JntToCart(q[n % kPoses], frame));
    benchmark::DoNotOptimize(velocity.JntToJac(q[n % kPoses], J));
    ++n;
  }
}
BENCHMARK(KdlForwardAndJacobian)->DenseRange(0, 2);

void KdlInverse(benchmark::State& state) {
  const Motion m(arm(state));
  const KDL::Chain chain = oracle::kdl_chain(arm(state));
  KDL::ChainFkSolverPos_recursive position(chain);
  KDL::ChainIkSolverPos_LMA solver(chain, 1e-10);
  std::vector<KDL::JntArray> before;
  std::vector<KDL::Frame> goal(kPoses);
  for (std::size_t n = 0; n < kPoses; ++n) {
    before.push_back(oracle::kdl_joints(m.before[n]));
    position.JntToCart(oracle::kdl_joints(m.q[n]), goal[n]);
  }
  KDL::JntArray q(kMaxJoints);
  std::size_t n = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver.CartToJnt(before[n % kPoses], goal[n % kPoses], q));
    ++n;
  }
}
BENCHMARK(KdlInverse)->DenseRange(0, 2);

}  // namespace
}  // namespace longreach
