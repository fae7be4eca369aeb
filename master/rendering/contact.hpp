#pragma once
// Displays the contacts of the slave: a unilateral spring for each reported surface, in translation or in
// rotation. The spring is the tangent of the contact law at the working depth, and begins at the foot of the
// tangent, behind the surface. The surface is at the goal of the touch sequence, or, if that is too old, at
// an offset from the engagement's anchor.
//
//   f = -Σ n_i max(0, k_i (s_i - a_i) + B n_i . x'),   s_i = n_i . x
//
// x is the position (m) or rotation vector (rad) of the handle in M; goals are displacements or rotation
// vectors from the engagement's anchor, in W; n_i points inwards. On a released handle the springs fade,
// until a hand holds it again. While the goal is in front of a surface, or the clutch is pressed, its spring
// has no force. A surface that the slave remembers is displayed like one that it presses on; a surface that
// is no longer reported fades. A spring changes its direction only without force.

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
  bool ke_by_scale = false;  // the rendered stiffness is ke k_scale times the estimate, otherwise ke times
  double damping = 0.0;      // B, N s/m
  bool by_arrival = false;   // surfaces are placed at the newest goal, for comparison
};

enum class ContactMotion : std::uint8_t { kTranslation, kRotation };

/// The handle now.
struct ContactHandle {
  Vector3 x = Vector3::Zero();     // in M
  Vector3 rate = Vector3::Zero();  // x'
  Vector3 goal = Vector3::Zero();  // commanded, in W
  bool rate_mode = false;  // there is no position to press against: the depth of the goal itself is displayed
  bool held = true;        // on a released handle the springs fade
  bool clutched = false;   // the hand moves without the robot
  Vector3 deflection = Vector3::Zero();  // from the centre of rate mode, in M
};

/// Result of a report.
enum class ContactChange : std::uint8_t {
  kNone,      // nothing new, or too little is known yet
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
  double foot = 0.0;               // its depth behind the surface, in goal space, m
  double force = 0.0;              // rendered, against n_M, N
  std::uint32_t touch = 0;
  bool let_go = false;  // the spring has faded, because no hand is on the handle
  ContactSpring spring{ContactSpringConfig{}};

  [[nodiscard]] double s(const Vector3& x) const { return n_M.dot(x); }
};

class Contact {
 public:
  static constexpr std::size_t kAxes = kSurfaces;

  Contact(ContactMotion motion, const ContactConfig& config) : motion_(motion) { configure(config); }
  void configure(const ContactConfig& config);
  void reset();

  /// Processes a report of the present engagement.
  ContactChange on_report(const ContactReport& report, const GoalHistory& history,
                          const ContactHandle& handle, const Mapping& mapping);

  /// One tick; `stale`: no datagram arrives, so everything fades and is removed. Returns the force on the
  /// hand.
  Vector3 step(const ContactHandle& handle, const Mapping& mapping, bool stale, EnergySource source,
               double dt_s);
  /// The same without the passivity rules, for comparison.
  Vector3 step_naive(const ContactHandle& handle, const Mapping& mapping, bool stale);

  [[nodiscard]] double energy_j(const Vector3& x) const;  // stored in the springs
  [[nodiscard]] double paid_j() const;                    // energy from source to springs, in the last step
  /// Surfaces into which the goal is commanded, for Mapping: their force may grow by at most `rise_per_s`.
  [[nodiscard]] PressedSurfaces pressed(double rise_per_s) const;
  /// The axis with the largest force, else with the largest known stiffness, else the first.
  [[nodiscard]] const ContactAxis& foremost() const;
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool clamped() const;
  [[nodiscard]] bool yielding() const;

 private:
  using Surfaces = std::array<ReportedSurface, kSurfaces>;
  /// Returns the goal at a surface; none: its touch is too old.
  [[nodiscard]] std::optional<Vector3> goal_of(const ReportedSurface& s, const GoalHistory& history) const;
  ContactAxis* axis_of(const ReportedSurface& s);
  void forget(ContactAxis& a, const Vector3& x);
  void update(ContactAxis& a, const ReportedSurface& s, const std::optional<Vector3>& goal,
              const ContactHandle& handle, const Mapping& mapping);
  void add_axis(const ReportedSurface& s, const Vector3& goal, const ContactHandle& handle,
                const Mapping& mapping);
  [[nodiscard]] double ke(const Mapping& mapping) const;
  /// Coordinate of the handle along the axis at which it commands the goal of the touch.
  [[nodiscard]] double along(const ContactAxis& axis, const Mapping& mapping) const;
  double locate(const ContactAxis& axis, const ContactHandle& handle, const Mapping& mapping) const;

  ContactMotion motion_;
  ContactConfig config_{};
  std::array<ContactAxis, kAxes> axes_{};
};

}  // namespace longreach
