#pragma once
// Displays the contacts of the slave: one unilateral spring per reported surface, in translation or in
// rotation. Each spring is the tangent to the contact law at the working depth. The force of the tangent is
// zero at its foot, a point behind the surface, and the spring starts there. The surface is located at the
// goal of the touch sequence. If that goal is no longer stored, the surface is located by its offset from the
// engagement's anchor.
//
//   f = -Σ n_i (f_i + d_i),   f_i = max(0, k_i (s_i - a_i)),   s_i = n_i . x,   d_i = B n_i . x', |d_i| <= f_i
//
// x is the position (m) or rotation vector (rad) of the handle in M; goals are displacements or rotation
// vectors from the engagement's anchor, in W; n_i points into the surface. When the handle is released, the
// springs fade until a hand holds it again. A spring has no force while the goal is in front of its surface
// or the clutch is pressed. While the slave still reports a surface that the tool has left, the surface is
// displayed as if the tool were pressing on it; then it fades. A spring changes its direction only while its
// force is zero.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/link/stiffness_report.hpp"
#include "common/spatial/spatial.hpp"
#include "master/mapping/mapping.hpp"
#include "master/rendering/contact_spring.hpp"
#include "master/rendering/goal_history.hpp"

namespace longreach {

class ContactLaw;

struct ContactConfig {
  ContactSpringConfig spring{};
  double ke = 1.0;
  /// True: the rendered stiffness is ke k_scale times the estimate; false: ke times the estimate.
  bool ke_by_scale = false;
  double damping = 0.0;     // B, N s/m
  bool by_arrival = false;  // place surfaces at the newest goal (comparison only)
  /// Rate mode: ratio of the force at the hand to that at the tool; 0: the deflection commands a speed, not a force.
  double rate_ratio = 0.0;
};

enum class ContactMotion : std::uint8_t { kTranslation, kRotation };

/// Current state of the handle.
struct ContactHandle {
  Vector3 x = Vector3::Zero();     // position (m) or rotation vector (rad) relative to home, M
  Vector3 rate = Vector3::Zero();  // time derivative of x
  Vector3 goal = Vector3::Zero();  // commanded goal relative to the anchor, W
  /// In rate mode, the position of the handle does not correspond to a depth in the surface. Its deflection beyond the dead
  /// zone commands a force instead.
  bool rate_mode = false;
  bool held = true;       // a hand is on the handle; otherwise the springs fade
  bool clutched = false;  // the handle moves without the robot
  bool live = true;       // otherwise the goals have no meaning and the springs are not loaded
  Vector3 deflection =
      Vector3::Zero();  // of the handle from the centre of rate mode, beyond the dead zone, M
};

/// Effect of a report.
enum class ContactChange : std::uint8_t {
  kNone,      // no change, or not enough data to place a surface yet
  kRejected,  // the values are impossible, or the touch refers to a command that this side never sent
  kUpdated,   // surfaces or stiffness have changed
};

struct ContactAxis {
  bool known = false;
  Vector3 n_W = Vector3::UnitX();  // unit vector into the surface, W
  Vector3 n_M = Vector3::UnitX();  // the same direction in M
  Vector3 goal = Vector3::Zero();  // goal at the foot of the tangent, relative to the anchor, W
  double stiffness = 0.0;          // reported stiffness, N/m
  double reported = 0.0;           // the same times ke
  double surface = 0.0;            // coordinate along n_M at which the handle is at the foot, m
  double foot = 0.0;               // depth of the foot behind the surface, in goal space, m
  double force = 0.0;              // rendered force against n_M, N
  double damper = 0.0;             // rendered force of the damper against n_M, N
  double shortened = 0.0;          // by which the depth limit has reduced their sum in the last step, N
  std::uint32_t touch = 0;         // number of the last touch of this surface
  double threshold = 0.0;          // force at the tool above which the slave detects the contact, N
  double guard = 0.0;              // limit of the force at the tool, N
  double aim = 0.0;                // rate mode: force that the deflection of the handle commands, N
  bool pressed = false;            // by the tool, as reported
  bool first = false;              // a contact has begun with this surface
  bool commands = false;           // the deflection of the handle commands the force (rate mode)
  bool let_go = false;             // the spring is faded because no hand is on the handle
  double first_at = 0.0;           // coordinate of `goal` along n_W when the surface was first reported, m
  double watched_at = 0.0;         // the same watched_s ago
  double watched_s = 0.0;
  bool comes = false;  // the surface moves towards the tool
  ContactSpring spring{ContactSpringConfig{}};

  [[nodiscard]] double s(const Vector3& x) const { return n_M.dot(x); }

