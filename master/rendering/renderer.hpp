#pragma once
// Computes all forces on the hand: the resistance of the mapping, and the contact forces from the registered
// surfaces and the estimated stiffness, in translation and in rotation. It also accounts for the energy and
// applies the limits. Its inputs are StiffnessReports and the motion of the master; it uses no other data
// from the slave.
//
//   F = F_behaviour + F_resistance + F_contact(x),      M = M_behaviour + M_resistance + D(φ)ᵀ M_contact(φ)
//
// φ is the rotation vector of the handle, φ' = D(φ) ω. The moment of a spring in φ uses the transpose of D,
// so that its work equals the stored energy. A released handle has no resistance. The behaviour of the handle
// (handle_behaviour.hpp) continues when disengaged.

#include <cstdint>
#include <optional>

#include "common/link/stiffness_report.hpp"
#include "master/config/rendering_config.hpp"
#include "master/devices/quantized_motion_filter.hpp"
#include "master/mapping/mapping.hpp"
#include "master/rendering/contact.hpp"
#include "master/rendering/contact_law.hpp"
#include "master/rendering/goal_history.hpp"
#include "master/rendering/port_guard.hpp"
#include "master/rendering/resistance.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Properties of the device that limit the rendering: the worst case over its workspace.
struct RenderedDevice {
  double mass_kg = 0.2;
  double damping_n_s_per_m = 3.5;
  double inertia_kg_m2 = 1e-4;
  double damping_nm_s_per_rad = 4e-4;
  double period_s = 0.001;
  double delay_s = 0.0;  // from reading the handle to the motor torque
  EncoderCell cell{};    // resolution of the measured position
  bool turns = true;     // false: the handle has no orientation, and no moment is rendered
};

/// Result of the handle's own behaviour (handle_behaviour.hpp), which is active whether engaged or not.
struct HandleBehaviourOutput {
  Vector3 force = Vector3::Zero();  // force (N) or moment (N m) on the hand, in M
  double stored_j = 0.0;            // energy in its springs
  double supplied_j = 0.0;          // energy supplied by its moving anchor in this tick
};

struct RendererInput {
  HandleState handle{};
  HandleBehaviourOutput translation{}, rotation{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;
  bool live = false;   // false: the wrench ramps to zero
  bool stale = false;  // no datagrams from the slave: the stiffness only decays
  bool load = false;   // the gripper holds a load
  bool clutched = false;
};

/// Goals of the sent commands, relative to the engagement's anchor.
struct GoalHistories {
  explicit GoalHistories(std::size_t capacity) : translation(capacity), rotation(capacity) {}
  void clear() {
    translation.clear();
    rotation.clear();
  }
  GoalHistory translation;  // displacements, m
  GoalHistory rotation;     // rotation vectors, rad
};

/// One port of the hand: its contacts, and the guard and tank that keep it passive.
struct HandPort {
  HandPort(ContactMotion motion, const ContactConfig& touch, const PortGuardConfig& limits, double tank_j,
           double cell_radius)
      : contact(motion, touch), guard(limits), tank(tank_j), cell(cell_radius) {}

  /// Starts an engagement with the handle at `x`: the springs of the previous one fade.
  void begin(const Vector3& x);

  /// Updates the energy balance with the last tick. Energy that entered or was supplied but is not stored was
  /// dissipated; if this balance is negative, energy has leaked. `force` is the commanded force. The positions
  /// have errors e of up to half a cell, and Σ f[k-1] . (e[k] - e[k-1]) = -Σ e[k] . (f[k] - f[k-1]) apart from
  /// the end terms. The balance of a tick is therefore uncertain by `cell` |f[k] - f[k-1]|, and only the part
  /// beyond this uncertainty counts. Returns the dissipated energy that did not fit into the tank, J.
  double account(double entered_j, double stored_j, double supplied_j, const Vector3& force);

