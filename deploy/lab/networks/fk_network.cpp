// Forward kinematics of the 3-RRR device: error against cost of all methods. The device moves through the
// trained workspace at 1 kHz for 20 virtual seconds, with tilts of up to 30 degrees in all directions,
// rotations of up to 30 degrees, and up to 2 rad/s. The motor angles are computed by inverse kinematics from
// known orientations, which serve as the truth, so that no solver is compared with another one. Times are
// measured on this processor in this run, as the minimum of many passes, and the ratios are computed from
// them.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/networks/spherical_network.hpp"
#include "deploy/lab/networks/spherical_network_file.hpp"
#include "deploy/lab/trace.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {
namespace {

constexpr std::size_t kTicks = 20000;
constexpr double kTick_s = 1e-3;
constexpr double kReach_rad = std::numbers::pi / 6.0;
constexpr int kRounds = 60;

struct Motion {
  std::vector<Quaternion> q;
  std::vector<Vector3> theta_rad;
};

Motion motion(const SphericalKinematics& k, std::uint64_t seed) {
  Random random = Random(seed).child("fk-network");
  const double phase[3] = {random.uniform(0.0, 6.28), random.uniform(0.0, 6.28), random.uniform(0.0, 6.28)};
  Motion m;
  for (std::size_t n = 0; n < kTicks; ++n) {
    const double t = 2.0 * std::numbers::pi * kTick_s * static_cast<double>(n);
    const double tilt = kReach_rad * std::sin(0.31 * t + phase[0]), azimuth = 0.17 * t + phase[1];
    const Vector3 tilted(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.0);
    const Vector3 turned(0.0, 0.0, kReach_rad * std::sin(0.23 * t + phase[2]));
    m.q.push_back(exp_rotation(tilted) * exp_rotation(turned));
    m.theta_rad.push_back(k.inverse(m.q.back()).theta_rad);
  }
  return m;
}

struct Cost {
  double error_max_rad = 0.0, error_rms_rad = 0.0;
  double iterations = 0.0;  // mean number per call, for iterative methods
  double failed = 0.0;      // ticks without an orientation
  double ns = INFINITY;
};

double angle(const Quaternion& a, const Quaternion& b) { return 2.0 * (a.conjugate() * b).vec().norm(); }

struct Variant {
  std::string name;
  Cost cost;
  std::function<double()> pass;  // runs one more pass over the motion; returns the time per call, ns
};

/// `solver.start(q)` before a pass; `solver.step(theta, truth)` a tick, which says the orientation and how it
/// went. A pass takes every `stride`th tick.
template <class Solver>
Variant variant(const std::string& name, const Motion& m, Solver solver, std::size_t stride = 1) {
  Cost cost;
  double sum = 0.0;
  solver.start(m.q.front());
  for (std::size_t n = 0; n < kTicks; ++n) {
    const auto pose = solver.step(m.theta_rad[n], m.q[n]);
    cost.failed += pose.status == SolutionStatus::kFound ? 0.0 : 1.0;
    const double error = angle(m.q[n], pose.q);
    cost.error_max_rad = std::max(cost.error_max_rad, error);
    sum += error * error;
    if constexpr (requires { pose.iterations; }) cost.iterations += pose.iterations;
  }
  cost.error_rms_rad = std::sqrt(sum / kTicks);
  cost.iterations /= kTicks;
  const auto pass = [&m, solver, stride]() mutable {
    using Clock = std::chrono::steady_clock;
    double checksum = 0.0;  // prevents the compiler from removing the computation
    solver.start(m.q.front());
    const auto began = Clock::now();
    for (std::size_t n = 0; n < kTicks; n += stride) checksum += solver.step(m.theta_rad[n], m.q[n]).q.x();
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - began).count();
    return std::isfinite(checksum) ? ns * static_cast<double>(stride) / kTicks : INFINITY;
  };
  return {name, cost, pass};
}

struct Tracking {
  const SphericalKinematics& k;
  SphericalPose pose{};
  void start(const Quaternion& q) { pose = {SolutionStatus::kFound, q}; }
  SphericalPose step(const Vector3& theta, const Quaternion&) { return pose = k.forward(theta, pose); }
};

/// One Newton step from the orientation of the previous tick: the method without the network.
struct NewtonStep {
  const SphericalNetwork& net;
  SphericalEstimate estimate{};
  void start(const Quaternion& q) { estimate = {SolutionStatus::kFound, q}; }
  SphericalEstimate step(const Vector3& theta, const Quaternion&) {
    return estimate = net.refined(theta, estimate);
  }
};

struct NewtonTwoSteps {
  const SphericalNetwork& net;
  SphericalEstimate estimate{};
  void start(const Quaternion& q) { estimate = {SolutionStatus::kFound, q}; }
  SphericalEstimate step(const Vector3& theta, const Quaternion&) {
    return estimate = net.refined(theta, net.refined(theta, estimate));
  }
};

struct NewtonFromRough {
  const SphericalKinematics& k;
  const SphericalNetwork& net;
  void start(const Quaternion&) {}
  SphericalPose step(const Vector3& theta, const Quaternion&) const {
    return k.forward(theta, {SolutionStatus::kFound, net.rough(theta).q});
  }
};

struct NewtonFromHome {
  const SphericalKinematics& k;
  void start(const Quaternion&) {}
  SphericalPose step(const Vector3& theta, const Quaternion&) const {
    return k.forward(theta, {SolutionStatus::kFound, Quaternion::Identity()});
  }
};