  /// Returns false while the surface moves towards the tool faster than 5 mm/s, and after it has moved by 0.1 m. Then the
  /// slave alone retreats, and counts its retreat.
  [[nodiscard]] bool rests() const;
  void watch(double dt_s);
};

class Contact {
 public:
  static constexpr std::size_t kAxes = kSurfaces;
  /// Touch number of a boundary at which a limit holds the robot back. The tool presses on nothing there.
  static constexpr std::uint32_t kBoundary = std::numeric_limits<std::uint32_t>::max();

  Contact(ContactMotion motion, const ContactConfig& config) : motion_(motion) { configure(config); }
  void configure(const ContactConfig& config);
  /// Removes all surfaces. Their springs fade from `share` (0 to 1) of their force.
  void let_go(double share);

  /// Processes a report of the current engagement: updates, adds and removes springs.
  ContactChange on_report(const ContactReport& report, const GoalHistory& history,
                          const ContactHandle& handle, const Mapping& mapping);

  /// Advances the springs by `dt_s` and returns the force (N) or moment (N m) on the hand, in M. `stale`
  /// means that no datagrams are arriving; all springs then fade and are removed. `source` supplies the
  /// energy for moving spring anchors outwards.
  Vector3 step(const ContactHandle& handle, const Mapping& mapping, bool stale, EnergySource source,
               double dt_s);
  /// Same as step(), but the force is that of `law` and not that of the springs.
  Vector3 step_by(const ContactLaw& law, const ContactHandle& handle, const Mapping& mapping, bool stale);

  /// Returns the sum of the forces of the springs on the hand in the last step, in M, without the damping.
  [[nodiscard]] Vector3 spring_force() const;
  [[nodiscard]] double energy_j(const Vector3& x) const;  // energy stored in the springs, J
  [[nodiscard]] double paid_j() const;  // energy that the source supplied in the last step, J
  /// Returns by how much depth limits have reduced the force in the last step, N. A report that ends such a fall is no
  /// step.
  [[nodiscard]] double shortened_n() const;
  /// Returns the known surfaces as Mapping needs them.
  [[nodiscard]] PressedSurfaces pressed() const;
  /// Returns the axis with the largest force; if all forces are zero, the one with the largest known
  /// stiffness, or else the first.
  [[nodiscard]] const ContactAxis& foremost() const;
  /// Returns whether any surface is known.
  [[nodiscard]] bool known() const;
  /// Returns whether the stiffness of a known surface was limited to the maximum.
  [[nodiscard]] bool clamped() const;
  /// Returns whether a spring was at the force limit in the last step.
  [[nodiscard]] bool yielding() const;

 private:
  using Surfaces = std::array<ReportedSurface, kSurfaces>;
  /// Returns the goal at the foot of the tangent of `s`, or none if the goal of its touch is no longer
  /// stored.
  [[nodiscard]] std::optional<Vector3> goal_of(const ReportedSurface& s, const GoalHistory& history) const;
  ContactAxis* axis_of(const ReportedSurface& s);
  void forget(ContactAxis& a, const Vector3& x);
  void update(ContactAxis& a, const ReportedSurface& s, const std::optional<Vector3>& goal,
              const ContactHandle& handle, const Mapping& mapping);
  void add_axis(const ReportedSurface& s, const Vector3& goal, const ContactHandle& handle,
                const Mapping& mapping);
  [[nodiscard]] double ke(const Mapping& mapping) const;
  /// Returns the coordinate along the axis at which the handle commands the goal of the touch.
  [[nodiscard]] double along(const ContactAxis& axis, const Mapping& mapping) const;
  /// Returns whether the deflection of the handle commands the force of this surface in rate mode.
  [[nodiscard]] bool by_force(const ContactAxis& axis) const {
    return config_.rate_ratio > 0.0 && axis.touch != kBoundary;
  }
  /// Returns the stiffness of the spring, N/m.
  [[nodiscard]] double rendered(const ContactAxis& axis) const;
  /// Returns how fast the contact force may rise while the goal moves into a surface in rate mode, N/s or N m/s.
  [[nodiscard]] double rise(bool by_force) const;
  /// Sets the depths of the goal that the force at the hand permits in rate mode.
  void command_depth(const ContactAxis& axis, PressedSurface& surface) const;
  /// Returns the force that the deflection of the handle commands in rate mode, N.
  [[nodiscard]] double aim(const ContactAxis& axis, const ContactHandle& handle) const;
  double locate(const ContactAxis& axis, const ContactHandle& handle, const Mapping& mapping) const;

  ContactMotion motion_;
  ContactConfig config_{};
  std::array<ContactAxis, kAxes> axes_{};
  bool begun_ = false;  // a surface has been reported in this contact
};

}  // namespace longreach
