#include "master/rendering/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace longreach {
namespace {

/// Returns the maximum stiffness of a sampled spring on a damped device: K < b/(T/2 + t_d) (Colgate and
/// Schenkel 1997, without virtual damping).
double device_limit(const RenderedDevice& d, double damping) {
  return damping / (0.5 * d.period_s + d.delay_s);
}

ContactConfig translation_contact(const RenderingConfig& c, const RenderedDevice& d) {
  return {.spring = {.fade_s = c.fade_s,
                     .stiffness_max_n_per_m =
                         std::min(c.stiffness_max_n_per_m, device_limit(d, d.damping_n_s_per_m)),
                     .force_max_n = c.force_max_n,
                     .count_m = d.cell.m},
          .ke = c.ke,
          .ke_by_scale = c.ke_by_scale,
          .damping = c.contact_damping_n_s_per_m,
          .by_arrival = c.registration == Registration::kArrival,
          .rate_ratio = c.rate_force_ratio};
}

ContactConfig rotation_contact(const RenderingConfig& c, const RenderedDevice& d) {
  return {.spring = {.fade_s = c.fade_s,
                     .stiffness_max_n_per_m =
                         std::min(c.stiffness_max_nm_per_rad, device_limit(d, d.damping_nm_s_per_rad)),
                     .force_max_n = c.moment_max_nm,
                     .count_m = d.cell.rad},
          .ke = c.ke_rotation,
          .ke_by_scale = c.ke_by_scale,
          .damping = c.contact_damping_nm_s_per_rad,
          .by_arrival = c.registration == Registration::kArrival,
          .rate_ratio = c.rate_force_ratio};
}

PortGuardConfig translation_guard(const RenderingConfig& c, const RenderedDevice& d) {
  return {.handle_mass = d.mass_kg,
          .force_max = c.force_max_n,
          .slew_per_s = c.slew_n_per_s,
          .ramp_s = c.ramp_s,
          .freed_damping = 30.0};
}

PortGuardConfig rotation_guard(const RenderingConfig& c, const RenderedDevice& d) {
  return {.handle_mass = d.inertia_kg_m2,
          .force_max = c.moment_max_nm,
          .slew_per_s = c.slew_nm_per_s,
          .ramp_s = c.ramp_s};
}

/// Returns D in φ' = D(φ) ω, with φ = log(R) and ω in the frame of the base: the inverse left Jacobian of
/// SO(3).
Matrix3 rotation_vector_rate(const Vector3& phi) {
  Matrix3 cross;
  cross << 0.0, -phi.z(), phi.y(), phi.z(), 0.0, -phi.x(), -phi.y(), phi.x(), 0.0;
  const double angle = phi.norm();
  // (1 - (a/2) cot(a/2))/a², near zero by its series.
  const double c = angle < 1e-3 ? 1.0 / 12.0 + angle * angle / 720.0
                                : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  return Matrix3::Identity() - 0.5 * cross + c * cross * cross;
}

ContactHandle translation_handle(const RendererInput& in, const Mapping& mapping) {
  return {in.handle.p_MH,
          in.handle.velocity_m_per_s,
          mapping.goal().position_m,
          in.mode == MotionMode::kRate,
          in.handle.held,
          in.clutched,
          in.live,
          mapping.deflection_m(in.handle)};
}

/// `phi` is the rotation vector of the handle, `rate` is D(phi).
ContactHandle rotation_handle(const RendererInput& in, const Mapping& mapping, const Vector3& phi,
                              const Matrix3& rate) {
  return {phi,
          rate * in.handle.angular_rad_per_s,
          mapping.goal().rotation_rad,
          in.mode == MotionMode::kRate,
          in.handle.held,
          in.clutched,
          in.live,
          mapping.deflection_rad(in.handle)};
}

/// Adds the boundary at which a limit holds the robot back as a surface, unless the tool touches a surface there.
ContactReport with_boundary(const ContactReport& report, double stiffness) {
  constexpr double kSame = 0.5;
  ContactReport all = report;
  if (report.held_back.isZero(0.0)) return all;
  const ReportedSurface boundary{.normal = -report.held_back,
                                 .stiffness = stiffness,
                                 .offset = -report.held_back.dot(report.place),
                                 .touch = Contact::kBoundary};
  for (ReportedSurface& s : all.surfaces) {
    if (s.touch == 0) {
      s = boundary;
      break;
    }
    if (s.normal.dot(boundary.normal) > kSame) break;
  }
  return all;
}

}  // namespace

