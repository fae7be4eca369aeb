#pragma once
// One surface that the tool presses on or has pressed on: where it is, which way it pushes, the law of its
// contact, and the line that is told of that law: its tangent, which begins at the foot, not at the surface.
// Depth counts along the tool's way, ds = -n(t)·dp, from where it was at the touch. Until the fit knows the
// surface, it is where the force first left the noise. Of a contact by rotation places are rotation vectors,
// N are N m, m are rad.

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

/// What was measured in a tick.
struct TouchSample {
  Vector3 p_WE = Vector3::Zero();     // tool, m
  Vector3 v_WE = Vector3::Zero();     // m/s
  Vector3 force_n = Vector3::Zero();  // on the tool, in W
};

/// A touch begins.
struct Touch {
  std::uint32_t number = 0;
  Vector3 force_n = Vector3::Zero();  // of this surface on the tool
  Vector3 p_WE = Vector3::Zero();
  Vector3 onset = Vector3::Zero();  // tool when that force was last in the noise
  double played_sequence = 0.0;     // of the goal that is followed; 0: none
  double scale = 1.0;               // k_scale: a force at the hand is this much at the tool
};

/// The tool on the surface, a tick.
struct Press {
  Vector3 p_WE = Vector3::Zero();
  Vector3 v_WE = Vector3::Zero();
  Vector3 outward = Vector3::UnitX();  // unit, along which force and depth count
  Vector3 force_n = Vector3::Zero();   // of this surface
  double dt = 0.0;                     // s
  bool guarded = false;                // the force guard held the tool in the last step
  double news_age_s = 0.0;             // of what the operator knew when the goal was commanded
};

class Surface {
 public:
  Surface(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);

  /// A touch that pushes along `normal`, and began between these two places of the tool, is of this surface.
  [[nodiscard]] bool crossed(const Vector3& normal, const Vector3& from, const Vector3& to) const;
  /// `again`: what is known of it holds. `before`: the samples up to the touch.
  void begin(const Touch& touch, bool again, const Ring<TouchSample>& before);
  void press(const Press& press);
  /// What of the measured force is this surface's: its direction, over the last 2 s, is the normal.
  void turn(const Vector3& force_n, double dt);
  /// From here on another surface may push as well, which turns the force.
  void mark() { marked_m_ = inward_m_; }
  /// There is one: since the mark, when the tool was `from`, depth counts along the normal.
  void straighten(const Vector3& from) { inward_m_ = marked_m_ - normal_.dot(tool_m_ - from); }
  /// The tool has left it. What was never identified is forgotten.
  void release();
  void forget() { there_ = pressed_ = known_ = false; }

  /// Looks up, in the goals that were followed, the one that lies at the surface, as long as they are
  /// remembered.
  void locate(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// The goals begin anew: none of them met it. From then on its place counts from the anchor.
  void forget_goals() { touch_sequence_ = played_at_touch_ = 0.0; }
  /// All places count from elsewhere.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool there() const { return there_; }
  [[nodiscard]] bool pressed() const { return pressed_; }
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  /// That it is known to, rad.
  [[nodiscard]] double normal_sd() const;
  [[nodiscard]] std::uint32_t touch() const { return touch_; }
  [[nodiscard]] double touch_sequence() const { return touch_sequence_; }
  [[nodiscard]] double depth_m() const;  // below the surface
  /// How deep behind it `tool` is.
  [[nodiscard]] double depth_of(const Vector3& tool) const { return normal_.dot(known_point_m_ - tool); }
  /// Force at the present depth and speed by the law, where that is well known.
  [[nodiscard]] std::optional<double> foreseen_n() const;
  /// How deep behind it a tool that feels nothing proves that it has gone.
  [[nodiscard]] double proof_depth_m() const;
  [[nodiscard]] const ReportedTangent& reported() const { return reported_; }
  /// Where that is, in W.
  [[nodiscard]] const Vector3& reported_at_m() const { return reported_at_m_; }
  [[nodiscard]] ContactEstimate estimate() const;
  /// `anchor`: from which places count.
  [[nodiscard]] ReportedSurface report(const Vector3& anchor) const;

 private:
  /// Of its force, which turns no more than a tool can have slid round an edge.
  struct Direction {
    Vector3 normal = Vector3::UnitX(), at_m = Vector3::Zero();  // with the tool there

    /// `n`, or what it was before where it turns further: then the sensor's zero has moved.
    Vector3 accepted_value(const Vector3& n, const Vector3& tool, bool known);
  };

  void identify(const Press& press);
  /// Depth of the force that a hand usually presses with.
  [[nodiscard]] double usual_m() const;
  /// For this depth; `elsewhere`: another one than so far. True if what is told has changed.
  bool update_report(const ContactAnswer& answer, double asked_m, bool elsewhere);
  bool beside(double surface_m);
  /// What is known of its place is told from now on.
  void place();
  /// How far the tool has gone along the surface.
  [[nodiscard]] double across_m(const Vector3& from) const;
  [[nodiscard]] bool possible(double surface_m) const;
  [[nodiscard]] bool well_known(const ContactAnswer& answer) const;
  /// Of the surface, beneath the tool, in W.
  [[nodiscard]] Vector3 point() const { return tool_m_ + (inward_m_ - surface_m_) * normal_; }

  SensingConfig sensing_;
  EstimatorConfig estimator_;
  WatchedIdentifier identifier_;
  WorkingDepth working_;
  LocalTangent local_;
  ContactAnswer local_reported_{};      // of that, held
  std::uint32_t changes_ = 0;           // of the contact, that were found
  std::uint32_t reported_changes_ = 0;  // likewise, when it was told
  bool settled_ = true;                 // the depth that is asked for is one of the contact since then
  ReportedTangent reported_;
  Vector3 reported_at_m_ = Vector3::Zero();
  ContactAnswer answer_{};
  double speed_m_per_s_ = 0.0;  // inwards
  bool there_ = false, pressed_ = false;
  bool known_ = false;  // place and law: a touch at the same place goes on with them
  Vector3 normal_ = Vector3::Zero(), sum_n_ = Vector3::Zero();
  double normal_variance_n2_ = 0.0;  // of the sum
  Vector3 known_normal_ = Vector3::Zero(), known_point_m_ = Vector3::Zero();
  double proof_m_ = 0.0;
  // As told; held, since a force of the sensor's own looks like a surface that moves.
  Vector3 place_m_ = Vector3::Zero(), placed_at_m_ = Vector3::Zero();  // with the tool there
  Direction pushes_{}, reported_normal_{};
  double placed_sd_m_ = 0.0;             // that it was known to; 0: not yet
  double reported_s_ = 0.0;              // since the surface was told
  bool touched_anew_ = false;            // it was placed in a touch before
  Vector3 tool_m_ = Vector3::Zero();     // now, or when it was left
  double inward_m_ = 0.0;                // its way against the force since the touch
  double marked_m_ = 0.0;                // that at the mark
  double least_m_ = 0.0, most_m_ = 0.0;  // of it, in this touch
  double surface_m_ = 0.0;               // where the surface is on that way
  double scale_ = 1.0;
  double played_at_touch_ = 0.0;
  double touch_sequence_ = 0.0;
  std::uint32_t touch_ = 0;
};

}  // namespace longreach
