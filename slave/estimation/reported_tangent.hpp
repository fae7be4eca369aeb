#pragma once
// What of the estimate is told to the operator: the tangent of the contact's law at a depth, held. It is the
// line through the force there with the slope there, and begins at its foot, depth - F/F' behind the surface.
// Each change moves the felt wall a little, so the value appears when its sd is below `first_sd`, then
// changes only by more than max(deadband, 3 sd), or once a touch when its sd is below 1 % and it is off by
// more than max(2 %, 3 sd), in the Frobenius norm of S n nᵀ: a direction that was learnt better is a change
// as well. A value that is surely wrong, by over 30 % and 5 sd, gives way to one known to 30 %. A second
// touch of the same surface goes on with it.

#include "common/spatial/spatial.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {

class ReportedTangent {
 public:
  explicit ReportedTangent(const EstimatorConfig& config) : config_(config) {}

  void configure(const EstimatorConfig& config) { config_ = config; }
  /// A new touch; `again`: of a surface whose value still holds.
  void begin(bool again) {
    if (!again) stiffness_n_per_m_ = depth_m_ = foot_m_ = 0.0;
    corrected_ = false;
  }

  /// True if the reported value has changed.
  bool step(const ContactAnswer& answer, const Vector3& normal);

  [[nodiscard]] double stiffness_n_per_m() const { return stiffness_n_per_m_; }  // 0: none yet
  [[nodiscard]] double depth_m() const { return depth_m_; }                      // that it belongs to
  [[nodiscard]] double foot_m() const { return foot_m_; }                        // behind the surface, >= 0
  [[nodiscard]] const Vector3& normal() const { return normal_; }                // that it was taken with

 private:
  EstimatorConfig config_;
  double stiffness_n_per_m_ = 0.0;
  double depth_m_ = 0.0, foot_m_ = 0.0;
  Vector3 normal_ = Vector3::Zero();
  bool corrected_ = false;
};

}  // namespace longreach
