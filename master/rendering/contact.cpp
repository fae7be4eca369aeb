#include "master/rendering/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "master/rendering/contact_law.hpp"

namespace longreach {
namespace {

// Cosines of the angle between a known and a reported normal.
constexpr double kSameTouch = 0.5;       // minimum for the same surface during one touch
constexpr double kSameDirection = 0.9;   // minimum for the same surface when it is touched again
constexpr double kTurned = 0.98;         // minimum at which a loaded spring is kept (11 degrees)
constexpr double kDeepest = 1.5;         // maximum ratio of the depth of a spring to that of the hand
constexpr double kUnitTolerance = 1e-3;  // tolerance of the length of a normal
// Rate mode: force per deflection beyond the dead zone, N/m and N m/rad. It has the same ratio as the centring springs.
constexpr double kAim_n_per_m = 200.0, kAim_nm_per_rad = 1.5;
// Maximum stiffness of the spring then. The spring yields with the hand, so a stiffer one would be loaded more slowly.
constexpr double kSoft_n_per_m = 400.0, kSoft_nm_per_rad = 3.0;

bool possible(const ReportedSurface& s) {
  return s.normal.allFinite() && std::abs(s.normal.norm() - 1.0) < kUnitTolerance &&
         std::isfinite(s.stiffness) && s.stiffness >= 0.0 && std::isfinite(s.foot) && s.foot >= 0.0 &&
         std::isfinite(s.touch_sequence) && s.touch_sequence >= 0.0 && std::isfinite(s.offset);
}

/// Returns whether all surfaces are possible. No two of them may have the same direction.
bool possible(const std::array<ReportedSurface, kSurfaces>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].touch == 0) continue;
    if (!possible(all[i])) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (all[j].touch > 0 && all[i].normal.dot(all[j].normal) > kTurned) return false;
    }
  }
  return true;
}

}  // namespace

void Contact::configure(const ContactConfig& config) {
  config_ = config;
  for (ContactAxis& a : axes_) a.spring.configure(config.spring);
}

void Contact::let_go(double share) {
  begun_ = false;
  for (ContactAxis& a : axes_) {
    a.known = false;
    a.spring.let_go(share);
  }
}

ContactChange Contact::on_report(const ContactReport& report, const GoalHistory& history,
                                 const ContactHandle& handle, const Mapping& mapping) {
  if (!possible(report.surfaces)) return ContactChange::kRejected;
  std::array<std::optional<Vector3>, kSurfaces> goals{};
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const ReportedSurface& s = report.surfaces[i];
    if (s.touch == 0) continue;
    goals[i] = goal_of(s, history);
    if (!goals[i] && !history.forgotten(s.touch_sequence)) return ContactChange::kRejected;
  }
  for (ContactAxis& a : axes_) {
    const auto same = [&](const ReportedSurface& s) { return s.touch > 0 && axis_of(s) == &a; };
    if (a.known && std::ranges::none_of(report.surfaces, same)) forget(a, handle.x);
  }
  bool any = false;
  if (!report.in_contact()) begun_ = false;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const ReportedSurface& s = report.surfaces[i];
    if (s.touch == 0 || s.stiffness <= 0.0) continue;  // no surface, or not identified yet
    ContactAxis* known = axis_of(s);
    any = any || known || goals[i];
    if (known) {
      update(*known, s, goals[i], handle, mapping);
    } else if (goals[i]) {  // a new surface cannot be placed without its goal
      add_axis(s, *goals[i], handle, mapping);
    }
  }
  for (ContactAxis& a : axes_) a.threshold = report.threshold, a.guard = report.guard;
  begun_ = begun_ || (any && report.in_contact());
  return any ? ContactChange::kUpdated : ContactChange::kNone;
}

std::optional<Vector3> Contact::goal_of(const ReportedSurface& s, const GoalHistory& history) const {
  std::optional<Vector3> goal = history.newest();
  if (!config_.by_arrival && s.touch_sequence > 0.0) {
    goal = history.at(s.touch_sequence);
  } else if (!config_.by_arrival) {
    // The point of the surface that is nearest to the hand is used. A loaded spring keeps its direction, so
    // if the normal has turned since, a point far from the hand would shift the surface.
    const Vector3 hand = goal.value_or(Vector3::Zero());
    goal = hand + (s.offset - s.normal.dot(hand)) * s.normal;
  }
  if (goal) *goal -= s.foot * s.normal;
  return goal;
}

ContactAxis* Contact::axis_of(const ReportedSurface& s) {
  for (ContactAxis& a : axes_) {
    const double cosine = -a.n_W.dot(s.normal);
    if (a.known && cosine > (a.touch == s.touch ? kSameTouch : kSameDirection)) return &a;
  }
  return nullptr;
}

