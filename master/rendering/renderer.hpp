#pragma once
// All forces on the hand: resistance of the mapping, contact by the registered surfaces and the estimated
// stiffness, in translation and in rotation; energy accounting, limits. Its inputs are StiffnessReports and
// the motion of the master; it uses no other data of the slave.
//
//   F = F_behaviour + F_resistance + F_contact(x),      M = M_behaviour + M_resistance + D(φ)ᵀ M_contact(φ)
//
// φ is the rotation vector of the handle, φ' = D(φ) ω: the moment of a spring in φ uses the transpose, so
// that its work equals its stored energy. A released handle has no resistance, and its behaviour continues
// when disengaged. Law NAIVE applies stiffness and surfaces as they arrive, for comparison; it keeps the
// limits.

#include <cstdint>
#include <optional>

#include "common/link/stiffness_report.hpp"
#include "master/config/rendering_config.hpp"
#include "master/devices/handle_state.hpp"
#include "master/devices/quantized_motion_filter.hpp"
#include "master/mapping/mapping.hpp"
#include "master/rendering/contact.hpp"
#include "master/rendering/goal_history.hpp"
#include "master/rendering/port_guard.hpp"
#include "master/rendering/resistance.hpp"

namespace longreach {

/// Limits of the rendering by the device: the minimum over its workspace.
struct RenderedDevice {
  double mass_kg = 0.2;
  double damping_n_s_per_m = 3.5;
  double inertia_kg_m2 = 1e-4;
  double damping_nm_s_per_rad = 4e-4;
  double period_s = 0.001;
  double delay_s = 0.0;  // from reading the handle to the torque of its motors
  EncoderCell cell{};    // cell within which a measured position is uncertain
};

/// Behaviour of the handle, engaged or not.
struct HandleBehaviourOutput {
  Vector3 force = Vector3::Zero();  // or moment
  double stored_j = 0.0;            // in its springs
  double supplied_j = 0.0;          // by its anchor, in this tick
};

struct RendererInput {
  HandleState handle{};
  HandleBehaviourOutput translation{}, rotation{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;
  bool live = false;   // false: the wrench ramps to zero
  bool stale = false;  // no datagrams from the slave: the stiffness only decays
  bool load = false;   // there is a load in the gripper
  bool clutched = false;
};

/// Goals of the sent commands.
struct GoalHistories {
  explicit GoalHistories(std::size_t capacity) : translation(capacity), rotation(capacity) {}
  void clear() {
    translation.clear();
    rotation.clear();
  }
  GoalHistory translation;  // displacements, m
  GoalHistory rotation;     // rotation vectors, rad
};

/// One port of the hand: its contacts, and the means that keep it passive.
struct HandPort {
  HandPort(ContactMotion motion, const ContactConfig& touch, const PortGuardConfig& limits, double tank_j,
           double cell_radius)
      : contact(motion, touch), guard(limits), tank(tank_j), cell(cell_radius) {}

  /// Records the energy of the last tick: energy that entered and was neither stored nor supplied has been
  /// dissipated, or has leaked if negative; only the certain part counts. `force` is the commanded force. The
  /// sum uses measured positions with errors e of up to half a cell: Σ f[k-1] . (e[k] - e[k-1]) = -Σ e[k] .
  /// (f[k] - f[k-1]) except for the ends, so that a tick is uncertain by `cell` |f[k] - f[k-1]|. Returns the
  /// dissipated energy that did not fit into the tank, J.
  double account(double entered_j, double stored_j, double supplied_j, const Vector3& force);

  Contact contact;
  PortGuard guard;
  EnergyTank tank;
  double cell = 0.0;  // half of it, m or rad
  double stored_j = 0.0;
  Vector3 force = Vector3::Zero();  // of the last tick
};

class Renderer {
 public:
  Renderer(const RenderingConfig& config, const RenderedDevice& device);
  void configure(const RenderingConfig& config);

  /// Starts an engagement with all springs at rest at the handle.
  void reset(const HandleState& handle);

  /// Processes a report of the present engagement. Returns false if it is refused because a value is
  /// impossible.
  bool on_report(const StiffnessReport& report, const GoalHistories& history, const RendererInput& input,
                 const Mapping& mapping);

  /// One tick; the values of the handle are finite, and so is the wrench.
  Wrench step(const RendererInput& input, const Mapping& mapping);

  [[nodiscard]] const HandPort& translation() const { return translation_; }
  [[nodiscard]] const HandPort& rotation() const { return rotation_; }
  /// Rendered stiffness of the foremost axis.
  [[nodiscard]] double stiffness(const HandPort& port) const;
  /// Maximum rendered stiffness: of the configuration, and of the device, whose damping bounds it.
  [[nodiscard]] double stiffness_max_n_per_m() const;
  [[nodiscard]] double stiffness_max_nm_per_rad() const;
  [[nodiscard]] double port_energy_j() const;
  [[nodiscard]] double port_energy_min_j() const { return port_energy_min_j_; }
  [[nodiscard]] double stored_energy_j() const;
  [[nodiscard]] double store_j() const { return store_.level_j(); }
  /// Change of the contact force on the hand by the reports that were processed before the last step, N;
  /// before slew and limits. Negative: a decrease.
  [[nodiscard]] double force_step_n() const { return force_step_n_; }

  // Maximum rate of the force into a pressed surface in rate mode.
  static constexpr double kRise_n_per_s = 10.0, kRise_nm_per_s = 0.2;

 private:
  void let_down(const RendererInput& input);
  [[nodiscard]] Vector3 refill_drag(const RendererInput& input) const;
  Vector3 translate(const RendererInput& input, const Mapping& mapping, const Vector3& resistance);
  Vector3 rotate(const RendererInput& input, const Mapping& mapping, const Vector3& resistance);
  Vector3 contact_force(Contact& contact, EnergyTank& tank, EnergyTank& store, const ContactHandle& at,
                        const Mapping& mapping, bool stale);

  RenderingConfig config_;
  RenderedDevice device_;
  Resistance resistance_;
  HandPort translation_, rotation_;
  EnergyTank store_;                   // of the engagement, for both ports
  std::optional<Contact> unreported_;  // of translation, without the reports of this tick
  double force_step_n_ = 0.0;
  Vector3 x_last_ = Vector3::Zero();
  Quaternion q_last_ = Quaternion::Identity();
  double began_j_ = 0.0, port_energy_min_j_ = 0.0;  // at the engagement; since the start of an engagement
  MotionMode mode_ = MotionMode::kPosition;
  bool clutched_ = false, live_ = false;  // in the last tick
  bool begins_ = false;                   // an engagement starts with the next step
};

}  // namespace longreach
