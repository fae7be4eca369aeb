// Is the handle quiet while it is not moved? Many random draws of device, pose, grip, mode, delay and wall,
// with a hand at rest or a released handle. Measures the energy returned to the operator (from the true
// motion), the ripple of the force, and limit cycles. Control: the same with damping on the encoder velocity.

#include <algorithm>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/rendering/idle_draws.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kEnergy_j = 1e-4;
constexpr double kRipple_n = 0.02;     // permitted ripple in addition to one count times the stiffness
constexpr double kRipple_nm = 4e-4;    // the same at a fingertip 20 mm from the centre
constexpr double kQuietLeast_s = 9.0;  // minimum time of a draw that is evaluated for ripple
// Control: the damping of 0.4 m/T that a guard may inject, for one count per sample, of which the filter
// passes a third.
constexpr double kRawDamping = 3.0 * 0.4;
constexpr std::size_t kControlEvery = 4;

struct Judged {
  IdleDraw draw;
  IdleResult result;
};

/// Energy returned to the operator beyond the store, which may load the spring of a wall that is reported
/// late.
double beyond_store_j(const IdleDraw& draw, const IdlePort& p) {
  return std::max(0.0, p.out_j - draw.master.rendering.store_j);
}
bool cycles(const IdlePort& p) { return p.motion > p.count; }
double beyond(const IdlePort& p) { return p.ripple - p.allowed; }

bool bad(const Judged& j) {
  const IdleResult& r = j.result;
  return beyond_store_j(j.draw, r.translation) > kEnergy_j ||
         beyond_store_j(j.draw, r.rotation) > kEnergy_j || cycles(r.translation) || cycles(r.rotation) ||
         beyond(r.translation) > kRipple_n || beyond(r.rotation) > kRipple_nm;
}

/// The hand should have pressed but did not.
bool missed(const Judged& j) {
  return (j.draw.wall_n_per_m > 0.0 || j.draw.wall_nm_per_rad > 0.0) && !j.result.touched;
}

std::vector<Judged> run_all(const ExperimentRun& run, std::size_t count, std::size_t every,
                            double raw_damping) {
  const std::vector<MasterConfig> masters = idle_masters(run.config);
  std::vector<Judged> all(count);
  on_all_cores(
      count,
      [&](std::size_t i) {
        all[i].draw = draw_idle(masters, run.seed, i * every);
        all[i].draw.raw_damping = raw_damping;
        if (raw_damping > 0.0) all[i].draw.master.rendering.store_j = 0.0;
        all[i].result = run_idle_draw(all[i].draw);
      },
      run.progress);
  return all;
}

template <class Of>
double greatest(const std::vector<Judged>& all, Of of) {
  double most = of(all.front());
  for (const Judged& j : all) most = std::max(most, of(j));
  return most;
}

template <class Of>
double number_of(const std::vector<Judged>& all, Of of) {
  return static_cast<double>(std::ranges::count_if(all, of));
}

template <class Of>
double mean_of(const std::vector<Judged>& all, Of of) {
  double sum = 0.0;
  for (const Judged& j : all) sum += of(j);
  return sum / static_cast<double>(all.size());
}

void write_draws(const ExperimentRun& run, const std::vector<Judged>& all) {
  Trace trace(
      run.out, "draws",
      {"number", "device", "wall_n_per_m", "press_n", "force_n", "energy_out_j", "ripple_n", "allowed_n",
       "motion_m", "count_m", "rotation_energy_out_j", "ripple_nm", "allowed_nm", "motion_rad", "count_rad"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const IdlePort &x = all[i].result.translation, &r = all[i].result.rotation;
    trace.row({static_cast<double>(i), static_cast<double>(i % 3), all[i].draw.wall_n_per_m,
               all[i].draw.press_n, x.force, x.out_j, x.ripple, x.allowed, x.motion, x.count, r.out_j,
               r.ripple, r.allowed, r.motion, r.count});
  }
  trace.close();
}

}  // namespace

std::vector<Plot> idle_plots() {
  return {
      {.name = "draws",
       .csv = "draws",
       .title = "A hand at rest: energy, ripple and motion of each random draw",
       .x_column = "number",
       .x_label = "draw",
       .panels = {{"energy returned (mJ)",
                   {{"energy_out_j", "translation", 1e3}, {"rotation_energy_out_j", "rotation", 1e3}},
                   ""},
                  {"force ripple (mN)", {{"ripple_n", "ripple", 1e3}, {"allowed_n", "one count", 1e3}}, ""},
                  {"true motion (µm)", {{"motion_m", "", 1e6}, {"count_m", "one count", 1e6}}, ""}}}};
}

std::vector<Metric> run_idle(const ExperimentRun& run) {
  const auto draws = static_cast<std::size_t>(campaign(10000, 200));
  const std::vector<Judged> all = run_all(run, draws, 1, 0.0);
  write_draws(run, all);
  ExperimentRun quiet = run;
  quiet.progress = {};
  const std::vector<Judged> control =
      run_all(quiet, std::min<std::size_t>(draws, 400) / kControlEvery, kControlEvery, kRawDamping);
  const auto pressed = [](const Judged& j) { return j.result.touched && !j.draw.lets_go; };
  return {
      {"draws", static_cast<double>(draws), ""},
      {"virtual_h", static_cast<double>(draws) * IdleDraw{}.duration_s / 3600.0, "h"},
      {"not_engaged", number_of(all, [](const Judged& j) { return !j.result.engaged; }), ""},
      {"not_touched", number_of(all, [](const Judged& j) { return missed(j); }), ""},
      {"pressed", number_of(all, pressed), ""},
      {"pressed_at_cap", number_of(all, [&](const Judged& j) { return pressed(j) && j.result.at_cap; }), ""},
      {"let_go", number_of(all, [](const Judged& j) { return j.draw.lets_go; }), ""},
      {"energy_out_max_j",
       greatest(all, [](const Judged& j) { return beyond_store_j(j.draw, j.result.translation); }), "J"},
      {"rotation_energy_out_max_j",
       greatest(all, [](const Judged& j) { return beyond_store_j(j.draw, j.result.rotation); }), "J"},
      {"ripple_beyond_a_count_max_n",
       greatest(all, [](const Judged& j) { return beyond(j.result.translation); }), "N"},
      {"ripple_beyond_a_count_max_nm",
       greatest(all, [](const Judged& j) { return beyond(j.result.rotation); }), "N m"},
      {"quiet_share",
       mean_of(all, [](const Judged& j) { return j.result.translation.quiet_s / kQuietLeast_s; }), ""},
      {"limit_cycles",
       number_of(all,
                 [](const Judged& j) { return cycles(j.result.translation) || cycles(j.result.rotation); }),
       ""},
      {"bad", number_of(all, [](const Judged& j) { return bad(j); }), ""},
      {"control_draws", static_cast<double>(control.size()), ""},
      {"control_bad", number_of(control, [](const Judged& j) { return bad(j); }), ""},
      {"control_energy_out_max_j",
       greatest(control, [](const Judged& j) { return j.result.translation.out_j; }), "J"},
      {"control_ripple_beyond_a_count_max_n",
       greatest(control, [](const Judged& j) { return beyond(j.result.translation); }), "N"}};
}

}  // namespace longreach
