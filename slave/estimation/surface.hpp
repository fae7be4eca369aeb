#pragma once
// A surface that the tool presses on or pressed on before, with its position, its normal, its contact law,
// and the line that is reported for it. That line is the tangent of the force law; its force is zero at its
// foot (reported_tangent.hpp), not at the surface. The depth is the integral of the motion of the tool into
// the surface, ds = -n(t)·dp, since the touch. Until the fit identifies the surface, the point at which the
// force first exceeded the noise is used as its position. For a rotational contact, positions are rotation
// vectors, and N and m stand for N m and rad.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "common/link/playout.hpp"
#include "common/link/stiffness_report.hpp"
#include "schema/state_link.hpp"
#include "slave/config/sensing_config.hpp"
#include "slave/estimation/local_tangent.hpp"
#include "slave/estimation/reported_tangent.hpp"
#include "slave/estimation/watched_identifier.hpp"
#include "slave/estimation/working_depth.hpp"

namespace longreach {

/// Measurements of one tick.
struct TouchSample {
  Vector3 p_WE = Vector3::Zero();     // position of the tool, m
  Vector3 v_WE = Vector3::Zero();     // m/s
  Vector3 force_n = Vector3::Zero();  // measured force on the tool, in W
};

/// State at the start of a touch.
struct Touch {
  std::uint32_t number = 0;
  Vector3 force_n = Vector3::Zero();  // force of this surface on the tool
  Vector3 p_WE = Vector3::Zero();
  /// Position of the tool when that force was last within the noise.
  Vector3 onset = Vector3::Zero();
  /// Sequence number of the goal being followed; 0: none.
  double played_sequence = 0.0;
  double scale = 1.0;  // k_scale: ratio of the force at the tool to the force at the hand
};

/// Measurements of one tick in which the tool presses on the surface.
struct Press {
  Vector3 p_WE = Vector3::Zero();
  Vector3 v_WE = Vector3::Zero();
  /// Unit vector in the direction of the force; depth is measured in the opposite direction.
  Vector3 outward = Vector3::UnitX();
  Vector3 force_n = Vector3::Zero();  // force of this surface on the tool
  double dt = 0.0;                    // s
  bool guarded = false;               // the force guard held the tool back in the last step
  /// Age of the operator's information about the slave when the goal was commanded, s.
  double news_age_s = 0.0;
  double coming_n_per_m = 0.0;  // stiffness of a surface that approaches the tool; 0: it does not approach
  bool alone = false;           // no other surface has been pressed in this contact
  bool learns = true;           // the force is measured, not that of the law
};

class Surface {
 public:
  /// Cosine, 26 degrees: normals that are no farther apart are those of the same surface.
  static constexpr double kSameNormal = 0.9;

  Surface(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);

  /// Returns whether a touch with this normal, during which the tool moved from `from` to `to`, is a touch of
  /// this surface.
  [[nodiscard]] bool crossed(const Vector3& normal, const Vector3& from, const Vector3& to) const;
  /// Starts a touch. `again` is true if the surface is known and its values are still valid; `before`
  /// contains samples from before the touch.
  void begin(const Touch& touch, bool again, const Ring<TouchSample>& before);
  /// Processes one tick in which the tool presses on the surface.
  void press(const Press& press);
  /// Sets the touch threshold, N.
  void set_touch(double touch_n) { touch_n_ = touch_n; }
  /// Updates the normal, which is the mean direction of `force_n`, the force of this surface, over the last 2
  /// s.
  void turn(const Vector3& force_n, double dt);
  /// Marks the current depth. From here on another surface may also be pressed, which changes the direction
  /// of the force.
  void mark() { marked_m_ = inward_m_; }
  /// Call this when a different surface has been found. From the mark on (tool position `from`), depth is
  /// measured along the normal.
  void straighten(const Vector3& from) { inward_m_ = marked_m_ - normal_.dot(tool_m_ - from); }
  /// Ends a touch. Parameters that were not identified are discarded. The surface is forgotten if the force
  /// vanished although the tool hardly moved back, because the surface has then moved or yielded. `force_n`:
  /// magnitude of the remaining force of all surfaces.
  void release(double force_n);
  /// Moves the remembered surface back by `by_m`, because the tool is there and feels no force: a law that does not fit
  /// exactly, or a force that lags, has placed it wrongly by a part of the depth that was pressed. Returns false if that
  /// cannot be the reason: the surface has gone.
  bool moved_back(double by_m);
  void forget() { there_ = pressed_ = known_ = false; }

