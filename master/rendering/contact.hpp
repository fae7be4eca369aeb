#pragma once
// What the slave has met, felt by the hand: a unilateral spring for each surface that it reports, in
// translation or in rotation. The spring is the tangent of the contact's law where the hand works, and begins
// at the tangent's foot, behind the surface; the surface is the goal at the touch sequence, or lies at an
// offset from the engagement's anchor where it is older than that.
//
//   f = -Σ n_i max(0, k_i (s_i - a_i) + B n_i . x'),   s_i = n_i . x
//
// x is the handle's position (m) or rotation vector (rad) in M; goals are displacements or rotation vectors
// from the engagement's anchor, in W; n_i points inwards. On a handle that is let go the springs fade, until
// a hand holds it again. While the goal lies in front of a surface, or the clutch is pressed, its spring has
// no force. What the slave remembers is felt as what it presses on; what it does not report any more fades. A
// spring changes its direction only without force.

#include <array>
#include <cstdint>
#include <optional>

#include "common/link/stiffness_report.hpp"
#include "common/spatial/spatial.hpp"
#include "master/mapping/mapping.hpp"
#include "master/rendering/contact_spring.hpp"
#include "master/rendering/goal_history.hpp"

namespace longreach {

struct ContactConfig {
  ContactSpringConfig spring{};
  double ke = 1.0;
  bool ke_by_scale = false;  // rendered is ke k_scale of what is estimated, else ke of it
  double damping = 0.0;      // B, N s/m
  bool by_arrival = false;   // surfaces lie at the newest goal, for contrast
};

enum class ContactMotion : std::uint8_t { kTranslation, kRotation };

/// The handle now.
struct ContactHandle {
  Vector3 x = Vector3::Zero();           // in M
  Vector3 rate = Vector3::Zero();        // x'
  Vector3 goal = Vector3::Zero();        // commanded, in W
  bool rate_mode = false;                // no position to press against: the goal's own depth is felt
  bool held = true;                      // nobody feels what presses on a handle that was let go
  bool clutched = false;                 // the hand moves without the robot
  Vector3 deflection = Vector3::Zero();  // from the centre of rate mode, in M
};

/// What a report meant.
enum class ContactChange : std::uint8_t {
  kNone,      // nothing new, or not enough is known yet
  kRejected,  // impossible, or a touch that this side never commanded
  kUpdated,   // surfaces or stiffness
};

struct ContactAxis {
  bool known = false;
  Vector3 n_W = Vector3::UnitX();  // inward, unit
  Vector3 n_M = Vector3::UnitX();  // the same in M
  Vector3 goal = Vector3::Zero();  // at the foot of the tangent
  double reported = 0.0;           // stiffness times ke, N/m
  double surface = 0.0;            // handle's coordinate of the foot along n_M, m
  double foot = 0.0;               // how far that is behind the surface, in the goal's space, m
  double force = 0.0;              // rendered, against n_M, N
  std::uint32_t touch = 0;
  bool let_go = false;  // the spring has faded, since nobody holds the handle
  ContactSpring spring{ContactSpringConfig{}};

  [[nodiscard]] double s(const Vector3& x) const { return n_M.dot(x); }
};

class Contact {
 public:
  static constexpr std::size_t kAxes = kSurfaces;

  Contact(ContactMotion motion, const ContactConfig& config) : motion_(motion) { configure(config); }
  void configure(const ContactConfig& config);
  void reset();

  /// Takes a report of the present engagement.
  ContactChange on_report(const ContactReport& report, const GoalHistory& history,
                          const ContactHandle& handle, const Mapping& mapping);

  /// One tick; `stale`: nothing has been heard, everything fades and is forgotten. Force on the hand.
  Vector3 step(const ContactHandle& handle, const Mapping& mapping, bool stale, EnergySource source,
               double dt_s);
  /// The same without any rule, for contrast.
  Vector3 step_naive(const ContactHandle& handle, const Mapping& mapping, bool stale);

  [[nodiscard]] double energy_j(const Vector3& x) const;  // stored in the springs
  [[nodiscard]] double paid_j() const;                    // from purse to springs, in the last step
  /// What the goal is commanded into, for Mapping: its force shall grow by `rise_per_s` at the most.
  [[nodiscard]] PressedSurfaces pressed(double rise_per_s) const;
  /// The axis that is felt most, else the stiffest that is known, else the first.
  [[nodiscard]] const ContactAxis& foremost() const;
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool clamped() const;
  [[nodiscard]] bool yielding() const;

 private:
  using Surfaces = std::array<ReportedSurface, kSurfaces>;
  /// Where a surface lies among the goals; none: its touch is too long ago.
  [[nodiscard]] std::optional<Vector3> goal_of(const ReportedSurface& s, const GoalHistory& history) const;
  ContactAxis* axis_of(const ReportedSurface& s);
  void forget(ContactAxis& a, const Vector3& x);
  void update(ContactAxis& a, const ReportedSurface& s, const std::optional<Vector3>& goal,
              const ContactHandle& handle, const Mapping& mapping);
  void add_axis(const ReportedSurface& s, const Vector3& goal, const ContactHandle& handle,
                const Mapping& mapping);
  [[nodiscard]] double ke(const Mapping& mapping) const;
  /// Handle's coordinate along the axis where it commands the goal at the touch.
  [[nodiscard]] double along(const ContactAxis& axis, const Mapping& mapping) const;
  double locate(const ContactAxis& axis, const ContactHandle& handle, const Mapping& mapping) const;

  ContactMotion motion_;
  ContactConfig config_{};
  std::array<ContactAxis, kAxes> axes_{};
};

}  // namespace longreach
