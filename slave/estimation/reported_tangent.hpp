#pragma once
// The part of the estimate that is reported to the operator: the tangent of the contact law at a depth, held
// constant between changes. It is the line through the force at that depth with the local slope, and begins
// at its foot, depth - F/F' behind the surface. Each change moves the displayed wall slightly, so the value
// appears when its sd is below `first_sd`, and then changes only
//   by more than max(deadband, 3 sd);
//   by more than max(2 %, 3 sd), of the value or of its direction, at most three times per touch, when its sd
//       has halved since the last change;
//   when it is computed for another depth,
// in the Frobenius norm of S n nᵀ: a more accurate direction is a change as well. A value is never replaced
// by one that is farther from the requested depth, unless it is certainly wrong: by over 30 % and 5 sd from
// any power law through it at the depth of a value known within 30 %. A second touch of the same surface
// continues with it.

#include "common/spatial/spatial.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {

class ReportedTangent {
 public:
  explicit ReportedTangent(const EstimatorConfig& config) : config_(config) {}

  void configure(const EstimatorConfig& config) { config_ = config; }
  /// Starts a touch; `again`: of a surface whose value is still valid.
  void begin(bool again) {
    if (!again) stiffness_n_per_m_ = sd_ = depth_m_ = foot_m_ = 0.0;
    renewals_ = 0;
  }

  /// `asked_m`: requested depth of the value; `elsewhere`: it differs from the previous one. Returns true if
  /// the reported value has changed.
  bool step(const ContactAnswer& answer, const Vector3& normal, double asked_m, bool elsewhere);

  /// The surface is reported at another position: the line keeps its slope and passes through the force of
  /// the answer at its depth.
  void place(const ContactAnswer& answer);

  [[nodiscard]] double stiffness_n_per_m() const { return stiffness_n_per_m_; }  // 0: none yet
  [[nodiscard]] double sd() const { return sd_; }  // its standard deviation as a fraction, at the last change
  [[nodiscard]] double depth_m() const { return depth_m_; }        // its depth
  [[nodiscard]] double foot_m() const { return foot_m_; }          // behind the surface, >= 0
  [[nodiscard]] const Vector3& normal() const { return normal_; }  // at the last change

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
