#include "master/rendering/renderer.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

ContactSpringConfig spring_config(const RenderingConfig& c, const RenderedDevice& d) {
  // Sampled spring on a damped device: K < b/(T/2 + t_d) (Colgate and Schenkel 1997, virtual damping left
  // out).
  const double device_limit = d.damping_n_s_per_m / (0.5 * d.period_s + d.delay_s);
  return {.fade_s = c.fade_s,
          .stiffness_max_n_per_m = std::min(c.stiffness_max_n_per_m, device_limit),
          .force_max_n = c.force_max_n,
          .tank_max_j = c.tank_max_j};
}

PortGuardConfig guard_config(const RenderingConfig& c, const RenderedDevice& d) {
  return {.handle_mass_kg = d.handle_mass_kg,
          .force_max_n = c.force_max_n,
          .moment_max_nm = c.moment_max_nm,
          .ramp_s = c.ramp_s};
}

bool finite(const HandleState& h) {
  return h.p_MH.allFinite() && h.velocity_m_per_s.allFinite() && h.q_MH.coeffs().allFinite() &&
         h.angular_rad_per_s.allFinite();
}

}  // namespace

Renderer::Renderer(const RenderingConfig& config, const RenderedDevice& device)
    : config_(config),
      device_(device),
      resistance_(config),
      spring_(spring_config(config, device)),
      guard_(guard_config(config, device)) {}

void Renderer::configure(const RenderingConfig& config) {
  config_ = config;
  resistance_.configure(config);
  spring_.configure(spring_config(config, device_));
  guard_.configure(guard_config(config, device_));
}

void Renderer::reset(const HandleState& handle) {
  resistance_.reset(handle);
  surface_.clear();
  spring_.begin(0.0, 0.0);
  naive_stiffness_ = 0.0;
  guard_.reset(handle.p_MH);
  guard_.open();
  stored_j_ = 0.0;
  spring_force_n_ = 0.0;
}

bool Renderer::on_report(const StiffnessReport& report, const GoalHistory& history,
                         const RendererInput& input, const Mapping& mapping) {
  if (!finite(input.handle)) return true;
  const double before_n = contact_force(input, surface_.inward().dot(input.handle.p_MH));
  const bool at_rest = spring_.energy_j(surface_.inward().dot(input.handle.p_MH)) <= 0.0;
  const SurfaceChange change = surface_.on_report(report.translation, report.reached_sequence, history,
                                                  at_rest, config_.forget_depth_m);
  const double s_m = surface_.inward().dot(input.handle.p_MH);
  switch (change) {
    case SurfaceChange::kRejected:
      return false;
    case SurfaceChange::kNone:
      return true;
    case SurfaceChange::kNew:
      if (at_rest) {
        spring_.begin(s_m, locate_surface(input, mapping, s_m));
        spring_.set_stiffness(s_m, config_.ke * surface_.stiffness_n_per_m());
      } else {
        spring_.set_stiffness(s_m, 0.0);  // fades first; a later report brings the new normal
      }
      break;
    case SurfaceChange::kUpdated:
      spring_.set_stiffness(s_m, config_.ke * surface_.stiffness_n_per_m());
      break;
    case SurfaceChange::kGone:
      spring_.set_stiffness(s_m, 0.0);
      break;
  }
  naive_stiffness_ = surface_.known() ? config_.ke * surface_.stiffness_n_per_m() : 0.0;
  if (surface_.known()) surface_handle_m_ = locate_surface(input, mapping, s_m);
  const double after_n = contact_force(input, s_m);
  force_step_n_ = after_n - before_n;
  return true;
}

double Renderer::locate_surface(const RendererInput& input, const Mapping& mapping, double s_m) const {
  if (input.mode == MotionMode::kPosition)
    return mapping.handle_offset_m(surface_.inward(), surface_.offset_m());
  // Rate mode has no position to press against: the surface lies as deep in the hand as the goal is commanded
  // behind it, up to the force limit.
  const double commanded = surface_.inward().dot(mapping.goal().position_m) - surface_.offset_m();
  const double k = std::max(stiffness_n_per_m(), 1.0);
  return s_m - std::clamp(commanded, 0.0, config_.force_max_n / k);
}

double Renderer::stiffness_n_per_m() const {
  return config_.law == RenderingLaw::kNaive ? naive_stiffness_ : spring_.stiffness_n_per_m();
}

double Renderer::contact_force(const RendererInput& input, double s_m) {
  if (config_.law == RenderingLaw::kNaive) {
    spring_force_n_ = input.stale ? 0.0 : naive_stiffness_ * std::max(0.0, s_m - surface_handle_m_);
  } else {
    spring_force_n_ = spring_.force_n(s_m);
  }
  return spring_force_n_;
}

Wrench Renderer::step(const RendererInput& input, const Mapping& mapping) {
  if (!finite(input.handle))
    return guard_.apply(Wrench{}, Wrench{}, Vector3::Zero(), false, device_.period_s);
  const Vector3& x = input.handle.p_MH;
  const Vector3& n = surface_.inward();
  const double s_m = n.dot(x);
  const double entered_j = guard_.observe(x);

  if (input.stale) {
    surface_.clear();
    spring_.set_stiffness(s_m, 0.0);
  }
  if (surface_.known()) {
    surface_handle_m_ = locate_surface(input, mapping, s_m);
    spring_.set_surface(surface_handle_m_);
  }
  spring_.step(s_m, device_.period_s);
  double contact_n = contact_force(input, s_m);
  if (contact_n > 0.0) {
    contact_n =
        std::max(0.0, contact_n + config_.contact_damping_n_s_per_m * n.dot(input.handle.velocity_m_per_s));
  }
  Wrench F;
  if (input.handle.held) {
    F = resistance_.step({input.handle, input.mode, input.scale, mapping.centre_m()});
  } else {
    resistance_.reset(input.handle);
  }
  if (config_.law == RenderingLaw::kStiffness) account(entered_j, input, s_m);
  F.force -= contact_n * n;
  return guard_.apply(F, input.behaviour, input.handle.velocity_m_per_s, input.live, device_.period_s);
}

void Renderer::account(double entered_j, const RendererInput& input, double s_m) {
  const double stored_j = spring_.energy_j(s_m) + resistance_.energy_j() + input.behaviour_j;
  // What came in and was neither stored nor paid for has been dissipated, or leaked if negative.
  double rest_j = entered_j - (stored_j - stored_j_) + spring_.paid_j() + input.behaviour_supplied_j;
  stored_j_ = stored_j;
  if (rest_j > 0.0) {
    rest_j = guard_.repay(rest_j);
    spring_.fill_tank(rest_j);
  } else {
    guard_.owe(-spring_.fill_tank(rest_j));
  }
}

}  // namespace longreach