void Contact::forget(ContactAxis& a, const Vector3& x) {
  a.known = false;
  a.spring.set_stiffness(a.s(x), 0.0);
}

void Contact::update(ContactAxis& a, const ReportedSurface& s, const std::optional<Vector3>& goal,
                     const ContactHandle& handle, const Mapping& mapping) {
  const bool turned = -a.n_W.dot(s.normal)<kTurned, pressed = a.spring.energy_j(a.s(handle.x))> 0.0;
  if (turned && pressed) return forget(a, handle.x);
  if (goal && (a.touch != s.touch || !config_.by_arrival)) a.goal = *goal;
  a.first = a.first || (a.touch != s.touch && !begun_);
  a.touch = s.touch;
  a.foot = s.foot;
  a.reported = ke(mapping) * s.stiffness;
  a.stiffness = s.stiffness;
  a.pressed = s.pressed;
  if (!pressed && a.n_W != -s.normal) {
    a.n_W = -s.normal;
    a.first_at = a.watched_at = a.n_W.dot(a.goal);
    a.n_M = mapping.base().conjugate() * a.n_W;
    a.surface = locate(a, handle, mapping);
    a.spring.begin(a.s(handle.x), a.surface);
  }
  if (!a.let_go) a.spring.set_stiffness(a.s(handle.x), rendered(a));
}

/// Uses the first free axis without force. If there is none, a later report adds the surface after a spring
/// has faded.
void Contact::add_axis(const ReportedSurface& s, const Vector3& goal, const ContactHandle& handle,
                       const Mapping& mapping) {
  for (ContactAxis& a : axes_) {
    if (a.known || a.spring.energy_j(a.s(handle.x)) > 0.0) continue;
    a = ContactAxis{.known = true,
                    .n_W = -s.normal,
                    .n_M = mapping.base().conjugate() * -s.normal,
                    .goal = goal,
                    .stiffness = s.stiffness,
                    .reported = ke(mapping) * s.stiffness,
                    .foot = s.foot,
                    .touch = s.touch,
                    .pressed = s.pressed,
                    .first = !begun_};
    a.commands = handle.rate_mode && by_force(a);
    a.first_at = a.watched_at = a.n_W.dot(goal);
    a.spring.configure(config_.spring);
    a.surface = locate(a, handle, mapping);
    a.spring.begin(a.s(handle.x), a.surface);
    a.spring.set_stiffness(a.s(handle.x), rendered(a));
    return;
  }
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
  // In rate mode the handle has no position at which to press against the surface. The handle is therefore placed as
  // deep behind the surface as the commanded force requires, or as the goal is, and never so deep that the hand would be
  // driven beyond the centre.
  const double commanded = a.n_W.dot(handle.goal - a.goal);
  const double k = a.spring.stiffness_n_per_m();
  if (!(k > 0.0) || !(commanded > 0.0)) return a.s(handle.x);
  if (by_force(a)) return a.s(handle.x) - aim(a, handle) / k;
  const double most = std::min(config_.spring.force_max_n / k, std::max(0.0, a.n_M.dot(handle.deflection)));
  return a.s(handle.x) - std::min(commanded, most);
}

double Contact::rendered(const ContactAxis& a) const {
  if (!a.commands) return a.reported;
  return std::min(a.reported, motion_ == ContactMotion::kTranslation ? kSoft_n_per_m : kSoft_nm_per_rad);
}

double Contact::aim(const ContactAxis& a, const ContactHandle& handle) const {
  const double most = motion_ == ContactMotion::kTranslation ? kAim_n_per_m : kAim_nm_per_rad;
  // A softer spring would drive the hand beyond the centre.
  const double slope = std::min(most, a.spring.stiffness_n_per_m());
  const double pushed = slope * std::max(0.0, a.n_M.dot(handle.deflection));
  const double guarded = a.guard > 0.0 ? config_.rate_ratio * a.guard : pushed;
  return std::min({pushed, guarded, config_.spring.force_max_n});
}

bool ContactAxis::rests() const {
  constexpr double kFarthest = 0.1;  // m or rad
  return !comes && first_at - n_W.dot(goal) < kFarthest;
}

void ContactAxis::watch(double dt_s) {
  constexpr double kWatched_s = 0.5, kMoved = 5e-3 * kWatched_s;  // m or rad
  const double at = n_W.dot(goal);
  const bool moved = watched_at - at > kMoved;
  watched_s += dt_s;
  comes = comes || moved;
  if (watched_s < kWatched_s) return;
  comes = moved;
  watched_at = at;
  watched_s = 0.0;
}