void HandPort::begin(const Vector3& x) {
  contact.let_go(guard.gain());
  stored_j = contact.energy_j(x);
  tank.empty();  // its energy may come from the store of the previous engagement
  guard.open();
}

double HandPort::account(double entered_j, double now_j, double supplied_j, const Vector3& now) {
  double rest_j = entered_j - (now_j - stored_j) + contact.paid_j() + supplied_j;
  const double unsure_j = cell * norm(Vector3(now - force));
  rest_j = std::copysign(std::max(0.0, std::abs(rest_j) - unsure_j), rest_j);
  stored_j = now_j;
  force = now;
  if (rest_j > 0.0) {
    return tank.fill(guard.repay(rest_j));
  }
  guard.owe(-tank.fill(rest_j));
  return 0.0;
}

Renderer::Renderer(const RenderingConfig& config, const RenderedDevice& device)
    : config_(config),
      device_(device),
      resistance_(config),
      translation_(ContactMotion::kTranslation, translation_contact(config, device),
                   translation_guard(config, device), config.tank_max_j, device.cell.m),
      rotation_(ContactMotion::kRotation, rotation_contact(config, device), rotation_guard(config, device),
                config.tank_max_j, device.cell.rad),
      store_(config.store_j) {}

void Renderer::configure(const RenderingConfig& config) {
  config_ = config;
  resistance_.configure(config);
  translation_.contact.configure(translation_contact(config, device_));
  rotation_.contact.configure(rotation_contact(config, device_));
  translation_.guard.configure(translation_guard(config, device_));
  rotation_.guard.configure(rotation_guard(config, device_));
  translation_.tank.resize(config.tank_max_j);
  rotation_.tank.resize(config.tank_max_j);
  store_.resize(config.store_j);
}

void Renderer::reset(const HandleState& handle) {
  resistance_.reset(handle);
  x_last_ = handle.p_MH;
  q_last_ = handle.q_MH;
  store_.fill(config_.store_j);
  began_j_ = port_energy_j();
  supplied_j_ = 0.0;
  begins_ = true;
  unreported_.reset();
  force_step_n_ = 0.0;
  translation_.begin(handle.p_MH);
  rotation_.begin(log_rotation(handle.q_MH));
  // Springs of the previous engagement that still fade are part of the initial energy.
  store_.spend(translation_.stored_j + rotation_.stored_j);
}

bool Renderer::on_report(const StiffnessReport& report, const GoalHistories& history,
                         const RendererInput& input, const Mapping& mapping) {
  constexpr double kBoundary_n_per_m = 1000.0, kBoundary_nm_per_rad = 5.0;
  if (!unreported_) unreported_ = translation_.contact;
  const ContactChange first =
      translation_.contact.on_report(with_boundary(report.translation, kBoundary_n_per_m),
                                     history.translation, translation_handle(input, mapping), mapping);
  const Vector3 phi = log_rotation(input.handle.q_MH);
  const ContactChange second =
      rotation_.contact.on_report(with_boundary(report.rotation, kBoundary_nm_per_rad), history.rotation,
                                  rotation_handle(input, mapping, phi, rotation_vector_rate(phi)), mapping);
  return first != ContactChange::kRejected && second != ContactChange::kRejected;
}

Vector3 Renderer::contact_force(Contact& contact, EnergyTank& tank, EnergyTank& store,
                                const ContactHandle& at, const Mapping& mapping, bool stale) {
  if (law_ != nullptr) return contact.step_by(*law_, at, mapping, stale);
  return contact.step(at, mapping, stale, EnergySource(tank, stale ? nullptr : &store), device_.period_s);
}

Vector3 Renderer::translate(const RendererInput& in, const Mapping& mapping, const Vector3& resistance) {
  const double entered_j = translation_.guard.observe(in.handle.p_MH - x_last_);
  x_last_ = in.handle.p_MH;
  const ContactHandle at = translation_handle(in, mapping);
  EnergyTank tank = translation_.tank, store = store_;
  const Vector3 contact =
      contact_force(translation_.contact, translation_.tank, store_, at, mapping, in.stale);
  if (unreported_) {
    const Vector3 without = contact_force(*unreported_, tank, store, at, mapping, in.stale);
    const double larger_n = contact.stableNorm() - without.stableNorm();
    const double change_n = (contact - without).stableNorm();
    // A report that ends the fall to a depth limit is no step.
    force_step_n_ = larger_n < 0.0 ? -change_n : std::max(0.0, change_n - unreported_->shortened_n());
    unreported_.reset();
  }
  if (law_ == nullptr) {
    // The ramp scales the stored energy like the force, because the hand loads a spring only by the applied
    // force.
    const double felt_j = translation_.contact.energy_j(in.handle.p_MH) + resistance_.energy_j();
    const double left_j =
        translation_.account(entered_j, translation_.guard.gain() * felt_j + in.translation.stored_j,
                             in.translation.supplied_j, resistance + contact + in.translation.force);
    store_.fill(left_j);
  }
  return translation_.guard.apply(
      {resistance + contact, in.translation.force, in.handle.velocity_m_per_s, in.live}, device_.period_s);
}

