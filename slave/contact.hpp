#pragma once
// One contact from touch to release: detection, identification, what is reported of it, and which command it
// was met at. Depth counts along the tool's way, ds = -n(t)·dp, from where it was at the touch. Until the fit
// knows the surface, it is where the force first left the noise.

#include <cstdint>

#include "common/core/ring.hpp"
#include "common/link/playout.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/estimation/reported_stiffness.hpp"
#include "slave/estimation/watched_identifier.hpp"
#include "slave/estimation/working_depth.hpp"
#include "slave/sensing/contact_detector.hpp"

namespace longreach {

struct ContactInput {
  Vector3 p_WE = Vector3::Zero();     // measured tool, m
  Vector3 v_WE = Vector3::Zero();     // m/s
  Vector3 force_n = Vector3::Zero();  // measured, in W, on the tool
  double played_sequence = 0.0;       // of the goal that is followed; 0: none
  double scale = 1.0;                 // k_scale: a force at the hand is this much at the tool
  double dt = 0.0;                    // s
  bool guarded = false;               // the force guard held the tool in the last step
  double doubt_n = 0.0;               // what of the force may be none
};

/// For a contact by rotation: places are rotation vectors, N are N m, m are rad.
SensingConfig rotational(SensingConfig sensing);
EstimatorConfig rotational(EstimatorConfig estimator);

class SlaveContact {
 public:
  SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator);

  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void step(const ContactInput& input);

  /// Looks up, in the goals that were followed, the one that lies at the surface. While the history reaches
  /// back.
  void locate_touch(const Playout& playout, const Vector3& anchor_m, double played_sequence);
  /// The goals begin anew: the present contact was met by none of them and counts from the first.
  void forget_goals() { touch_sequence_ = played_at_touch_ = 0.0; }
  /// All places count from elsewhere.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool in_contact() const { return reading_.in_contact; }
  [[nodiscard]] std::uint32_t touch() const { return touch_; }  // counts from 1
  [[nodiscard]] const Vector3& normal() const { return reading_.normal; }
  [[nodiscard]] double touch_sequence() const { return touch_sequence_; }  // fractional; 0: none
  [[nodiscard]] double reported_n_per_m() const { return reported_.stiffness_n_per_m(); }
  [[nodiscard]] double reported_depth_m() const { return reported_.depth_m(); }
  /// Where that is, in W.
  [[nodiscard]] const Vector3& reported_at_m() const { return reported_at_m_; }
  [[nodiscard]] double penetration_m() const { return penetration_m_; }  // below the estimated surface
  /// No goal of the engagement met it.
  [[nodiscard]] bool older() const { return reading_.in_contact && played_at_touch_ <= 0.0; }
  /// Of the surface, beneath the tool, in W.
  [[nodiscard]] Vector3 surface_point() const { return tool_m_ + (inward_m_ - surface_m_) * reading_.normal; }
  [[nodiscard]] const ContactForce& force() const { return force_; }  // for the force guard
  [[nodiscard]] ContactEstimate estimate() const;
  [[nodiscard]] ContactStiffness report() const;

 private:
  void begin(const ContactInput& input);
  struct Before {  // the touch
    Vector3 p_WE, v_WE, force_n;
  };
  PenetrationSample sample(const ContactInput& input);
  void identify(const ContactInput& input);
  [[nodiscard]] double proof_depth_m() const;
  [[nodiscard]] bool well_known(const ContactAnswer& answer) const;

  SensingConfig sensing_;
  EstimatorConfig estimator_;
  ContactDetector detector_;
  WatchedIdentifier identifier_;
  WorkingDepth working_;
  double working_force_n_ = 1.0;  // at the tool
  std::uint32_t changes_ = 0;     // of the contact, that were found
  ReportedStiffness reported_;
  ContactAnswer answer_{};
  Ring<Before> before_;  // what was measured just before the touch
  ContactReading reading_{};
  ContactForce force_{};
  Vector3 onset_m_ = Vector3::Zero();  // tool when the force was last in the noise
  // The surface as identified last: a touch at the same place goes on with what is known of it.
  bool known_ = false;
  Vector3 known_normal_ = Vector3::Zero();
  Vector3 known_point_m_ = Vector3::Zero();
  Vector3 tool_m_ = Vector3::Zero();     // now, or at the last contact
  double inward_m_ = 0.0;                // its way against the force since the touch
  double surface_m_ = 0.0;               // where the surface is on that way
  Matrix3 stiffness_ = Matrix3::Zero();  // as reported
  Vector3 reported_at_m_ = Vector3::Zero();
  double penetration_m_ = 0.0;
  double played_at_touch_ = 0.0;
  double touch_sequence_ = 0.0;
  std::uint32_t touch_ = 0;
};

}  // namespace longreach
