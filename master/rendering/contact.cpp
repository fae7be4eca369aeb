#include "master/rendering/contact.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kSameSurfaceAxis = 0.2;  // sine: 11 degrees
constexpr double kAcross = 0.5;           // cosine: 60 degrees
constexpr double kLeastShare = 1e-3;      // of the largest stiffness: less is no surface but noise
constexpr double kLeastSense = 0.02;      // cosine of the motion with an axis that tells its sense
constexpr double kDeepest = 1.5;          // depth of a spring, over that of the hand behind the surface

struct Principal {
  Vector3 values;  // ascending
  Matrix3 vectors;
};

Principal principal(const Matrix3& symmetric) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// What is left of the tensor across `n`.
Matrix3 across(const Matrix3& K, const Vector3& n) {
  const Matrix3 P = Matrix3::Identity() - n * n.transpose();
  return P * K * P;
}

}  // namespace

void Contact::configure(const ContactConfig& config) {
  config_ = config;
  for (ContactAxis& a : axes_) a.spring.configure(config.spring);
}

void Contact::reset() {
  axes_ = {};
  for (ContactAxis& a : axes_) a.spring.configure(config_.spring);
  force_step_ = 0.0;
}

ContactChange Contact::on_report(const ContactStiffness& contact, const GoalHistory& history,
                                 const ContactHandle& handle, const Mapping& mapping) {
  if (!contact.stiffness.allFinite() || !std::isfinite(contact.touch_sequence) ||
      !contact.place.allFinite() || !contact.surface.allFinite() || !std::isfinite(contact.proof_depth))
    return ContactChange::kRejected;
  if (!contact.in_contact) {
    for (ContactAxis& a : axes_) a.released = true;
    forget_what_is_free(contact.place, handle.x);
    return ContactChange::kNone;
  }
  const bool older = !contact.surface.isZero(0.0);  // than the engagement: no goal was there
  auto goal = config_.by_arrival ? history.newest() : history.at(contact.touch_sequence);
  if (older && !config_.by_arrival) goal = contact.surface;
  if (!(contact.stiffness.cwiseAbs().maxCoeff() > 0.0)) return ContactChange::kNone;  // not identified yet
  if (!goal && !history.forgotten(contact.touch_sequence)) return ContactChange::kRejected;
  const Vector3 motion = older ? Vector3(contact.place - contact.surface)
                               : history.motion_before(contact.touch_sequence, config_.least_motion);
  const Vector3 before = spring_force(handle.x);
  if (!take_tensor(contact, goal, motion, handle, mapping))
    return goal ? ContactChange::kNone : ContactChange::kRejected;
  force_step_ = (spring_force(handle.x) - before).norm();
  return ContactChange::kUpdated;
}

void Contact::forget_what_is_free(const Vector3& place, const Vector3& x) {
  for (ContactAxis& a : axes_) {
    if (!a.known || a.n_W.dot(place - a.goal) < a.proof_depth + config_.place_error) continue;
    a.known = false;
    a.spring.set_stiffness(a.s(x), 0.0);
  }
}

