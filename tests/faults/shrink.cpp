// From a schedule that fails to the few faults that matter: halves are taken out, then single ones (delta
// debugging, Zeller and Hildebrandt 2002), then what is left is made shorter.

#include <algorithm>

#include "tests/faults/trial.hpp"

namespace longreach {
namespace {

constexpr double kMargin_s = 0.5;
constexpr int kHalvings = 6;

class Shrinker {
 public:
  Shrinker(Schedule schedule, const Fails& fails) : best_(std::move(schedule)), fails_(fails) {}

  Schedule run() {
    for (std::size_t part = std::max<std::size_t>(1, best_.faults.size() / 2); part > 0; part /= 2)
      remove(part);
    remove(1);
    for (std::size_t i = 0; i < best_.faults.size(); ++i) shorten(i);
    return best_;
  }

 private:
  /// Takes `candidate` if it still fails, up to where it does.
  bool take(Schedule candidate) {
    const std::optional<double> at_s = fails_(candidate);
    if (!at_s) return false;
    best_ = std::move(candidate);
    best_.end_s = std::min(best_.end_s, *at_s + kMargin_s);
    return true;
  }
  void remove(std::size_t part) {
    for (std::size_t at = 0; at < best_.faults.size();) {
      Schedule candidate = best_;
      const auto first = candidate.faults.begin() + static_cast<std::ptrdiff_t>(at);
      candidate.faults.erase(
          first, first + static_cast<std::ptrdiff_t>(std::min(part, candidate.faults.size() - at)));
      if (!take(std::move(candidate))) at += part;
    }
  }
  void shorten(std::size_t i) {
    for (int halving = 0; halving < kHalvings; ++halving) {
      Schedule candidate = best_;
      candidate.faults[i].duration_s *= 0.5;
      if (!take(std::move(candidate))) return;
    }
  }

  Schedule best_;
  const Fails& fails_;
};

}  // namespace

Schedule shrink(const Schedule& schedule, const Fails& fails) { return Shrinker(schedule, fails).run(); }

Schedule shrink(const Schedule& schedule, std::string_view invariant) {
  return shrink(schedule, [invariant](const Schedule& candidate) -> std::optional<double> {
    const Trial trial = run_trial(candidate);
    const auto at = std::ranges::find(trial.violations, invariant, &Breach::invariant);
    return at == trial.violations.end() ? std::nullopt : std::optional(at->t_s);
  });
}

}  // namespace longreach
