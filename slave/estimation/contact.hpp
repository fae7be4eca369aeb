#pragma once
// Contacts of the tool, in translation or in rotation: up to three surfaces that the tool presses on or that
// are remembered. A touch begins when the force exceeds the noise. The force is divided among the pressed
// surfaces, along the normal of each. A remainder perpendicular to these normals that opposes the motion of
// the tool and exceeds friction is attributed to a further surface, which starts with the samples of that remainder. While it
// is new, the others bear what their laws say, and it bears the rest. Known surfaces that the tool has
// reached bear from the first moment, and their normals do not turn while several are pressed.
//
// A surface is remembered after contact ends, so the next touch starts from its estimates and its normal. When there is no
// force although the tool is so deep behind the surface or behind its reported line that the force should be twice the touch
// threshold, it is moved back to the tool, in all by up to a tenth of the
// depth that was pressed, and forgotten if the tool is farther behind it. Where the tool rests, the mean force decides, and
// half of the expected one is enough as soon as the noise permits. It is also forgotten when
// a new surface has a normal within 60 degrees of its own and the tool is not in front of it, because that touch is then a new
// measurement of the same object. It is also forgotten when its force ends although the tool hardly moved back.
//
// Until the sensor is zeroed, a constant force at the start may be bias or a contact. A surface is identified
// from it in case it is a contact. Once the force has changed by the touch threshold, it counts as a contact.
// If it becomes as at the start again and the tool moves farther back, it is bias if it does not change.

#include <array>
#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/estimation/surface.hpp"
#include "slave/sensing/contact_detector.hpp"

namespace longreach {

struct ContactInput {
  Vector3 p_WE = Vector3::Zero();     // measured position of the tool, m
  Vector3 v_WE = Vector3::Zero();     // m/s
  Vector3 force_n = Vector3::Zero();  // measured force on the tool, in W
  double played_sequence = 0.0;       // sequence number of the goal being followed; 0: none
  double scale = 1.0;                 // k_scale: ratio of the force at the tool to the force at the hand
  double dt = 0.0;                    // s
  bool guarded = false;               // the force guard held the tool back in the last step
  double uncertainty_n = 0.0;         // magnitude of the uncertain part of the force
  Vector3 bias_n =
      Vector3::Zero();  // part of the force that may be sensor bias because the sensor was never zeroed
  /// Age of the operator's information about the slave when the goal was commanded, s.
  double news_age_s = 0.0;
  double coming_n_per_m = 0.0;  // stiffness of a surface that approaches the tool; 0: none approaches
};

/// Returns the parameters for a rotational contact, for which positions are rotation vectors, and N and m
/// stand for N m and rad.
SensingConfig rotational(SensingConfig sensing);

class SlaveContact {
 public:
  SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator);

  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void step(const ContactInput& input);
  /// Sets derived thresholds. Ignored while the tool is in contact.
  void set_thresholds(double touch_n, double release_n);
  /// Call this when the sensor has been zeroed. From then on, the measured force is smaller by `force_n`.
  void subtract(const Vector3& force_n) { detector_.subtract(force_n); }

