#pragma once
// The part of the estimate that is reported to the operator: the tangent of the contact law at a depth, held
// constant between changes. It is the line through the force F at that depth with the local slope F'. The
// point at which this line has zero force is called its foot, and it lies depth - F/F' behind the surface.
// Each change moves the displayed wall slightly. Therefore the first value is reported only when its relative sd is
// below a limit (`first_sd` of the configuration; more while the tool is at rest), and the value then changes only
//   if it differs by more than max(deadband, 3 sd);
//   if its sd has halved since the last change and it differs by more than max(2 %, 3 sd) in value or
//       direction, at most three times per touch;
//   or if it is computed for another depth.
// Differences are in the Frobenius norm of S n nᵀ, so a more accurate direction also counts as a change. A
// new value that is farther from the requested depth, or whose sd exceeds that limit, replaces the held value
// only if the held value is certainly wrong. That is the case if the sd of the new value is below 30 % and
// the new value deviates by more than 30 % and 5 sd from every slope that a power law through the held value
// permits. A second touch of the same surface continues with the held value.

#include "common/spatial/spatial.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {

class ReportedTangent {
 public:
  explicit ReportedTangent(const EstimatorConfig& config) : config_(config) {}

  void configure(const EstimatorConfig& config) { config_ = config; }
  /// Starts a touch. `again` is true if the surface is known and its value is still valid.
  void begin(bool again) {
    if (!again) stiffness_n_per_m_ = sd_ = depth_m_ = foot_m_ = 0.0;
    renewals_ = 0;
  }

  /// Updates the value from an estimate. `asked_m` is the requested depth of the value; `elsewhere` is true
  /// if that depth differs from the previous one; `first_sd` is the relative sd that a value may have. Returns true if
  /// the reported value changed.
  bool step(const ContactAnswer& answer, const Vector3& normal, double asked_m, bool elsewhere,
            double first_sd);

  /// Call this when the surface is reported at another position. The line keeps its slope and is moved so
  /// that it passes through the depth and force of `answer`.
  void place(const ContactAnswer& answer);

  [[nodiscard]] double stiffness_n_per_m() const { return stiffness_n_per_m_; }  // 0: no value yet
  /// Relative standard deviation of the value at the last change.
  [[nodiscard]] double sd() const { return sd_; }
  [[nodiscard]] double depth_m() const { return depth_m_; }  // depth to which the value applies
  [[nodiscard]] double foot_m() const { return foot_m_; }    // depth of the foot behind the surface, >= 0
  [[nodiscard]] const Vector3& normal() const { return normal_; }  // outward normal at the last change

 private:
  [[nodiscard]] bool surely_wrong(const ContactAnswer& answer) const;

  EstimatorConfig config_;
  double stiffness_n_per_m_ = 0.0;
  double depth_m_ = 0.0, foot_m_ = 0.0;
  Vector3 normal_ = Vector3::Zero();
  double sd_ = 0.0;
  int renewals_ = 0;  // number of changes in this touch that were caused by a halved sd
};

}  // namespace longreach
