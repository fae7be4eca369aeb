#pragma once
// Resistance of the mapping at the handles. It is computed in the same way for translation and rotation (x is
// a position or a rotation vector):
//
//   rate mode      F = -k_f (x - centre) - b v    k_f is multiplied by load_factor with a load in the gripper
//   position mode  F = -σ z                       z follows the handle and slips at |z| = f/(k_scale σ)
//   home spring    F = -k_f x - b v               optional addition in position mode
//
// The friction model is elastic-perfectly plastic (Prandtl 1928; one element of Iwan 1966; Dahl's model with
// exponent 0). It is quiet at rest, because encoder noise is only multiplied by σ.
//
// No transition causes a force step or increases the stored energy by itself. A reduced force (coarser scale,
// load released, end of rate mode, clutch) fades with fade_s. A stiffer spring starts with the current force.
// A spring is stretched further only as far as its own dissipation permits. A spring that is held for a
// sample returns up to k|dx|²/2, which the caller must account for. The values of the handle must be finite.

#include <cstdint>

#include "common/spatial/spatial.hpp"
#include "master/config/rendering_config.hpp"
#include "schema/config_master.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Resistance of one handle.
class ElasticResistance {
 public:
  struct Gains {
    double spring = 0.0;              // N/m or N m/rad
    double damping = 0.0;             // N s/m or N m s/rad
    double friction = 0.0;            // N or N m: slip force
    double friction_stiffness = 1.0;  // > 0
    double fade_s = 0.2;
  };
  enum class Centre : std::uint8_t { kNone, kRate, kHome };
  struct Motion {
    Vector3 moved = Vector3::Zero();       // displacement since the last step
    Vector3 rate = Vector3::Zero();        // velocity, m/s or rad/s
    Vector3 deflection = Vector3::Zero();  // displacement from the centre
    Centre centre = Centre::kNone;         // kNone: no spring; the deflection is ignored
  };

  /// Advances by `dt_s` > 0. Returns the force (N) or moment (N m) on the hand.
  Vector3 step(const Motion& motion, const Gains& gains, double dt_s);
  [[nodiscard]] double energy_j() const;  // stored energy

 private:
  Vector3 spring(const Motion& motion, const Gains& gains, double share);
  void follow(const Vector3& carried, const Motion& motion, double share);
  Vector3 friction(const Vector3& moved, const Gains& gains, double share);

  Centre centre_ = Centre::kNone;
  double spring_ = 0.0, damping_ = 0.0, friction_ = 0.0, friction_stiffness_ = 1.0;  // values in effect
  bool attached_ = false;              // the stretch equals the deflection, instead of approaching it
  Vector3 stretch_ = Vector3::Zero();  // deflection of the spring
  Vector3 bristle_ = Vector3::Zero();  // deflection of the friction element
  Vector3 drag_ = Vector3::Zero();     // damping force of the last step
};

struct ResistanceInput {
  HandleState handle{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;                                   // k_scale, > 0
  Vector3 centre_m = Vector3::Zero();                   // centre of rate mode, M
  Quaternion centre_rotation = Quaternion::Identity();  // orientation at the centre of rate mode, M
  bool frozen = false;  // the goal does not follow the handle; rate mode has no centre spring
  bool load = false;    // the gripper holds a load
  bool turns = true;    // the handle has an orientation
};

class Resistance {
 public:
  explicit Resistance(const RenderingConfig& config) : config_(config) {}
  void configure(const RenderingConfig& config) { config_ = config; }
  /// Restarts without force at the position of the handle.
  void reset(const HandleState& handle);

  /// Advances by `dt_s` > 0. Returns the wrench on the hand, in M.
  Wrench step(const ResistanceInput& input, double dt_s);

  [[nodiscard]] double energy_j() const { return translation_.energy_j(); }  // stored energy
  [[nodiscard]] double rotation_energy_j() const { return rotation_.energy_j(); }

 private:
  RenderingConfig config_;
  ElasticResistance translation_, rotation_;
  Vector3 x_last_ = Vector3::Zero();
  Quaternion q_last_ = Quaternion::Identity();
};

}  // namespace longreach
