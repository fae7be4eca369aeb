#include "tests/experiments/faults/twin.hpp"

#include <algorithm>
#include <array>

#include "tests/experiments/faults/kind.hpp"
#include "tests/experiments/faults/scenario.hpp"
#include "tests/experiments/faults/trial.hpp"

namespace longreach {
namespace {

constexpr std::string_view kForgeries = "datagrams";

bool harmless(const FaultKind& kind) {
  return kind.group == kForgeries && kind.spoils == 0 && kind.name != "swapped";
}
bool by_chance(std::string_view kind) {
  constexpr std::array kChance = {"loss", "loss-bursts", "jitter", "reordering", "duplication", "corruption"};
  return std::ranges::find(kChance, kind) != kChance.end();
}

}  // namespace

std::optional<bool> refused_changes_nothing(std::uint64_t seed) {
  if (!draw_scenario(seed).metamorphic) return std::nullopt;
  Schedule plain = schedule_of(seed);
  std::erase_if(plain.faults, [](const Fault& fault) {
    return by_chance(fault.kind) || harmless(fault_kinds()[fault_kind(fault.kind)]);
  });
  plain.end_s = std::min(plain.end_s, 20.0);
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

}  // namespace longreach