bool Contact::take_tensor(const ContactStiffness& contact, const std::optional<Vector3>& goal,
                          const Vector3& motion, const ContactHandle& handle, const Mapping& mapping) {
  Matrix3 left = 0.5 * (contact.stiffness + contact.stiffness.transpose());
  const double ke = this->ke(mapping);
  const double least = kLeastShare * left.cwiseAbs().maxCoeff();
  bool any = false;
  // News is old: an axis that is not in it may be pressed again by now, and stays until free space disproves
  // it.
  for (ContactAxis& a : axes_) {
    if (!a.known) continue;
    const Vector3 row = left * a.n_W;
    const double k = a.n_W.dot(row);
    if (k > least && (row - k * a.n_W).norm() <= kSameSurfaceAxis * k) {
      // Met again, or known better: another touch while this one lasts does not move it.
      if (goal && (a.released || (a.touch == contact.touch && !config_.by_arrival))) a.goal = *goal;
      a.touch = a.released ? contact.touch : a.touch;
      a.released = false;
      a.proof_depth = proof_depth(contact);
      a.reported = ke * k;
      left = across(left, a.n_W);
      any = true;
      if (!a.let_go) a.spring.set_stiffness(a.s(handle.x), a.reported);
    }
  }
  if (!goal) return any;  // nothing new can be placed
  const Principal rest = principal(left);
  for (int i = 2; i >= 0; --i) {
    if (!(rest.values[i] > least)) continue;
    const Vector3 n = rest.vectors.col(i).normalized();
    const Vector3 into = inward(n, motion);
    if (!n.allFinite() || into.isZero(0.0)) continue;
    forget_beside(n, handle.x);
    add_axis(into, contact, *goal, handle, mapping, rest.values[i]);
    any = true;
  }
  return any;
}

Vector3 Contact::inward(const Vector3& n, const Vector3& motion) const {
  const double sense = n.dot(motion);
  if (std::abs(sense) > kLeastSense * motion.norm()) return sense > 0.0 ? n : Vector3(-n);
  for (const Vector3& met : met_) {
    if (std::abs(n.dot(met)) > 1.0 - kSameSurfaceAxis) return n.dot(met) > 0.0 ? n : Vector3(-n);
  }
  return Vector3::Zero();
}

/// A remembered axis that is neither this one nor well across it is the same surface, measured otherwise.
void Contact::forget_beside(const Vector3& n_W, const Vector3& x) {
  for (ContactAxis& a : axes_) {
    if (!a.known || std::abs(a.n_W.dot(n_W)) < kAcross) continue;
    a.known = false;
    a.spring.set_stiffness(a.s(x), 0.0);
  }
}

/// Takes the first place without force; where there is none, the report after the fading brings the axis
/// again.
void Contact::add_axis(const Vector3& n_W, const ContactStiffness& contact, const Vector3& goal,
                       const ContactHandle& handle, const Mapping& mapping, double stiffness) {
  for (std::size_t i = 0; i < kAxes; ++i) {
    ContactAxis& a = axes_[i];
    if (a.known || a.spring.energy_j(a.s(handle.x)) > 0.0) continue;
    met_[i] = n_W;
    a = ContactAxis{.known = true,
                    .n_W = n_W,
                    .n_M = mapping.base().conjugate() * n_W,
                    .goal = goal,
                    .proof_depth = proof_depth(contact),
                    .reported = ke(mapping) * stiffness,
                    .touch = contact.touch};
    a.spring.configure(config_.spring);
    a.surface = locate(a, handle, mapping);
    a.spring.begin(a.s(handle.x), a.surface);
    a.spring.set_stiffness(a.s(handle.x), a.reported);
    return;
  }
}

double Contact::proof_depth(const ContactStiffness& contact) const {
  return contact.proof_depth > 0.0 ? contact.proof_depth : config_.forget_depth;
}

double Contact::ke(const Mapping& mapping) const {
  return config_.ke * (config_.ke_by_scale ? mapping.scale() : 1.0);
}

double Contact::along(const ContactAxis& a, const Mapping& mapping) const {
  if (motion_ == ContactMotion::kTranslation) return mapping.handle_offset_m(a.n_W, a.n_W.dot(a.goal));
  return a.n_M.dot(mapping.handle_rotation_at(exp_rotation(a.goal)));
}

double Contact::locate(const ContactAxis& a, const ContactHandle& handle, const Mapping& mapping) const {
  if (!handle.rate_mode) return along(a, mapping);
  // Rate mode has no position to press against: the surface lies as deep in the hand as the goal is commanded
  // behind it, up to the force limit, and never beyond the centre: a hand is not driven to the other side.
  const double commanded = a.n_W.dot(handle.goal - a.goal);
  const double k = a.spring.stiffness_n_per_m();
  const double most = k > 0.0 ? config_.spring.force_max_n / k : 0.0;
  const double deflection = std::max(0.0, a.n_M.dot(handle.deflection));
  return a.s(handle.x) - std::clamp(commanded, 0.0, std::min(most, deflection));
}

