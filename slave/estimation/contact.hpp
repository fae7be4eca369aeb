#pragma once
// Contacts of the tool, in translation or in rotation: up to three surfaces, pressed or remembered. A touch
// begins when the force exceeds the noise. The force is attributed to the pressed surfaces, each along its
// normal; a remainder across them that opposes the motion of the tool and exceeds friction is a further
// surface. A surface is remembered after its touch, so that the next touch continues with its values. It is
// discarded when the tool moves without force so deep behind it that it would press with twice the touch
// threshold; a touch less than 60 degrees beside it, or elsewhere along its normal, is of the same object,
// measured differently.

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
  double played_sequence = 0.0;       // sequence number of the followed goal; 0: none
  double scale = 1.0;                 // k_scale: ratio of the force at the tool to the force at the hand
  double dt = 0.0;                    // s
  bool guarded = false;               // the force guard held the tool in the last step
  double uncertainty_n = 0.0;         // uncertain part of the force
  Vector3 bias_n =
      Vector3::Zero();      // part of the force that may be the bias of a sensor before its first zero
  double news_age_s = 0.0;  // age of the operator's information about this side when the goal was commanded
};

/// For a contact by rotation: positions are rotation vectors, N are N m, m are rad.
SensingConfig rotational(SensingConfig sensing);

class SlaveContact {
 public:
  SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator);

  void configure(const SensingConfig& sensing, const EstimatorConfig& estimator);
  void step(const ContactInput& input);
  /// As derived from the noise. Not while something is touched: then they stay.
  void set_thresholds(double touch_n, double release_n);
  /// The sensor has been zeroed: its force is smaller by this from now on.
  void subtract(const Vector3& force_n) { detector_.subtract(force_n); }

  /// Finds the followed goals that are at the surfaces.
  void locate_touches(const Playout& playout, const Vector3& anchor, double played_sequence);
  /// The goals restart: they did not cross the known surfaces.
  void forget_goals();
  /// The sensor was faulty: surfaces from its force are discarded. The present force is not a surface until
  /// it has vanished, or
  void forget_surfaces();
  /// restarts.
  void restart();
  /// Shifts the origin of all positions.
  void move_origin(const Vector3& by);

  [[nodiscard]] bool in_contact() const { return reading_.in_contact; }
  [[nodiscard]] std::uint32_t touch() const { return touches_; }           // counts from 1
  [[nodiscard]] const Vector3& normal() const { return reading_.normal; }  // of the whole force
  [[nodiscard]] const ContactForce& force() const { return force_; }       // for the force guard
  /// The surface with the largest force; if none is pressed, the last one.
  [[nodiscard]] const Surface& foremost() const { return surfaces_[foremost_]; }
  /// `anchor`: origin of positions. Pressed surfaces come first.
  [[nodiscard]] std::array<ReportedSurface, kSurfaces> report(const Vector3& anchor) const;

 private:
  /// Force across the pressed surfaces.
  struct Aside {
    Vector3 p_WE = Vector3::Zero();  // position of the tool when that force was last in the noise
    double way_m = 0.0,
           /// share of the motion against it, and of the force on the pressed surfaces, as last evaluated
        share = 0.0;
  };

  /// Starts a touch by `force_n`, of a known or new surface.
  void begin(const ContactInput& input, const Vector3& force_n, const Vector3& onset);
  Surface* place_for(const Vector3& normal, const Vector3& onset, const Vector3& tool, bool& again);
  void press(const ContactInput& input);
  void press_several(const ContactInput& input);
  void turn_several(double dt);
  void look_aside(const ContactInput& input);
  /// The part of `force_n` on each pressed surface; zero for the others.
  [[nodiscard]] Vector3 shares(const Vector3& force_n) const;
  void forget_what_is_free(const ContactInput& input);
  [[nodiscard]] std::size_t pressed() const;  // number of pressed surfaces
  [[nodiscard]] double stiffness_along(const Vector3& n) const;

  SensingConfig sensing_;
  ContactDetector detector_;
  std::array<Surface, kSurfaces> surfaces_;
  std::size_t foremost_ = 0;
  Ring<TouchSample> before_;  // samples just before the touch
  ContactReading reading_{};
  ContactForce force_{};
  std::optional<Vector3> onset_{};  // position of the tool when the force was last in the noise
  Aside aside_{};
  bool turning_ = true;  // the direction of the force is that of the only pressed surface
  std::uint32_t touches_ = 0;
};

}  // namespace longreach
