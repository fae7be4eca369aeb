#include "tests/faults/twin.hpp"

#include <algorithm>
#include <array>

#include "tests/faults/kind.hpp"
#include "tests/faults/scenario.hpp"

namespace longreach {
namespace {

constexpr std::string_view kForgeries = "datagrams";
constexpr double kTwin_s = 20.0, kLoss = 0.01;

bool harmless(const FaultKind& kind) {
  return kind.group == kForgeries && kind.affects == 0 && kind.name != "swapped";
}
/// What is added takes up room on such a link, or the numbers of its chance, or overtakes there.
bool on_the_link(const FaultKind& kind) { return (kind.affects & only(AffectedSignal::kLink)) != 0; }

}  // namespace

std::optional<bool> refused_changes_nothing(std::uint64_t seed) {
  if (!draw_scenario(seed).metamorphic) return std::nullopt;
  Schedule plain = schedule_of(seed);
  std::erase_if(plain.faults, [](const Fault& fault) {
    const FaultKind& kind = fault_kinds()[fault_kind(fault.kind)];
    return on_the_link(kind) || harmless(kind);
  });
  plain.end_s = std::min(plain.end_s, kTwin_s);
  Schedule attacked = plain;
  Random random = Random(seed).child("forgeries");
  for (const FaultKind& kind : fault_kinds()) {
    if (harmless(kind))
      attacked.faults.push_back(
          {std::string(kind.name), random.uniform(0.0, 10.0), 5.0, random.uniform(), random.next()});
  }
  std::ranges::stable_sort(attacked.faults, {}, &Fault::start_s);
  return run_trial(plain).trajectory == run_trial(attacked).trajectory;
}

bool clocks_change_nothing(std::uint64_t seed) {
  const Scenario scenario = draw_scenario(seed);
  Schedule schedule = schedule_of(seed);
  schedule.end_s = std::min(schedule.end_s, kTwin_s);
  const Clocks shifted{std::chrono::hours(31) + std::chrono::nanoseconds(12345), std::chrono::hours(7)};
  return run_trial(scenario, schedule, {}).trajectory == run_trial(scenario, schedule, shifted).trajectory;
}

Trial run_fault_free(std::uint64_t seed, double seconds) {
  Scenario scenario = draw_scenario(seed);
  for (ImpairmentConfig* direction : {&scenario.master.link.impairment, &scenario.slave.link.impairment}) {
    direction->loss = kLoss;
    direction->loss_burst = 1.0;
  }
  Schedule schedule;
  schedule.seed = seed;
  schedule.faults_end_s = schedule.end_s = seconds;
  return run_trial(scenario, schedule, {});
}

std::uint64_t false_alarms(const Trial& stable) {
  std::uint64_t all = 0;
  for (const auto& [name, times] : stable.guards)
    if (name.starts_with("slave: ") || name.starts_with("master: ")) all += times;
  return all;
}

}  // namespace longreach
