#pragma once
// What the slave has met, felt by the hand: up to three unilateral springs along the principal axes of the
// reported stiffness tensor, in translation or in rotation. Learnt from stiffness reports alone: the axes are
// those of the tensor, their sense that of the operator's own motion up to the touch sequence, the place of a
// surface the goal at that sequence.
//
//   f = -Σ n_i max(0, k_i (s_i - a_i) + B n_i . x'),   s_i = n_i . x
//
// x is the handle's position (m) or rotation vector (rad) in M; goals are displacements or rotation vectors
// from the engagement's anchor, in W. On a handle that is let go the springs fade, until a hand holds it
// again. While the goal lies in front of a surface, or the clutch is pressed, its spring has no force. A
// surface is remembered after the contact ends, so that the next touch is felt without delay, and removed by
// evidence: when the slave reports a tool that touches nothing where the surface would press with twice
// the touch threshold. An axis changes its direction only without force; a spring whose axis is not in the
// tensor any more fades.

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
  bool ke_by_scale = false;     // rendered is ke k_scale of what is estimated, else ke of it
  double damping = 0.0;         // B, N s/m
  double forget_depth = 0.005;  // behind a surface whose law is not known, m
  double place_error = 5e-5;    // of a surface and of the tool, at the most, m
  bool by_arrival = false;      // surfaces lie at the newest goal, for contrast
  double least_motion = 1e-4;   // from which the sense of an axis is believed, m
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
  kRejected,  // not finite, or a touch that this side never commanded, or too long ago to place it
  kUpdated,   // surfaces or stiffness
};

struct ContactAxis {
  bool known = false;
  Vector3 n_W = Vector3::UnitX();  // inward, unit
  Vector3 n_M = Vector3::UnitX();  // the same in M
  Vector3 goal = Vector3::Zero();  // at the touch
  // A tool that touches nothing so deep behind the surface proves that it has gone, m.
  double proof_depth = 0.0;
  double reported = 0.0;  // that times ke, N/m
  double surface = 0.0;   // handle's coordinate along n_M, m
  double force = 0.0;     // rendered, against n_M, N
  std::uint32_t touch = 0;
  bool released = false;  // since the surface was placed
  bool let_go = false;    // the spring has faded, since nobody holds the handle
  ContactSpring spring{ContactSpringConfig{}};

  [[nodiscard]] double s(const Vector3& x) const { return n_M.dot(x); }
};

class Contact {
 public:
  static constexpr int kAxes = 3;

  Contact(ContactMotion motion, const ContactConfig& config) : motion_(motion) { configure(config); }
  void configure(const ContactConfig& config);
  void reset();

  /// Takes a report of the present engagement.
  ContactChange on_report(const ContactStiffness& contact, const GoalHistory& history,
                          const ContactHandle& handle, const Mapping& mapping);

  /// One tick; `stale`: nothing has been heard, everything fades and is forgotten. Force on the hand.
  Vector3 step(const ContactHandle& handle, const Mapping& mapping, bool stale, Purse purse, double dt_s);
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
  [[nodiscard]] double force_step() const { return force_step_; }  // of the springs, by the last report

 private:
  /// `goal`: at the touch, none if that was too long ago; what is known goes on without it.
  bool take_tensor(const ContactStiffness& contact, const std::optional<Vector3>& goal, const Vector3& motion,
                   const ContactHandle& handle, const Mapping& mapping);
  void forget_what_is_free(const Vector3& place, const Vector3& x);
  void forget_beside(const Vector3& n_W, const Vector3& x);
  void add_axis(const Vector3& n_W, const ContactStiffness& contact, const Vector3& goal,
                const ContactHandle& handle, const Mapping& mapping, double stiffness);
  [[nodiscard]] double proof_depth(const ContactStiffness& contact) const;
  [[nodiscard]] double ke(const Mapping& mapping) const;
  /// Handle's coordinate along the axis where it commands the goal at the touch.
  [[nodiscard]] double along(const ContactAxis& axis, const Mapping& mapping) const;
  double locate(const ContactAxis& axis, const ContactHandle& handle, const Mapping& mapping) const;
  [[nodiscard]] Vector3 spring_force(const Vector3& x) const;
  /// `n` or -n; zero where nothing tells.
  [[nodiscard]] Vector3 inward(const Vector3& n, const Vector3& motion) const;

  ContactMotion motion_;
  ContactConfig config_{};
  std::array<ContactAxis, kAxes> axes_{};
  std::array<Vector3, kAxes> met_{Vector3::Zero(), Vector3::Zero(),
                                  Vector3::Zero()};  // inward normals before
  double force_step_ = 0.0;
};

}  // namespace longreach
