#pragma once
// What the tool touches, in translation or in rotation: up to three surfaces at once or remembered. A touch
// begins when the force leaves the noise. The force is that of the surfaces that are pressed, each along its
// normal; what is left across them, pushes against the tool's way and is more than friction, is another one.
// A surface is remembered after its touch, so that the next one goes on with what is known, and forgotten
// when the tool feels nothing so deep behind it that it would press with twice the touch threshold; a touch
// less than 60 degrees beside it, or elsewhere along its normal, is of the same object, measured otherwise.

#include <array>
#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/estimation/surface.hpp"
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
  double uncertainty_n = 0.0;         // what of the force may be none
  double news_age_s = 0.0;            // of what the operator knew of this side when the goal was commanded
};

/// For a contact by rotation: places are rotation vectors, N are N m, m are rad.
SensingConfig rotational(SensingConfig sensing);

class SlaveContact {
 public:
  SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator);

  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void step(const ContactInput& input);

  /// Looks up, in the goals that were followed, those that lie at the surfaces.
  void locate_touches(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// The goals begin anew: what is known was met by none of them.
  void forget_goals();
  /// The sensor has lied: what it made of surfaces is not there. What presses now is none before its force
  /// has gone, or
  void forget_surfaces();
  /// begins anew.
  void restart();
  /// All places count from elsewhere.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool in_contact() const { return reading_.in_contact; }
  [[nodiscard]] std::uint32_t touch() const { return touches_; }           // counts from 1
  [[nodiscard]] const Vector3& normal() const { return reading_.normal; }  // of the whole force
  [[nodiscard]] const ContactForce& force() const { return force_; }       // for the force guard
  /// The surface that presses most; none is pressed: the one that was touched last.
  [[nodiscard]] const Surface& foremost() const { return surfaces_[foremost_]; }
  /// `anchor`: from which places count. Those that are pressed come first.
  [[nodiscard]] std::array<ReportedSurface, kSurfaces> report(const Vector3& anchor) const;

 private:
  /// Force across what is pressed.
  struct Aside {
    Vector3 p_WE = Vector3::Zero();  // tool when it was last in the noise
    double way_m = 0.0,
           share = 0.0;  // of the way against it, of the force on what is pressed, as judged last
  };

  /// A touch by `force_n`, of a surface that is known or new.
  void begin(const ContactInput& input, const Vector3& force_n, const Vector3& onset);
  Surface* place_for(const Vector3& normal, const Vector3& onset, const Vector3& tool, bool& again);
  void press(const ContactInput& input);
  void press_several(const ContactInput& input);
  void turn_several(double dt);
  void look_aside(const ContactInput& input);
  /// What of `force_n` each pressed surface bears; zero for the others.
  [[nodiscard]] Vector3 shares(const Vector3& force_n) const;
  void forget_what_is_free(const ContactInput& input);
  [[nodiscard]] std::size_t pressed() const;  // how many
  [[nodiscard]] double stiffness_along(const Vector3& n) const;

  SensingConfig sensing_;
  ContactDetector detector_;
  std::array<Surface, kSurfaces> surfaces_;
  std::size_t foremost_ = 0;
  Ring<TouchSample> before_;  // what was measured just before the touch
  ContactReading reading_{};
  ContactForce force_{};
  std::optional<Vector3> onset_{};  // tool when the force was last in the noise
  Aside aside_{};
  bool turning_ = true;  // the force's direction is that of the one surface that is pressed
  std::uint32_t touches_ = 0;
};

}  // namespace longreach
