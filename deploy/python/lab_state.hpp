#pragma once
// The state of a laboratory in one tick, as Python sees it: a copy, so that it stays valid.

#include <optional>
#include <string>

#include "common/spatial/spatial.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach {

struct LabState {
  double time_s = 0.0;
  std::string state{};        // of the master, as in `longreach status`
  std::string slave_state{};  // of the slave
  std::string mode{};         // "position" or "rate"
  double scale = 1.0;
  Vector3 handle_m = Vector3::Zero(), handle_m_per_s = Vector3::Zero();  // from home, M
  Vector3 force_n = Vector3::Zero(), moment_nm = Vector3::Zero();        // on the hand, M
  Vector3 spring_n = Vector3::Zero();                                    // part of the contact in force_n, M
  bool surface_known = false;
  Vector3 inward = Vector3::Zero();                             // into the rendered surface, unit, M
  double surface_m = 0.0;                                       // along `inward`, from the handle's home
  double stiffness_n_per_m = 0.0;                               // rendered
  Vector3 goal_m = Vector3::Zero();                             // from the anchor, W
  Eigen::Matrix4d X_WE = Eigen::Matrix4d::Identity();           // measured pose of the tool in W
  Vector3 anchor_m = Vector3::Zero();                           // of this engagement, W
  Vector3 tool_n = Vector3::Zero(), tool_nm = Vector3::Zero();  // measured, on the tool, W
  bool in_contact = false;                                      // as detected by the slave
  double estimate_n_per_m = 0.0, estimate_sd_n_per_m = 0.0;     // of the slave
  double reported_n_per_m = 0.0;                                // by the slave
  Vector3 far_m = Vector3::Zero(),
          far_n = Vector3::Zero();   // position of and force on the tool, W, as last received
  bool far_contact = false;          // likewise
  Vector3 true_n = Vector3::Zero();  // on the tool, of the scene
  double true_n_per_m = 0.0;         // stiffness of the scene at the place of the rendered one
  double penetration_m = 0.0;        // of the tool, of the scene
  double port_energy_j = 0.0;        // net energy from the hand into the device
  std::optional<double> round_trip_s{};
};

LabState state_of(const Laboratory& laboratory);

}  // namespace longreach
