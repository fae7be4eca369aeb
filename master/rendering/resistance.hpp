#pragma once
// What the hand feels of the mapping itself.
//   rate mode      F = -k_f (x - centre) - b v
//   position mode  elastic friction (Dahl): F = -sigma z, z follows the handle and slips where |z| >
//   (f/k_scale)/sigma:
//                  quiet at rest, passive by its stored energy sigma |z|^2 / 2
//   rotation       M = -k_r log(R_H) - b_r omega

#include "common/spatial/spatial.hpp"
#include "master/devices/handle_state.hpp"
#include "master/mapping/mapping_config.hpp"
#include "master/rendering/rendering_config.hpp"

namespace longreach {

struct ResistanceInput {
  HandleState handle{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;                  // k_scale, > 0
  Vector3 centre_m = Vector3::Zero();  // of rate mode
};

class Resistance {
 public:
  explicit Resistance(const RenderingConfig& config) : config_(config) {}
  void configure(const RenderingConfig& config) { config_ = config; }
  void reset(const HandleState& handle);

  /// Wrench on the hand, in M.
  Wrench step(const ResistanceInput& input);

  [[nodiscard]] double energy_j() const { return energy_j_; }  // stored by the translational springs
  [[nodiscard]] double rotation_energy_j() const { return rotation_energy_j_; }

 private:
  RenderingConfig config_;
  Vector3 x_last_ = Vector3::Zero();
  Vector3 stretch_m_ = Vector3::Zero();
  double energy_j_ = 0.0;
  double rotation_energy_j_ = 0.0;
};

}  // namespace longreach
