#pragma once
// The state of a laboratory in one tick, as provided to Python. It is a copy, so it stays valid after the tick.

#include <optional>
#include <string>

#include "common/spatial/spatial.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach {

struct LabState {
  double time_s = 0.0;
  std::string state{};        // state of the master, as in `longreach status`
  std::string slave_state{};  // state of the slave
  std::string mode{};         // "position" or "rate"
  double scale = 1.0;
  Vector3 handle_m = Vector3::Zero(), handle_m_per_s = Vector3::Zero();  // relative to home, M
  Vector3 force_n = Vector3::Zero(), moment_nm = Vector3::Zero();        // rendered on the hand, M
  Vector3 spring_n = Vector3::Zero();  // contact force included in force_n, M
  bool surface_known = false;
  Vector3 inward = Vector3::Zero();                    // unit vector into the rendered surface, M
  double surface_m = 0.0;                              // position along `inward`, from the handle's home
  double stiffness_n_per_m = 0.0;                      // rendered stiffness
  Vector3 goal_m = Vector3::Zero();                    // relative to the anchor, W
  Eigen::Matrix4d X_WE = Eigen::Matrix4d::Identity();  // measured pose of the tool in W
  Vector3 anchor_m = Vector3::Zero();                  // anchor of this engagement, W
  Vector3 tool_n = Vector3::Zero(), tool_nm = Vector3::Zero();  // measured on the tool, W
  bool in_contact = false;                                      // contact detected by the slave
  double estimate_n_per_m = 0.0, estimate_sd_n_per_m = 0.0;     // estimate of the slave
  double reported_n_per_m = 0.0;                                // stiffness reported by the slave
  Vector3 far_m = Vector3::Zero(),
          far_n = Vector3::Zero();   // tool position and force on the tool, W, last received by the master
  bool far_contact = false;          // contact, last received by the master
  Vector3 true_n = Vector3::Zero();  // true force on the tool, W
  double true_n_per_m = 0.0;         // stiffness of the scene at the position of the rendered report
  double penetration_m = 0.0;        // true penetration of the tool
  double port_energy_j = 0.0;        // net energy from the hand into the device
  std::optional<double> round_trip_s{};
};

LabState state_of(const Laboratory& laboratory);

}  // namespace longreach