Vector3 Contact::step(const ContactHandle& handle, const Mapping& mapping, bool stale, EnergySource source,
                      double dt_s) {
  Vector3 force = Vector3::Zero();
  for (ContactAxis& a : axes_) {
    const double s = a.s(handle.x);
    if (stale) {
      begun_ = false;
      a.known = false;
      a.spring.set_stiffness(s, 0.0);
    }
    a.watch(dt_s);
    a.aim = handle.rate_mode ? aim(a, handle) : 0.0;
    if (a.known && handle.live) {
      const bool commands = handle.rate_mode && by_force(a);
      if (std::exchange(a.commands, commands) != commands && !a.let_go)
        a.spring.set_stiffness(s, rendered(a));
      a.surface = locate(a, handle, mapping);
      const bool presses = handle.held && !handle.clutched;
      a.spring.set_surface(presses ? a.surface : std::max(a.surface, s));
      // Without contact there must be no force, so the depth of the spring is limited to 1.5 times that of
      // the handle behind the surface.
      a.spring.limit_depth(handle.clutched ? 0.0 : kDeepest * std::max(0.0, s - a.surface));
      if (!handle.held || a.let_go) a.spring.set_stiffness(s, handle.held ? rendered(a) : 0.0);
      a.let_go = !handle.held;
    } else {
      a.spring.set_surface(std::max(a.surface, s));
      a.spring.give_way(s);  // a fading spring must not be loaded again by the hand
    }
    a.force = a.spring.step(s, dt_s, source, a.damper);
    // The damper never exceeds the spring, so that it does not appear at once.
    const double drag = config_.damping * a.n_M.dot(handle.rate), longer = a.force + a.spring.shortened_n();
    a.damper = std::clamp(drag, -a.force, a.force);
    a.shortened = longer + std::clamp(drag, -longer, longer) - (a.force + a.damper);
    force -= (a.force + a.damper) * a.n_M;
  }
  return force;
}

Vector3 Contact::step_by(const ContactLaw& law, const ContactHandle& handle, const Mapping& mapping,
                         bool stale) {
  Vector3 force = Vector3::Zero();
  for (ContactAxis& a : axes_) {
    a.force = 0.0;
    if (stale || !a.known) continue;
    a.surface = locate(a, handle, mapping);
    force -= law.step(a, handle, config_.damping) * a.n_M;
  }
  return force;
}

Vector3 Contact::spring_force() const {
  Vector3 sum = Vector3::Zero();
  for (const ContactAxis& a : axes_) sum -= a.force * a.n_M;
  return sum;
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

double Contact::shortened_n() const {
  double sum = 0.0;
  for (const ContactAxis& a : axes_) sum += a.shortened;
  return sum;
}

double Contact::rise(bool by_force) const {
  // Where the hand does not command the force, hand, goal and force act as an integrator, so the force rises slowly.
  if (motion_ == ContactMotion::kTranslation) return by_force ? 40.0 : 10.0;
  return by_force ? 0.8 : 0.2;
}

PressedSurfaces Contact::pressed() const {
  PressedSurfaces all;
  for (std::size_t i = 0; i < kAxes; ++i) {
    const ContactAxis& a = axes_[i];
    const double k = a.spring.stiffness_n_per_m();
    if (!a.known || !(k > 0.0)) continue;
    const double rise_per_s = rise(by_force(a));
    all[i] = {
        .place = a.goal, .inward = a.n_W, .speed_max = rise_per_s / k, .depth = std::max(0.0, a.force) / k};
    constexpr double kDetected = 2.0;  // thresholds that the tool keeps pressing
    all[i].least = kDetected * a.threshold / a.stiffness;
    // A surface that replaces another one during a contact may be due to a faulty sensor.
    if (a.pressed && a.first && a.rests()) all[i].unpaid = a.spring.unpaid_m();
    if (by_force(a)) command_depth(a, all[i]);
  }
  return all;
}

void Contact::command_depth(const ContactAxis& a, PressedSurface& s) const {
  const double per_force = 1.0 / (config_.rate_ratio * a.stiffness);
  const double aimed = a.aim * per_force, felt = std::min(a.aim, a.force) * per_force;
  s.by_force = true;
  s.shallow = std::max(felt, std::min(aimed, s.least));
  // The goal keeps its depth while the spring is being loaded.
  s.deep = std::max(a.spring.unpaid_m() > 0.0 ? felt : aimed, s.least);
  if (!a.pressed || !a.rests()) s.deep = std::numeric_limits<double>::infinity();
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
