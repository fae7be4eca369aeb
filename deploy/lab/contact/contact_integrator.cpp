#include "deploy/lab/contact/contact_integrator.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace longreach {
namespace {

constexpr int kEvaluationsMax = 200;

// φ1(d) = (e^d - 1)/d and φ2(d) = (e^d - 1 - d)/d², d <= 0.
struct ExpQuotients {
  double phi1, phi2;
};

// 2/(j + 2)! for j from 13 to 0.
constexpr std::array<double, 14> kTerms = [] {
  std::array<double, 14> terms{};
  double term = 1.0;
  for (int j = 0; j < 14; ++j) {
    terms[static_cast<std::size_t>(13 - j)] = term;
    term /= j + 3;
  }
  return terms;
}();

ExpQuotients exp_quotients(double d) {
  if (d > -0.5) {
    double sum = 0.0;  // Σ d^j 2/(j + 2)!
    for (const double term : kTerms) sum = term + d * sum;
    return {1.0 + 0.5 * d * sum, 0.5 * sum};
  }
  const double phi1 = (std::exp(d) - 1.0) / d;
  return {phi1, (phi1 - 1.0) / d};
}

// The step as a function of Δq.
struct Trial {
  double dx;     // m
  double dv;     // m/s
  double error;  // Δq + dt ΔU/Δx/m
  double slope;  // of the error
  double rate;   // of dx/dt with Δq
  double kick;   // dt ΔU/Δx/m
};

Trial attempt(const ContactMass& contact, const NormalMotion& from, double dq, double dt) {
  const HuntCrossley& law = contact.law;
  const ExpQuotients e = exp_quotients(law.a * dq);
  const double w = 1.0 + law.a * from.speed_m_per_s;
  Trial trial{};
  trial.dx = (from.speed_m_per_s + w * e.phi2 * dq) * dt;
  trial.dv = w * e.phi1 * dq;
  const HuntCrossley::Mean mean = law.mean_elastic(from.depth_m, trial.dx);
  trial.kick = mean.force_n / contact.mass_kg * dt;
  trial.error = dq + trial.kick;
  trial.rate = w * (e.phi1 - e.phi2);
  trial.slope = 1.0 + mean.slope_n_per_m / contact.mass_kg * trial.rate * dt * dt;
  return trial;
}

NormalMotion moved(const NormalMotion& from, const Trial& trial) {
  return {from.depth_m + trial.dx, from.speed_m_per_s + trial.dv};
}

// Newton's method, bracketed by low < Δq <= high.
NormalStep discrete_gradient(const ContactMass& contact, const NormalMotion& from, double dt) {
  constexpr double kExact = 2.0 * std::numeric_limits<double>::epsilon();
  NormalStep step;
  step.motion.speed_m_per_s = from.speed_m_per_s;
  step.motion.depth_m = from.depth_m + from.speed_m_per_s * dt;
  step.evaluations = 1;
  if (!(1.0 + contact.law.a * from.speed_m_per_s > 0.0)) return step;
  Trial trial = attempt(contact, from, 0.0, dt);
  if (!(trial.error > 0.0)) return step;
  Trial lossy = trial;  // the trial at an end of the bracket where H falls
  double low = -trial.kick, high = 0.0, dq = 0.0;
  for (; step.evaluations < kEvaluationsMax; ++step.evaluations) {
    const double newton = dq - trial.error / trial.slope;
    // The result is exact to the rounding of Δq and dx.
    const double exact = kExact * (std::abs(dq) + std::abs(from.speed_m_per_s) / trial.rate);
    if (step.evaluations > 1 && (std::abs(newton - dq) <= exact || high - low <= exact)) {
      step.motion = moved(from, trial);
      return step;
    }
    dq = newton > low && newton < high ? newton : 0.5 * (low + high);
    trial = attempt(contact, from, dq, dt);
    if (trial.error * trial.dx <= 0.0) lossy = trial;
    (trial.error > 0.0 ? high : low) = dq;
  }
  step.motion = moved(from, lossy);
  step.converged = false;
  return step;
}

NormalStep split(const ContactMass& contact, const NormalMotion& from, double external_n, double dt) {
  const double kick = 0.5 * dt * external_n / contact.mass_kg;
  NormalMotion start = from;
  start.speed_m_per_s += kick;
  NormalStep step = discrete_gradient(contact, start, dt);
  const double before = from.speed_m_per_s + 0.5 * kick, after = step.motion.speed_m_per_s + 0.5 * kick;
  step.motion.speed_m_per_s += kick;
  step.external_work_j = 0.5 * dt * external_n * (before + after);
  return step;
}

struct Rate {
  double speed, acceleration;
};

Rate rate(const ContactMass& contact, double external_n, const NormalMotion& at) {
  const double force = contact.law.force_n(at.depth_m, at.speed_m_per_s);
  return {at.speed_m_per_s, (external_n - force) / contact.mass_kg};
}

NormalMotion along(const NormalMotion& from, const Rate& r, double dt) {
  return {from.depth_m + dt * r.speed, from.speed_m_per_s + dt * r.acceleration};
}

NormalMotion rk4(const ContactMass& contact, const NormalMotion& from, double external_n, double dt) {
  const Rate a = rate(contact, external_n, from);
  const Rate b = rate(contact, external_n, along(from, a, 0.5 * dt));
  const Rate c = rate(contact, external_n, along(from, b, 0.5 * dt));
  const Rate d = rate(contact, external_n, along(from, c, dt));
  return along(from,
               {(a.speed + 2.0 * (b.speed + c.speed) + d.speed) / 6.0,
                (a.acceleration + 2.0 * (b.acceleration + c.acceleration) + d.acceleration) / 6.0},
               dt);
}

}  // namespace

NormalStep step_contact(Integrator integrator, const ContactMass& contact, const NormalMotion& from,
                        double external_n, double dt) {
  NormalStep step;
  switch (integrator) {
    case Integrator::kDiscreteGradient:
      step = split(contact, from, external_n, dt);
      break;
    case Integrator::kExplicitEuler:
      step = {along(from, rate(contact, external_n, from), dt), 0.0, 1, true};
      break;
    case Integrator::kSemiImplicitEuler: {
      Rate r = rate(contact, external_n, from);
      r.speed += dt * r.acceleration;
      step = {along(from, r, dt), 0.0, 1, true};
      break;
    }
    case Integrator::kRk4:
      step = {rk4(contact, from, external_n, dt), 0.0, 4, true};
      break;
  }
  if (integrator != Integrator::kDiscreteGradient)
    step.external_work_j = external_n * (step.motion.depth_m - from.depth_m);
  const double sum = step.motion.depth_m + step.motion.speed_m_per_s + step.external_work_j;
  const bool law =
      std::isfinite(contact.law.k) && std::isfinite(contact.law.n) && std::isfinite(contact.law.a);
  if (law && std::isfinite(sum)) return step;
  return {from, 0.0, step.evaluations, false};
}

double contact_time_s(const ContactMass& contact, double speed_m_per_s) {
  const HuntCrossley& law = contact.law;
  const double n1 = law.n + 1.0;
  const double deepest = std::pow(n1 * contact.mass_kg / law.k * law.impact_energy(speed_m_per_s), 1.0 / n1);
  // Without damping the time is exact: 2 x_max/v ∫ du/√(1 - u^(n+1)), u from 0 to 1.
  const double shape =
      std::sqrt(std::numbers::pi) * std::exp(std::lgamma(1.0 + 1.0 / n1) - std::lgamma(0.5 + 1.0 / n1));
  return 2.0 * deepest / speed_m_per_s * shape;
}

}  // namespace longreach
