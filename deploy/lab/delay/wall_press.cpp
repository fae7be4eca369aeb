#include "deploy/lab/delay/wall_press.hpp"

#include <algorithm>
#include <limits>

namespace longreach {
namespace {

constexpr double kHardlyNoticed_m = 1e-4;  // motion that a hand hardly notices
constexpr double kDraw_s = 0.1;            // time constant of the hand's target
constexpr double kBackOff_m = 0.02;        // distance before the approach
constexpr double kHandPress_n = 3.0;       // same as the simulated operator of the laboratory
constexpr double kReleasedPress_n = 0.1;   // a free handle has no spring to push against

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  [[nodiscard]] double width() const { return high - low; }
};

/// What the hand does: the target of its spring, and an additional force.
struct Pressing {
  double hand_m = 0.0;
  double push_n = 0.0;
};

/// What was measured while the hand held one target.
struct Held {
  Span middle{}, late{};  // depth in the second and the last quarter
  double depth_m = 0.0;   // means over the last part
  double force_n = 0.0;
  bool bounced = false;
};

class WallPress {
 public:
  WallPress(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch)
      : case_(c),
        watch_(watch),
        hand_n_per_m_(hand_model(c.grip).stiffness_n_per_m),
        bench_(c),
        // Whole periods of the resonance of a line that is closed at both ends.
        tail_(bench_samples(c.rtt_s > 0.0 ? c.rtt_s * std::ceil(1.0 / c.rtt_s) : 1.0)) {}

  Pressed run() {
    hold(away(), bench_samples(2.0));
    const int ticks = bench_samples(6.0 + 10.0 * case_.rtt_s);
    const Held half = hold(pressing(0.5), ticks);
    const Held whole = hold(pressing(1.0), ticks);
    hold(away(), ticks / 2);
    const double moved_m = whole.depth_m - half.depth_m;
    if (std::abs(moved_m) > 1e-9) out_.displayed_n_per_m = (whole.force_n - half.force_n) / moved_m;
    out_.motion_m = whole.late.width();
    out_.limit_cycle =
        out_.motion_m > kHardlyNoticed_m && (whole.bounced || out_.motion_m > 0.99 * whole.middle.width());
    return out_;
  }

 private:
  [[nodiscard]] bool released() const { return hand_n_per_m_ <= 0.0; }
  [[nodiscard]] Pressing away() const {
    return released() ? Pressing{0.0, -0.5 * kReleasedPress_n} : Pressing{-kBackOff_m, 0.0};
  }
  [[nodiscard]] Pressing pressing(double share) const {
    if (released()) return {0.0, share * kReleasedPress_n};
    return {share * kHandPress_n * (1.0 / hand_n_per_m_ + 1.0 / case_.wall_n_per_m), 0.0};
  }

  Held hold(const Pressing& goal, int ticks) {
    Held held;
    for (int i = 0; i < ticks; ++i) {
      page_command_.hand_m += (goal.hand_m - page_command_.hand_m) * kBenchPeriod_s / kDraw_s;
      page_command_.push_n += (goal.push_n - page_command_.push_n) * kBenchPeriod_s / kDraw_s;
      bench_.step(page_command_.hand_m, page_command_.push_n);
      account();
      if (watch_) watch_(bench_);
      const double depth_m = bench_.depth_m();
      if (4 * i >= ticks && 2 * i < ticks) held.middle.add(depth_m);
      if (4 * i >= 3 * ticks) {
        held.late.add(depth_m);
        held.bounced = held.bounced || bench_.tool_depth_m() <= 0.0;
      }
      if (i < ticks - tail_) continue;
      held.depth_m += depth_m / tail_;
      held.force_n += bench_.force_n() / tail_;
    }
    return held;
  }

  void account() {
    const double surplus_j = bench_.port_energy_j() - bench_.wall_energy_j();
    most_j_ = std::max(most_j_, surplus_j);
    out_.drawdown_j = std::max(out_.drawdown_j, most_j_ - surplus_j);
    out_.port_energy_min_j = std::min(out_.port_energy_min_j, bench_.port_energy_j());
    out_.force_peak_n = std::max(out_.force_peak_n, std::abs(bench_.force_n()));
  }

  BilateralCase case_;
  const std::function<void(const BilateralBench&)>& watch_;
  double hand_n_per_m_;
  BilateralBench bench_;
  int tail_;
  Pressing page_command_{};
  Pressed out_{};
  double most_j_ = 0.0;
};

}  // namespace

Pressed press_wall(const BilateralCase& c, const std::function<void(const BilateralBench&)>& watch) {
  return WallPress(c, watch).run();
}

}  // namespace longreach