  Contact contact;
  PortGuard guard;
  EnergyTank tank;
  double cell = 0.0;  // half the size of an encoder cell at the handle, m or rad
  double stored_j = 0.0;
  Vector3 force = Vector3::Zero();  // commanded force of the last tick
};

class Renderer {
 public:
  Renderer(const RenderingConfig& config, const RenderedDevice& device);
  /// Takes effect in the next step.
  void configure(const RenderingConfig& config);
  /// Renders the contacts by `law`, which must outlive the renderer; null: by the passive springs.
  void render_by(const ContactLaw* law) { law_ = law; }

  /// Starts an engagement with the handle at this position. What is left of the contact forces of the previous one
  /// fades.
  void reset(const HandleState& handle);

  /// Processes a report of the current engagement. Returns false if a value is impossible and was rejected.
  bool on_report(const StiffnessReport& report, const GoalHistories& history, const RendererInput& input,
                 const Mapping& mapping);

  /// Advances by one tick and returns the wrench on the hand, in M. The handle's values must be finite; the
  /// wrench is then finite as well.
  Wrench step(const RendererInput& input, const Mapping& mapping);

  [[nodiscard]] const HandPort& translation() const { return translation_; }
  [[nodiscard]] const HandPort& rotation() const { return rotation_; }
  /// Returns whether any surface is rendered.
  [[nodiscard]] bool felt() const { return translation_.contact.known() || rotation_.contact.known(); }
  /// Returns the rendered stiffness of the axis with the largest force, N/m or N m/rad.
  [[nodiscard]] double stiffness(const HandPort& port) const;
  /// Returns the maximum stiffness that can be rendered: the smaller of the configured value and the limit
  /// that the damping of the device permits.
  [[nodiscard]] double stiffness_max_n_per_m() const;
  [[nodiscard]] double stiffness_max_nm_per_rad() const;
  /// Net energy from the hand into both ports.
  [[nodiscard]] double port_energy_j() const;
  /// Minimum of the port energy since the start of an engagement, over all engagements. The energy with which a released
  /// handle is moved home is not part of it.
  [[nodiscard]] double port_energy_min_j() const { return port_energy_min_j_; }
  /// Energy in the springs and tanks of both ports.
  [[nodiscard]] double stored_energy_j() const;
  /// Remaining energy of the initial store.
  [[nodiscard]] double store_j() const { return store_.level_j(); }
  /// Returns the change of the contact force in the last step caused by the reports since the previous step,
  /// N, before rate limit and clamping. It is negative if the force decreased.
  [[nodiscard]] double force_step_n() const { return force_step_n_; }

 private:
  void let_down(const RendererInput& input);
  [[nodiscard]] Vector3 refill_drag(const RendererInput& input) const;
  Vector3 translate(const RendererInput& input, const Mapping& mapping, const Vector3& resistance);
  Vector3 rotate(const RendererInput& input, const Mapping& mapping, const Vector3& resistance);
  Vector3 contact_force(Contact& contact, EnergyTank& tank, EnergyTank& store, const ContactHandle& at,
                        const Mapping& mapping, bool stale);

  RenderingConfig config_;
  RenderedDevice device_;
  const ContactLaw* law_ = nullptr;  // for comparison, in the laboratory only
  Resistance resistance_;
  HandPort translation_, rotation_;
  EnergyTank store_;                   // initial store of the engagement, shared by both ports
  std::optional<Contact> unreported_;  // translational contact without the reports of this tick
  double force_step_n_ = 0.0;
  Vector3 x_last_ = Vector3::Zero();
  Quaternion q_last_ = Quaternion::Identity();
  // Port energy at the start of the engagement; minimum of the port energy since that start, over all
  // engagements.
  double began_j_ = 0.0, port_energy_min_j_ = 0.0;
  double supplied_j_ = 0.0;  // by the behaviour of the handle since that start
  MotionMode mode_ = MotionMode::kPosition;
  bool clutched_ = false, live_ = false;  // values of the last tick
  bool begins_ = false;                   // the next step is the first of an engagement
};

}  // namespace longreach
