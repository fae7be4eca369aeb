#pragma once
// What of the estimate is told to the operator: the tangent of the contact's law at a depth, held. It is the
// line through the force there with the slope there, and begins at its foot, depth - F/F' behind the surface.
// Each change moves the felt wall a little, so the value appears when its sd is below `first_sd`, and then
// changes only
//   by more than max(deadband, 3 sd);
//   by more than max(2 %, 3 sd), of its own or by its direction, at most three times a touch, when its sd
//       has halved since it was taken;
//   when it is taken for another depth,
// in the Frobenius norm of S n nᵀ: a direction that was learnt better is a change as well. It never gives way
// to one that is farther from the depth that is asked for, but if it is surely wrong: over 30 % and 5 sd off
// what any power law through it has at the depth of one known to 30 %. A second touch of the same surface
// goes on with it.

#include "common/spatial/spatial.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {

class ReportedTangent {
 public:
  explicit ReportedTangent(const EstimatorConfig& config) : config_(config) {}

  void configure(const EstimatorConfig& config) { config_ = config; }
  /// A new touch; `again`: of a surface whose value still holds.
  void begin(bool again) {
    if (!again) stiffness_n_per_m_ = sd_ = depth_m_ = foot_m_ = 0.0;
    renewals_ = 0;
  }

  /// `asked_m`: depth that the value is to be for; `elsewhere`: it is another one than so far. True if the
  /// reported value has changed.
  bool step(const ContactAnswer& answer, const Vector3& normal, double asked_m, bool elsewhere);

  /// The surface is told for another place: the line keeps its slope and goes through the force that the
  /// answer has at its depth.
  void place(const ContactAnswer& answer);

  [[nodiscard]] double stiffness_n_per_m() const { return stiffness_n_per_m_; }  // 0: none yet
  [[nodiscard]] double sd() const { return sd_; }                  // of it, a fraction, as it was taken
  [[nodiscard]] double depth_m() const { return depth_m_; }        // that it belongs to
  [[nodiscard]] double foot_m() const { return foot_m_; }          // behind the surface, >= 0
  [[nodiscard]] const Vector3& normal() const { return normal_; }  // that it was taken with

 private:
  [[nodiscard]] bool surely_wrong(const ContactAnswer& answer) const;

  EstimatorConfig config_;
  double stiffness_n_per_m_ = 0.0;
  double depth_m_ = 0.0, foot_m_ = 0.0;
  Vector3 normal_ = Vector3::Zero();
  double sd_ = 0.0;
  int renewals_ = 0;  // in this touch
};

}  // namespace longreach
