#include "deploy/library/include/longreach/passive_spring.hpp"

#include <cmath>

#include "deploy/library/files.hpp"
#include "master/rendering/contact_spring.hpp"
#include "master/rendering/renderer.hpp"

namespace longreach {
namespace {

constexpr double kLeast = 1e-6, kMost = 1e6;

const PassiveSpringConfig& checked(const PassiveSpringConfig& c) {
  require_range("stiffness_max_n_per_m", c.stiffness_max_n_per_m, kLeast, kMost);
  require_range("force_max_n", c.force_max_n, kLeast, kMost);
  require_range("slew_max_n_per_s", c.slew_max_n_per_s, kLeast, 1e9);
  require_range("fade_s", c.fade_s, kLeast, kMost);
  require_range("store_j", c.store_j, 0.0, 1.0);
  require_range("tank_max_j", c.tank_max_j, 0.0, 1.0);
  require_range("handle_mass_kg", c.handle_mass_kg, kLeast, kMost);
  require_range("count_m", c.count_m, 0.0, 1.0);
  require_range("period_s", c.period_s, kLeast, 1.0);
  return c;
}

}  // namespace

// The port of a hand with one spring of its own: the accounting of the renderer, along x.
struct PassiveSpring::State {
  explicit State(const PassiveSpringConfig& c)
      : config(checked(c)),
        spring({.fade_s = c.fade_s,
                .stiffness_max_n_per_m = c.stiffness_max_n_per_m,
                .force_max_n = c.force_max_n,
                .count_m = c.count_m}),
        port(ContactMotion::kTranslation, {},
             {.handle_mass = c.handle_mass_kg, .force_max = c.force_max_n, .slew_per_s = c.slew_max_n_per_s},
             c.tank_max_j, 0.5 * c.count_m),
        store(c.store_j) {
    port.guard.open();
  }

  PassiveSpringConfig config;
  ContactSpring spring;
  HandPort port;
  EnergyTank store;
  double position_m = 0.0;
};

PassiveSpring::PassiveSpring(const PassiveSpringConfig& config) : state_(std::make_unique<State>(config)) {}
PassiveSpring::~PassiveSpring() = default;
PassiveSpring::PassiveSpring(PassiveSpring&&) noexcept = default;
PassiveSpring& PassiveSpring::operator=(PassiveSpring&&) noexcept = default;

void PassiveSpring::engage(double position_m, double surface_m) {
  const PassiveSpringConfig config = state_->config;
  if (!std::isfinite(position_m) || !std::isfinite(surface_m))
    throw InputError("the positions of the handle and the surface must be finite");
  *state_ = State(config);
  state_->position_m = position_m;
  state_->spring.begin(position_m, surface_m);
}

bool PassiveSpring::update(double surface_m, double stiffness_n_per_m) {
  if (!std::isfinite(surface_m) || !std::isfinite(stiffness_n_per_m)) return false;
  return state_->spring.set_surface(surface_m) &&
         state_->spring.set_stiffness(state_->position_m, stiffness_n_per_m);
}

SpringForce PassiveSpring::step(double position_m, double velocity_m_per_s) {
  State& s = *state_;
  const double now_m = std::isfinite(position_m) ? position_m : s.position_m;
  const double rate = std::isfinite(velocity_m_per_s) ? velocity_m_per_s : 0.0;
  const double entered_j = s.port.guard.observe({now_m - s.position_m, 0.0, 0.0});
  s.position_m = now_m;
  const Vector3 force(-s.spring.step(now_m, s.config.period_s, EnergySource(s.port.tank, &s.store)), 0.0,
                      0.0);
  const double stored_j = s.spring.energy_j(now_m);
  s.store.fill(s.port.account(entered_j, stored_j, s.spring.paid_j(), force));
  const Vector3 given = s.port.guard.apply({.rendered = force, .rate = Vector3(rate, 0.0, 0.0), .live = true},
                                           s.config.period_s);
  return {.force_n = -given.x(),
          .stored_j = stored_j,
          .port_energy_j = s.port.guard.port_energy_j(),
          .store_j = s.store.level_j(),
          .limited = s.spring.yielding() || s.port.guard.clamped()};
}

double PassiveSpring::stiffness_n_per_m() const { return state_->spring.stiffness_n_per_m(); }
double PassiveSpring::anchor_m() const { return state_->spring.anchor_m(); }

}  // namespace longreach