/// kFromNothing: with the coarse network in every tick. kRefined: followed by one Newton step.
template <bool kFromNothing, bool kRefined>
struct Network {
  const SphericalNetwork& net;
  SphericalEstimate estimate{};
  void start(const Quaternion&) { estimate = {}; }
  SphericalEstimate step(const Vector3& theta, const Quaternion&) {
    estimate = kFromNothing ? net.forward(theta) : net.forward(theta, estimate);
    return kRefined ? net.refined(theta, estimate) : estimate;
  }
};

/// Takes the solution nearest to the truth, which is favourable, because this method does not know the
/// assembly mode.
struct AllSolutions {
  const SphericalKinematics& k;
  void start(const Quaternion&) {}
  SphericalEstimate step(const Vector3& theta, const Quaternion& truth) const {
    const SphericalPoses all = k.forward_all(theta);
    SphericalEstimate best{all.status, Quaternion::Identity(), 0};
    double nearest = INFINITY;
    for (int n = 0; n < all.count; ++n) {
      const Quaternion& q = all.q[static_cast<std::size_t>(n)];
      if (const double error = angle(truth, q); error < nearest) nearest = error, best.q = q;
    }
    return best;
  }
};

/// The passes alternate between all variants, so that other load on the machine does not affect only one of
/// them.
std::vector<Variant> measure_all(const Motion& m, const SphericalKinematics& k, const SphericalNetwork& net,
                                 const std::function<void(double)>& progress) {
  std::vector<Variant> variants = {variant("tracking", m, Tracking{k}),
                                   variant("newton_step", m, NewtonStep{net}),
                                   variant("newton_two_steps", m, NewtonTwoSteps{net}),
                                   variant("newton_from_rough", m, NewtonFromRough{k, net}),
                                   variant("newton_from_home", m, NewtonFromHome{k}),
                                   variant("network_with_rough", m, Network<true, false>{net}),
                                   variant("network", m, Network<false, false>{net}),
                                   variant("network_with_rough_newton", m, Network<true, true>{net}),
                                   variant("network_newton", m, Network<false, true>{net}),
                                   variant("all_solutions", m, AllSolutions{k}, 100)};
  for (int round = 0; round < kRounds; ++round) {
    for (Variant& v : variants) v.cost.ns = std::min(v.cost.ns, v.pass());
    if (progress) progress((round + 1.0) / kRounds);
  }
  return variants;
}

/// One row per variant. Each error has a column of its own, so that it is drawn with its own mark.
void write(const ExperimentRun& run, const std::vector<Variant>& variants) {
  Trace trace(
      run.out, "fk-network",
      {"cost_ns", "tracking", "newton_step", "newton_two_steps", "newton_from_rough", "newton_from_home",
       "network_with_rough", "network", "network_with_rough_newton", "network_newton", "all_solutions"});
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const auto error = [&](std::size_t column) { return column == i ? variants[i].cost.error_max_rad : NAN; };
    trace.row({variants[i].cost.ns, error(0), error(1), error(2), error(3), error(4), error(5), error(6),
               error(7), error(8), error(9)});
  }
  trace.close();
}

}  // namespace

std::vector<Plot> fk_network_plots() {
  const auto mark = [](const std::string& column, const std::string& title, int type) {
    return Curve{column, title, 1.0, true, type};
  };
  return {
      {.name = "fk-network",
       .csv = "fk-network",
       .title = "Forward kinematics of the 3-RRR device: error versus cost",
       .x_column = "cost_ns",
       .x_label = "time per call (ns)",
       .panels =
           {{"maximum error (rad)",
             {mark("tracking", "tracking (b)", 7), mark("network", "network", 5),
              mark("newton_step", "one Newton step", 9), mark("newton_two_steps", "two Newton steps", 8),
              mark("network_newton", "network + step", 11), mark("network_with_rough", "coarse + network", 4),
              mark("network_with_rough_newton", "coarse + network + step", 10),
              mark("newton_from_rough", "coarse + Newton", 6),
              mark("newton_from_home", "Newton from home", 12),
              mark("all_solutions", "all solutions (a)", 13)},
             "set logscale xy\nset format y '10^{%L}'\nset yrange [1e-16:1e-2]\nset pointsize 1.6\nset xtics "
             "nomirror\nset mxtics 10\nset ytics 1e2"}},
       .panel_px = 380.0}};
}

std::vector<Metric> run_fk_network(const ExperimentRun& run) {
  const SphericalKinematics k(reconstructed_spherical());
  const auto file = find_deploy_folder() / "devices" / "spherical_network.txtpb";
  const SphericalNetwork net(k.geometry(), load_spherical_network(file).config);
  const Motion path = motion(k, run.seed);
  const std::vector<Variant> variants = measure_all(path, k, net, run.progress);
  write(run, variants);
  std::vector<Metric> metrics;
  for (const auto& [name, cost, pass] : variants) {
    metrics.push_back({name + "_error_max_rad", cost.error_max_rad, "rad"});
    metrics.push_back({name + "_error_rms_rad", cost.error_rms_rad, "rad"});
    metrics.push_back({name + "_failed", cost.failed, ""});
    if (cost.iterations > 0.0) metrics.push_back({name + "_iterations", cost.iterations, ""});
    metrics.push_back({name + "_ns", cost.ns, "ns", true});
  }
  const auto ns = [&](std::string_view name) {
    return std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == name; })
        ->cost.ns;
  };
  metrics.push_back({"tracking_to_network_ratio", ns("tracking") / ns("network"), "", true});
  metrics.push_back({"newton_step_to_network_ratio", ns("newton_step") / ns("network"), "", true});
  metrics.push_back({"tracking_to_network_newton_ratio", ns("tracking") / ns("network_newton"), "", true});
  metrics.push_back({"newton_from_rough_to_network_with_rough_ratio",
                     ns("newton_from_rough") / ns("network_with_rough"), "", true});
  return metrics;
}

}  // namespace longreach