  /// Finds the goal that was being followed when the tool was at the surface, if the playout stores that goal
  /// and no command is missing beside it.
  void locate(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// Call this when the goals restart. The new goals did not cross the surface, so its position is reported
  /// relative to the anchor.
  void forget_goals() { touch_sequence_ = played_at_touch_ = 0.0; }
  /// Shifts the origin of all positions by `by`.
  void move_origin(const Vector3& by);

  /// True if the surface is pressed or remembered.
  [[nodiscard]] bool there() const { return there_; }
  [[nodiscard]] bool pressed() const { return pressed_; }
  /// True if the surface is pressed and its normal or its law is not known yet.
  [[nodiscard]] bool is_new() const { return pressed_ && (!known_ || turned_s_ < kTurns_s); }
  /// True if the tool has reached the known surface.
  [[nodiscard]] bool reached(const Vector3& tool) const { return known_ && depth_of(tool) > 0.0; }
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  /// Standard deviation of the normal, rad.
  [[nodiscard]] double normal_sd() const;
  [[nodiscard]] std::uint32_t touch() const { return touch_; }  // number of the last touch
  /// Fractional sequence number of the goal at the surface; 0 if none is stored.
  [[nodiscard]] double touch_sequence() const { return touch_sequence_; }
  [[nodiscard]] double depth_m() const;  // current depth of the tool, m; 0 without contact
  /// Depth of a tool position behind the known surface, m.
  [[nodiscard]] double depth_of(const Vector3& tool) const { return normal_.dot(known_point_m_ - tool); }
  /// Returns the force that the law predicts at the current depth and speed, N, or std::nullopt if the law is not known.
  [[nodiscard]] std::optional<double> foreseen_n() const;
  /// The same for another position of the tool in this touch, without the damping.
  [[nodiscard]] std::optional<double> law_n(const Vector3& tool) const;
  /// Depth behind the surface beyond which the absence of force proves that the surface is gone, m.
  [[nodiscard]] double proof_depth_m() const;
  /// Depth of a tool position behind the reported surface, which keeps the normal of its report, m, and the force of the
  /// reported line there, N.
  [[nodiscard]] double placed_depth_m(const Vector3& tool) const {
    return reported_.normal().dot(place_m_ - tool);
  }
  [[nodiscard]] double line_n(const Vector3& tool) const {
    return reported_.stiffness_n_per_m() * std::max(0.0, placed_depth_m(tool) - reported_.foot_m());
  }
  [[nodiscard]] const ReportedTangent& reported() const { return reported_; }
  /// Position to which the reported value applies, in W.
  [[nodiscard]] const Vector3& reported_at_m() const { return reported_at_m_; }
  [[nodiscard]] ContactEstimate estimate() const;
  /// Returns the surface for the report. `anchor`: origin of its position, in W.
  [[nodiscard]] ReportedSurface report(const Vector3& anchor) const;

 private:
  /// Time after which the normal of a new surface is kept while another one is pressed, too.
  static constexpr double kTurns_s = 1.0;

  /// Direction of the force. It is accepted only if the tool, by sliding around an edge, could have caused
  /// its change.
  struct Direction {
    /// Last accepted direction, and the position of the tool at that time.
    Vector3 normal = Vector3::UnitX(), at_m = Vector3::Zero();

    /// Returns `n`, or the last accepted direction if `n` differs too much from it, which indicates that the
    /// zero of the sensor has changed.
    Vector3 accepted_value(const Vector3& n, const Vector3& tool, bool known);
  };

  /// The largest force of the last moments, and the depth and the reported stiffness at that time.
  struct Pressed {
    double force_n = 0.0, inward_m = 0.0, stiffness_n_per_m = 0.0;
  };
  [[nodiscard]] bool gave_way(double force_n) const;
  void identify(const Press& press);
  void keep_law();
  /// Reports a surface of this stiffness that approaches the tool: it is where its force is the measured one.
  void come(double stiffness_n_per_m, double force_n);
  /// Depth at the usual pressing force of a hand, m.
  [[nodiscard]] double usual_m() const;
  /// Updates the report for the depth `asked_m`; `elsewhere` is true if that depth differs from the previous
  /// one. Returns true if the report changed.
  bool update_report(const ContactAnswer& answer, double asked_m, bool elsewhere);
  /// Reports the tangent that needs no force law (local_tangent.hpp). Returns true if its value changed.
  bool beside(double surface_m);
  /// Reports the current position estimate from now on.
  void place();
  /// Distance along the surface from `from` to the tool, m.
  [[nodiscard]] double across_m(const Vector3& from) const;
  /// True if the tool is not deeper behind `surface_m` than its motion in this touch can explain.
  [[nodiscard]] bool possible(double surface_m) const;
  /// True if the estimate is accurate enough for a first report.
  [[nodiscard]] bool well_known(const ContactAnswer& answer) const;
  /// Relative standard deviation below which a first value is reported.
  [[nodiscard]] double first_sd() const;
  /// Point of the surface at the foot of the perpendicular from the tool, in W.
  [[nodiscard]] Vector3 point() const { return tool_m_ + (inward_m_ - surface_m_) * normal_; }

  SensingConfig sensing_;
  EstimatorConfig estimator_;
  WatchedIdentifier identifier_;
  WorkingDepth working_;
  LocalTangent local_;
  ContactAnswer local_reported_{};      // reported tangent if no force law fits
  std::uint32_t changes_ = 0;           // number of detected changes of the contact
  std::uint32_t reported_changes_ = 0;  // value of changes_ at the last report
  /// True if the working depth was set after the last change of the contact.
  bool settled_ = true;
  ReportedTangent reported_;
  /// Current touch threshold, N; a smaller force of the surface is not detected.
  double touch_n_;
  Vector3 reported_at_m_ = Vector3::Zero();
  ContactAnswer answer_{};
  double speed_m_per_s_ = 0.0;  // speed of the tool into the surface
  bool there_ = false, pressed_ = false;
  /// True if position and law are known, so that a touch at the same position continues with them.
  bool known_ = false;
  Vector3 normal_ = Vector3::Zero(), sum_n_ = Vector3::Zero();
  double normal_variance_n2_ = 0.0;  // variance of sum_n_ along an axis
  double turned_s_ = 0.0;            // time for which the normal has been measured
  /// The law when it was last known.
  double known_k_ = 0.0, known_lambda_ = 0.0, known_n_ = 1.0;
  Vector3 known_normal_ = Vector3::Zero(), known_point_m_ = Vector3::Zero();
  /// See proof_depth_m().
  double proof_m_ = 0.0;
  double pressed_to_m_ = 0.0;  // largest depth of the tool behind the known surface in its touches
  double moved_back_m_ = 0.0;  // see moved_back()
  // Reported position, and the position of the tool at that time. Both are kept constant because a sensor
  // error would look like a moving surface.
  Vector3 place_m_ = Vector3::Zero(), placed_at_m_ = Vector3::Zero();
  Direction pushes_{}, reported_normal_{};
  double placed_sd_m_ = 0.0;   // standard deviation of the reported position; 0: none reported yet
  double reported_s_ = 0.0;    // time since the surface was first reported
  bool touched_anew_ = false;  // the position was reported in a previous touch
  /// Current position of the tool, or its position when it left the surface.
  Vector3 tool_m_ = Vector3::Zero();
  double inward_m_ = 0.0;                // motion of the tool against the force since the touch
  double marked_m_ = 0.0;                // value of inward_m_ at the mark
  double least_m_ = 0.0, most_m_ = 0.0;  // range of inward_m_ in this touch
  double surface_m_ = 0.0;               // position of the surface along the same coordinate
  bool coming_ = false;                  // the surface approached in the last step
  bool alone_ = false;                   // no other surface has been pressed in this contact
  double still_at_m_ = 0.0,
         still_s_ = 0.0;  // value of inward_m_ since which the tool is at rest, and for how long
  Pressed lately_{};
  double scale_ = 1.0;
  double played_at_touch_ = 0.0;
  double touch_sequence_ = 0.0;
  std::uint32_t touch_ = 0;
};

}  // namespace longreach