Vector3 Renderer::rotate(const RendererInput& in, const Mapping& mapping, const Vector3& resistance) {
  const double entered_j = rotation_.guard.observe(log_rotation(in.handle.q_MH * q_last_.conjugate()));
  q_last_ = in.handle.q_MH;
  const Vector3 phi = log_rotation(in.handle.q_MH);
  const Matrix3 rate = rotation_vector_rate(phi);
  const Vector3 contact =
      rate.transpose() * contact_force(rotation_.contact, rotation_.tank, store_,
                                       rotation_handle(in, mapping, phi, rate), mapping, in.stale);
  if (law_ == nullptr) {
    const double felt_j = rotation_.contact.energy_j(phi) + resistance_.rotation_energy_j();
    const double left_j = rotation_.account(entered_j, rotation_.guard.gain() * felt_j + in.rotation.stored_j,
                                            in.rotation.supplied_j, resistance + contact + in.rotation.force);
    store_.fill(left_j);
  }
  return rotation_.guard.apply(
      {resistance + contact, in.rotation.force, in.handle.angular_rad_per_s, in.live}, device_.period_s);
}

void Renderer::let_down(const RendererInput& input) {
  const bool freed = input.mode != mode_ || (input.clutched && !clutched_) || (!input.live && live_);
  mode_ = input.mode;
  clutched_ = input.clutched;
  live_ = input.live;
  const double pushed_n = translation_.guard.gain() * translation_.contact.foremost().force;
  if (freed && pushed_n > 0.0) translation_.guard.free_hand();
}

/// Drag that refills the store from the motion of the hand (tank level control).
Vector3 Renderer::refill_drag(const RendererInput& input) const {
  constexpr double kDamping_n_s_per_m = 2.0, kMost_n = 0.15;
  if (law_ != nullptr || !input.live || store_.level_j() >= config_.store_j) return Vector3::Zero();
  return -clamp_norm(Vector3(kDamping_n_s_per_m * input.handle.velocity_m_per_s), kMost_n);
}

Wrench Renderer::step(const RendererInput& input, const Mapping& mapping) {
  let_down(input);
  if (std::exchange(begins_, false)) {
    // The springs of the device's own behaviour may already be stretched; their energy was not supplied in
    // this engagement.
    translation_.stored_j += input.translation.stored_j;
    rotation_.stored_j += input.rotation.stored_j;
  }
  Wrench resistance;
  if (input.handle.held) {
    resistance = resistance_.step({input.handle, input.mode, input.scale, mapping.centre_m(),
                                   mapping.centre_rotation(), mapping.frozen(), input.load, device_.turns},
                                  device_.period_s);
    resistance.force += refill_drag(input);
  } else {
    resistance_.reset(input.handle);
  }
  Wrench F;
  F.force = translate(input, mapping, resistance.force);
  if (device_.turns) F.moment = rotate(input, mapping, resistance.moment);
  supplied_j_ += input.translation.supplied_j + input.rotation.supplied_j;
  port_energy_min_j_ = std::min(port_energy_min_j_, port_energy_j() + supplied_j_ - began_j_);
  return F;
}

double Renderer::stiffness(const HandPort& port) const {
  const ContactAxis& axis = port.contact.foremost();
  return law_ != nullptr ? axis.reported : axis.spring.stiffness_n_per_m();
}

double Renderer::stiffness_max_n_per_m() const {
  return translation_contact(config_, device_).spring.stiffness_max_n_per_m;
}

double Renderer::stiffness_max_nm_per_rad() const {
  return rotation_contact(config_, device_).spring.stiffness_max_n_per_m;
}

double Renderer::port_energy_j() const {
  return translation_.guard.port_energy_j() + rotation_.guard.port_energy_j();
}

double Renderer::stored_energy_j() const {
  return translation_.stored_j + translation_.tank.level_j() + rotation_.stored_j + rotation_.tank.level_j();
}

}  // namespace longreach
