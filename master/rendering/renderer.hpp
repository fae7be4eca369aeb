#pragma once
// Everything that the hand feels: resistance of the mapping, contact by the registered surface and the
// estimated stiffness, energy accounting, limits. Sees StiffnessReports and the master's own motion, nothing
// else from afar.
//
//   F = F_behaviour + F_resistance - n max(0, k (s - a) + B n.v)      s = n . x
//
// A handle that nobody holds has no resistance, and what it does by itself remains when nothing is engaged.
// Law NAIVE applies stiffness and surface as they come, for contrast; it keeps the force limit.

#include <cstdint>

#include "common/link/stiffness_report.hpp"
#include "master/devices/handle_state.hpp"
#include "master/mapping/mapping.hpp"
#include "master/rendering/contact_spring.hpp"
#include "master/rendering/goal_history.hpp"
#include "master/rendering/port_guard.hpp"
#include "master/rendering/rendering_config.hpp"
#include "master/rendering/resistance.hpp"
#include "master/rendering/surface.hpp"

namespace longreach {

/// What of the device limits the rendering.
struct RenderedDevice {
  double handle_mass_kg = 0.2;
  double damping_n_s_per_m = 3.5;
  double period_s = 0.001;
  double delay_s = 0.0;  // from reading the handle to the torque of its motors
};

struct RendererInput {
  HandleState handle{};
  Wrench behaviour{};                 // what the handle does by itself, engaged or not
  double behaviour_j = 0.0;           // stored in its translational springs
  double behaviour_supplied_j = 0.0;  // by its anchor, in this tick
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;
  bool live = false;   // false: the wrench ramps to zero
  bool stale = false;  // nothing heard from the slave: stiffness only decays
};

class Renderer {
 public:
  Renderer(const RenderingConfig& config, const RenderedDevice& device);
  void configure(const RenderingConfig& config);

  /// Begins an engagement with every spring at rest at the handle.
  void reset(const HandleState& handle);

  /// Takes a report of the present engagement. False: refused because a value is impossible.
  bool on_report(const StiffnessReport& report, const GoalHistory& history, const RendererInput& input,
                 const Mapping& mapping);

  /// One tick. Non-finite handle values give a zero wrench.
  Wrench step(const RendererInput& input, const Mapping& mapping);

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] const ContactSpring& spring() const { return spring_; }
  [[nodiscard]] const PortGuard& guard() const { return guard_; }
  [[nodiscard]] double spring_force_n() const { return spring_force_n_; }      // against the inward normal
  [[nodiscard]] double stiffness_n_per_m() const;                              // rendered now
  [[nodiscard]] double surface_handle_m() const { return surface_handle_m_; }  // along the normal, in M
  [[nodiscard]] double force_step_n() const { return force_step_n_; }          // by the last report
  [[nodiscard]] double stored_energy_j() const { return stored_j_ + spring_.tank_j(); }

 private:
  double locate_surface(const RendererInput& input, const Mapping& mapping, double s_m) const;
  double contact_force(const RendererInput& input, double s_m);
  void account(double entered_j, const RendererInput& input, double s_m);

  RenderingConfig config_;
  RenderedDevice device_;
  Resistance resistance_;
  Surface surface_;
  ContactSpring spring_;
  PortGuard guard_;
  double naive_stiffness_ = 0.0;
  double surface_handle_m_ = 0.0;
  double spring_force_n_ = 0.0;
  double force_step_n_ = 0.0;
  double stored_j_ = 0.0;
};

}  // namespace longreach