Vector3 Contact::step(const ContactHandle& handle, const Mapping& mapping, bool stale, Purse purse,
                      double dt_s) {
  Vector3 force = Vector3::Zero();
  for (ContactAxis& a : axes_) {
    const double s = a.s(handle.x);
    if (stale) {
      a.known = false;
      a.spring.set_stiffness(s, 0.0);
    }
    if (a.known) {
      a.surface = locate(a, handle, mapping);
      const bool presses = handle.held && !handle.clutched;
      a.spring.set_surface(presses ? a.surface : std::max(a.surface, s));
      // No contact, no force: what the anchor lags behind may exceed the depth by half of it and no more.
      if (handle.held) a.spring.limit_depth(s, presses ? kDeepest * std::max(0.0, s - a.surface) : 0.0);
      if (!handle.held || a.let_go) a.spring.set_stiffness(s, handle.held ? a.reported : 0.0);
      a.let_go = !handle.held;
    } else {
      a.spring.set_surface(std::max(a.surface, s));  // what fades does not load the hand again
    }
    a.force = a.spring.step(s, dt_s, purse);
    if (a.force <= 0.0) continue;
    const double damped = std::max(0.0, a.force + config_.damping * a.n_M.dot(handle.rate));
    force -= damped * a.n_M;
  }
  return force;
}

Vector3 Contact::step_naive(const ContactHandle& handle, const Mapping& mapping, bool stale) {
  Vector3 force = Vector3::Zero();
  for (ContactAxis& a : axes_) {
    a.force = 0.0;
    if (stale || !a.known) continue;
    a.surface = locate(a, handle, mapping);
    a.force = a.reported * std::max(0.0, a.s(handle.x) - a.surface);
    if (a.force > 0.0) force -= std::max(0.0, a.force + config_.damping * a.n_M.dot(handle.rate)) * a.n_M;
  }
  return force;
}

Vector3 Contact::spring_force(const Vector3& x) const {
  Vector3 force = Vector3::Zero();
  for (const ContactAxis& a : axes_) force -= a.spring.force_n(a.s(x)) * a.n_M;
  return force;
}

double Contact::energy_j(const Vector3& x) const {
  double sum = 0.0;
  for (const ContactAxis& a : axes_) sum += a.spring.energy_j(a.s(x));
  return sum;
}

double Contact::paid_j() const {
  double sum = 0.0;
  for (const ContactAxis& a : axes_) sum += a.spring.paid_j();
  return sum;
}

PressedSurfaces Contact::pressed(double rise_per_s) const {
  PressedSurfaces all;
  for (std::size_t i = 0; i < kAxes; ++i) {
    const double k = axes_[i].spring.stiffness_n_per_m();
    if (axes_[i].known && k > 0.0) all[i] = {axes_[i].goal, axes_[i].n_W, rise_per_s / k};
  }
  return all;
}

const ContactAxis& Contact::foremost() const {
  return *std::ranges::max_element(axes_, [](const ContactAxis& a, const ContactAxis& b) {
    if (a.force != b.force) return a.force < b.force;
    return (a.known ? a.reported : -1.0) < (b.known ? b.reported : -1.0);
  });
}

bool Contact::known() const {
  return std::ranges::any_of(axes_, [](const ContactAxis& a) { return a.known; });
}
bool Contact::clamped() const {
  return std::ranges::any_of(axes_, [](const ContactAxis& a) { return a.known && a.spring.clamped(); });
}
bool Contact::yielding() const {
  return std::ranges::any_of(axes_, [](const ContactAxis& a) { return a.spring.yielding(); });
}

}  // namespace longreach
