#pragma once
// One surface that the tool presses on or has pressed on: its position, its normal, the law of its contact,
// and the reported line: the tangent, which begins at the foot, not at the surface. Depth is the motion of
// the tool, ds = -n(t)·dp, from its position at the touch. Until the fit identifies the surface, it is where
// the force first exceeded the noise. For a contact by rotation positions are rotation vectors, N are N m, m
// are rad.

#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "common/link/playout.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "slave/config/sensing_config.hpp"
#include "slave/estimation/local_tangent.hpp"
#include "slave/estimation/reported_tangent.hpp"
#include "slave/estimation/watched_identifier.hpp"
#include "slave/estimation/working_depth.hpp"

namespace longreach {

/// Measurements of a tick.
struct TouchSample {
  Vector3 p_WE = Vector3::Zero();     // tool, m
  Vector3 v_WE = Vector3::Zero();     // m/s
  Vector3 force_n = Vector3::Zero();  // on the tool, in W
};

/// Start of a touch.
struct Touch {
  std::uint32_t number = 0;
  Vector3 force_n = Vector3::Zero();  // of this surface on the tool
  Vector3 p_WE = Vector3::Zero();
  Vector3 onset = Vector3::Zero();  // position of the tool when that force was last in the noise
  double played_sequence = 0.0;     // sequence number of the followed goal; 0: none
  double scale = 1.0;               // k_scale: ratio of the force at the tool to the force at the hand
};

/// The tool on the surface in a tick.
struct Press {
  Vector3 p_WE = Vector3::Zero();
  Vector3 v_WE = Vector3::Zero();
  Vector3 outward = Vector3::UnitX();  // unit, direction of force and depth
  Vector3 force_n = Vector3::Zero();   // of this surface
  double dt = 0.0;                     // s
  bool guarded = false;                // the force guard held the tool in the last step
  double news_age_s = 0.0;             // age of the operator's information when the goal was commanded
};

class Surface {
 public:
  Surface(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);

  /// Returns whether a touch along `normal` that began between these two positions of the tool is of this
  /// surface.
  [[nodiscard]] bool crossed(const Vector3& normal, const Vector3& from, const Vector3& to) const;
  /// `again`: its values are still valid. `before`: the samples before the touch.
  void begin(const Touch& touch, bool again, const Ring<TouchSample>& before);
  void press(const Press& press);
  /// Sets the touch threshold, N.
  void set_touch(double touch_n) { touch_n_ = touch_n; }
  /// Updates the normal: the mean direction, over the last 2 s, of the part of the force on this surface.
  void turn(const Vector3& force_n, double dt);
  /// From here on another surface may press as well, which turns the force.
  void mark() { marked_m_ = inward_m_; }
  /// Another surface was found: since the mark, when the tool was at `from`, depth counts along the normal.
  void straighten(const Vector3& from) { inward_m_ = marked_m_ - normal_.dot(tool_m_ - from); }
  /// The tool has left it. Parameters that were never identified are discarded.
  void release();
  void forget() { there_ = pressed_ = known_ = false; }

