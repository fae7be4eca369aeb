#pragma once
// Judges the displayed stiffness: the least-squares slope of the contact spring's force over the position of the
// handle, both along the inward normal. It should equal ke times the estimate of the slave. It is judged separately for
// each stretch of a run: one surface, touched in position mode with one scale and in one engagement. A stretch begins
// again when the surface, its position or its estimate changes, when the clutch is pressed and after a hold.
//
// A sample counts from RTT + 1 s after the begin of its stretch on, with a spring force above 0.2 N, no value clamped,
// and no force withheld because the energy for it is lacking. Stretches with less than 1 s of samples, or 0.5 mm of
// motion, are not judged. add() does not allocate. It may be called in every tick or at any lower, steady rate.

#include <cstdint>
#include <optional>

#include "common/core/regression.hpp"
#include "master/master_node.hpp"

namespace longreach {

class StiffnessStretches {
 public:
  struct Stretch {
    double displayed_n_per_m = 0.0;
    double estimated_n_per_m = 0.0;  // ke times the mean estimate over the same samples
    double error = 0.0;  // of the displayed stiffness, relative to the wall or else to the estimate
  };
  struct Result {
    bool touched = false;
    std::uint64_t judged = 0;  // number of stretches
    Stretch worst{};           // the one with the largest error, if any was judged
    /// Stiffness limit of the device if a surface was stiffer; otherwise 0.
    double cut_to_n_per_m = 0.0;
  };

  /// `wall_n_per_m` is the true stiffness of the touched object, if it is known.
  StiffnessStretches(double ke, std::optional<double> wall_n_per_m) : ke_(ke), wall_n_per_m_(wall_n_per_m) {}

  void add(double seconds, const MasterView& view, std::optional<double> rtt_s);
  /// Returns the result including the current stretch.
  [[nodiscard]] Result result() const;

 private:
  /// What one stretch has in common.
  struct Key {
    std::uint32_t engagement = 0;
    double scale = 0.0;
    Vector3 inward = Vector3::Zero();
    double surface_m = 0.0;
    double estimate_n_per_m = 0.0;
  };

  [[nodiscard]] bool continues(const MasterView& view) const;
  void begin(double seconds, const MasterView& view);
  void skip();
  [[nodiscard]] std::optional<Stretch> judged() const;
  static void add_to(Result& result, const std::optional<Stretch>& stretch);

  double ke_;
  std::optional<double> wall_n_per_m_;
  Result result_{};  // of the completed stretches
  std::optional<Key> key_{};
  double began_s_ = 0.0, last_s_ = 0.0;
  LineFit fit_;
  double sampled_s_ = 0.0;
  double group_surface_m_ = 0.0;
  double x_min_m_ = 0.0, x_max_m_ = 0.0;  // handle along the normal, over the samples
  double estimates_n_per_m_ = 0.0;        // sum over the samples
};

}  // namespace longreach