  /// Finds, for each surface, the goal being followed when the tool was at the surface; `anchor` is the
  /// origin of the goals, in W.
  void locate_touches(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// Call this when the goals restart, because the new goals did not cross the known surfaces.
  void forget_goals();
  /// Forgets all surfaces because the force that they were identified from was wrong. A new surface is
  /// identified only after the current force has vanished, or after restart().
  void forget_surfaces();
  /// Forgets all surfaces and restarts the detection.
  void restart();
  /// Shifts the origin of all positions by `by`.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool in_contact() const { return reading_.in_contact; }
  [[nodiscard]] double touch_n() const { return sensing_.touch_n; }  // touch threshold, N
  [[nodiscard]] std::uint32_t touch() const { return touches_; }     // number of touches so far
  /// Unit direction of the total force.
  [[nodiscard]] const Vector3& normal() const { return reading_.normal; }
  [[nodiscard]] const ContactForce& force() const { return force_; }  // input of the force guard
  /// The surface with the largest force, or the one pressed last if no surface is pressed.
  [[nodiscard]] const Surface& foremost() const { return surfaces_[foremost_]; }
  /// Returns the surfaces for the report, pressed ones first. `anchor`: origin of their positions, in W.
  [[nodiscard]] std::array<ReportedSurface, kSurfaces> report(const Vector3& anchor) const;

 private:
  static constexpr double kOnsetShare = 0.25;  // of the touch threshold: the force has left the noise

  /// Observed force perpendicular to the normals of the pressed surfaces.
  struct Aside {
    Vector3 p_WE = Vector3::Zero();  // position of the tool when that force was last within the noise
    /// Motion of the tool against that force, and the ratio of that force to the force on the pressed surfaces,
    /// at the last evaluation.
    double way_m = 0.0, share = 0.0;
  };

  /// What the sensor measures while the tool hardly moves in free space, and the force of the reported line of each surface
  /// there: sums over the samples.
  struct Rest {
    Vector3 at_m = Vector3::Zero(), sum_n = Vector3::Zero();
    std::array<double, kSurfaces> line_n{};
    int samples = 0;
    double time_s = 0.0;
  };
  void rest(const ContactInput& input);
  /// Whether the surface should press on the tool there with a force that the sensor resolves, and does not.
  [[nodiscard]] bool disproved(std::size_t surface, const ContactInput& input) const;

  /// Starts a touch of a known or a new surface with the force `force_n`.
  void begin(const ContactInput& input, const Vector3& force_n, const Vector3& onset);
  Surface* place_for(const Vector3& normal, const Vector3& onset, const Vector3& tool, bool& again);
  void press(const ContactInput& input);
  void press_several(const ContactInput& input);
  void turn_newest(double dt);
  /// The pressed surface that was found last, if it is new; otherwise null.
  Surface* newest_new();
  void give_what_waited();  // passes the waiting samples to the next new surface
  void look_aside(const ContactInput& input);
  /// Decomposes `force_n` into forces along the normals of the pressed surfaces; the value is zero for the
  /// other surfaces.
  [[nodiscard]] Vector3 shares(const Vector3& force_n) const;
  [[nodiscard]] Vector3 shares(const Vector3& force_n, const std::array<bool, kSurfaces>& bears) const;
  /// Force that a surface bears beside the pressed ones.
  [[nodiscard]] double borne_n(std::size_t surface) const;
  /// Begins touches of the known surfaces that the tool has reached, if they explain `force_n` together with the pressed
  /// ones. Returns whether it did.
  bool reach_known(const ContactInput& input, const Vector3& force_n);
  void forget_what_is_free(const ContactInput& input);
  void suppose(const ContactInput& input);
  [[nodiscard]] Vector3 possible_bias_n(const ContactInput& input);
  /// Number of pressed surfaces.
  [[nodiscard]] std::size_t pressed() const;
  [[nodiscard]] double stiffness_along(const Vector3& n) const;

  SensingConfig sensing_;
  ContactDetector detector_;
  std::array<Surface, kSurfaces> surfaces_;
  /// Surface of the contact that the force at the start may be, and the position of the tool at the start.
  Surface supposed_;
  std::optional<Vector3> supposed_from_{};
  /// Position of the tool when the force of the known surface became as at the start.
  std::optional<Vector3> as_at_start_m_{};
  std::size_t foremost_ = 0;
  Ring<TouchSample> before_;   // samples shortly before the touch
  Ring<TouchSample> waiting_;  // samples whose force may also be of a new surface
  ContactReading reading_{};
  ContactForce force_{};
  std::optional<Vector3> onset_{};  // position of the tool when the force was last within the noise
  Aside aside_{};
  Rest rest_{};
  /// True if only one surface is pressed, so that its normal follows the direction of the force.
  bool turning_ = true;
  std::uint32_t touches_ = 0, first_touch_ = 0;  // number of touches; of the first touch of this contact
};

}  // namespace longreach