  /// Finds the followed goal at the surface, as long as it is stored.
  void locate(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// The goals restart and did not cross it. From then on its position counts from the anchor.
  void forget_goals() { touch_sequence_ = played_at_touch_ = 0.0; }
  /// Shifts the origin of all positions.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool there() const { return there_; }
  [[nodiscard]] bool pressed() const { return pressed_; }
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  /// Its standard deviation, rad.
  [[nodiscard]] double normal_sd() const;
  [[nodiscard]] std::uint32_t touch() const { return touch_; }
  [[nodiscard]] double touch_sequence() const { return touch_sequence_; }
  [[nodiscard]] double depth_m() const;  // below the surface
  /// Depth of `tool` behind it.
  [[nodiscard]] double depth_of(const Vector3& tool) const { return normal_.dot(known_point_m_ - tool); }
  /// Force at the present depth and speed by the law, if that is accurately known.
  [[nodiscard]] std::optional<double> foreseen_n() const;
  /// Depth behind it at which a tool without force proves that the surface is gone.
  [[nodiscard]] double proof_depth_m() const;
  [[nodiscard]] const ReportedTangent& reported() const { return reported_; }
  /// Its position, in W.
  [[nodiscard]] const Vector3& reported_at_m() const { return reported_at_m_; }
  [[nodiscard]] ContactEstimate estimate() const;
  /// `anchor`: origin of positions.
  [[nodiscard]] ReportedSurface report(const Vector3& anchor) const;

 private:
  /// Direction of its force, which turns no more than a tool can have slid around an edge.
  struct Direction {
    Vector3 normal = Vector3::UnitX(), at_m = Vector3::Zero();  // with the position of the tool

    /// Returns `n`, or the previous direction if `n` differs too much: the zero of the sensor has then moved.
    Vector3 accepted_value(const Vector3& n, const Vector3& tool, bool known);
  };

  void identify(const Press& press);
  /// Depth at the usual force of a hand.
  [[nodiscard]] double usual_m() const;
  /// For this depth; `elsewhere`: it differs from the previous one. Returns true if the report has changed.
  bool update_report(const ContactAnswer& answer, double asked_m, bool elsewhere);
  bool beside(double surface_m);
  /// Reports the present estimate of its position from now on.
  void place();
  /// Distance of the tool along the surface.
  [[nodiscard]] double across_m(const Vector3& from) const;
  [[nodiscard]] bool possible(double surface_m) const;
  [[nodiscard]] bool well_known(const ContactAnswer& answer) const;
  /// Point of the surface below the tool, in W.
  [[nodiscard]] Vector3 point() const { return tool_m_ + (inward_m_ - surface_m_) * normal_; }

  SensingConfig sensing_;
  EstimatorConfig estimator_;
  WatchedIdentifier identifier_;
  WorkingDepth working_;
  LocalTangent local_;
  ContactAnswer local_reported_{};      // its held value
  std::uint32_t changes_ = 0;           // detected changes of the contact
  std::uint32_t reported_changes_ = 0;  // likewise, at the last report
  bool settled_ = true;                 // the requested depth belongs to the contact since then
  ReportedTangent reported_;
  double touch_n_;  // threshold, as derived: what a tool behind the surface does not feel
  Vector3 reported_at_m_ = Vector3::Zero();
  ContactAnswer answer_{};
  double speed_m_per_s_ = 0.0;  // inwards
  bool there_ = false, pressed_ = false;
  bool known_ = false;  // position and law: a touch at the same position continues with them
  Vector3 normal_ = Vector3::Zero(), sum_n_ = Vector3::Zero();
  double normal_variance_n2_ = 0.0;  // of the sum
  Vector3 known_normal_ = Vector3::Zero(), known_point_m_ = Vector3::Zero();
  double proof_m_ = 0.0;
  // As reported; held, because a disturbance of the sensor looks like a moving surface.
  Vector3 place_m_ = Vector3::Zero(), placed_at_m_ = Vector3::Zero();  // with the position of the tool
  Direction pushes_{}, reported_normal_{};
  double placed_sd_m_ = 0.0;             // its standard deviation; 0: not placed yet
  double reported_s_ = 0.0;              // since the surface was reported
  bool touched_anew_ = false;            // it was placed in a previous touch
  Vector3 tool_m_ = Vector3::Zero();     // now, or when it left the surface
  double inward_m_ = 0.0;                // its motion against the force since the touch
  double marked_m_ = 0.0;                // the value at the mark
  double least_m_ = 0.0, most_m_ = 0.0;  // its range, in this touch
  double surface_m_ = 0.0;               // position of the surface in this coordinate
  double scale_ = 1.0;
  double played_at_touch_ = 0.0;
  double touch_sequence_ = 0.0;
  std::uint32_t touch_ = 0;
};

}  // namespace longreach
