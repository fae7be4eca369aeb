#include "tests/faults/trial.hpp"

#include <cstring>

#include "tests/faults/guard_watch.hpp"
#include "tests/faults/world.hpp"

namespace longreach {
namespace {

/// FNV-1a, by eight bytes at a time.
class Hash {
 public:
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, values + i, sizeof bits);
      hash_ = (hash_ ^ bits) * 0x100000001b3ULL;
      hash_ ^= hash_ >> 32;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

Schedule schedule_of(std::uint64_t seed) { return draw_schedule(seed, draw_scenario(seed).round_trip_s); }

namespace {

Trial run(const Scenario& scenario, const Schedule& schedule, World& world) {
  const Invariants invariants = all_invariants(scenario);
  GuardWatch guards;
  Hash hash;
  Trial trial;
  while (trial.virtual_s < schedule.end_s) {
    const Moment& moment = world.step();
    trial.virtual_s = moment.t_s;
    if (moment.claimed == SafetyState::kEngaged) trial.engaged_s += moment.period_s;
    for (const auto& invariant : invariants) invariant->see(moment);
    guards.see(world, moment);
    hash.add(moment.setpoint_rad.data(), kMaxJoints);
    hash.add(moment.F_H_M.force.data(), 3);
    hash.add(moment.F_H_M.moment.data(), 3);
  }
  guards.end(world);
  trial.injected = world.injected();
  trial.guards = guards.acted();
  trial.trajectory = hash.value();
  for (const auto& i : invariants) {
    trial.judged.push_back({i->name(), i->says(), i->judged(), i->violated()});
    if (i->violated() > 0) trial.violations.push_back(i->first());
  }
  return trial;
}

}  // namespace

Trial run_trial(const Schedule& schedule, InjectedDefect injected_defect) {
  const Scenario scenario = draw_scenario(schedule.seed);
  World world(scenario, schedule, injected_defect);
  return run(scenario, schedule, world);
}

Trial run_trial(const Scenario& scenario, const Schedule& schedule, const Clocks& clocks) {
  World world(scenario, schedule, InjectedDefect::kNone, clocks);
  return run(scenario, schedule, world);
}

}  // namespace longreach
