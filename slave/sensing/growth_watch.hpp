#pragma once
// Detects a direction in which the tool's own motion increases the force although the reported force does not
// oppose it. A surface at rest, with a stiffness of at most k_max, pushes harder only where the tool moves
// against its force:
//   |F| - |F_i| <= k_max max(0, -n (p - p_i)) + 1.3 g (t - t_i),   n = F/|F|
// for every position p_i of the last half millimetre and half second, to the deepest approach since; g is the
// known growth at rest (force_answer.hpp), which the tool does not cause. A force that grows by more than
// that and the noise, and not faster than ten times k_max over the distance, grows along d = p - p_i: the
// sign or the frame of the sensor is wrong, or the surface is approaching. Growth while the tool is at rest
// is not attributed to its motion; growth within 60 degrees of the direction against the force only indicates
// a stiffer surface.

#include "common/core/ring.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct GrowthSample {
  Vector3 p_WE = Vector3::Zero();     // measured tool, m
  Vector3 force_n = Vector3::Zero();  // in W
  bool in_contact = false;
  double dt = 0.0;             // s
  double trend_n_per_s = 0.0;  // g
};

struct GrowthBounds {
  double stiffness_n_per_m = 2e4;  // k_max
  double noise_n = 0.05;
  double bandwidth_hz = 0.0;  // of the sensor; 0: no lag
};

class GrowthWatch {
 public:
  explicit GrowthWatch(const GrowthBounds& bounds) : bounds_(bounds), places_(kPlaces) {}
  void configure(const GrowthBounds& bounds) { bounds_ = bounds; }
  [[nodiscard]] const GrowthBounds& bounds() const { return bounds_; }
  void reset();
  /// Discards the observations, because the tool retreats.
  void forget();
  void step(const GrowthSample& sample);

  [[nodiscard]] bool in_contact() const { return begun_; }
  /// Unit vector; zero: the force grows in no unexpected direction. Kept until the contact ends, or the tool moves
  /// in this direction and the force does not grow.
  [[nodiscard]] const Vector3& direction() const { return direction_; }
  [[nodiscard]] double age_s() const { return age_s_; }  // since it last grew
  [[nodiscard]] double slope_n_per_m() const { return slope_n_per_m_; }
  [[nodiscard]] double n_per_s() const { return n_per_s_; }  // of that growth
  /// It grows across the force, which a surface stiffer than k_max, on which the tool slides, could also
  /// cause.
  [[nodiscard]] bool across() const { return across_; }
  [[nodiscard]] double size_n() const { return size_n_; }  // |F|, filtered
  [[nodiscard]] const Vector3& place_m() const { return p_m_; }

 private:
  static constexpr std::size_t kPlaces = 24;
  struct Place {
    Vector3 p_m;
    double force_n;
    double deepest_m;  // deepest approach since
    double time_s;
  };
  void smooth(const GrowthSample& sample);
  [[nodiscard]] bool rests(const Vector3& step_m, double dt);
  void look_back(const Vector3& normal, double trend_n_per_s);
  void doubt_again();

  GrowthBounds bounds_;
  Ring<Place> places_;
  Vector3 lagged_m_ = Vector3::Zero(), p_m_ = Vector3::Zero();  // with the delay of the sensor; and filtered
  Vector3 force_n_ = Vector3::Zero();
  double size_n_ = 0.0;  // |F|, filtered
  bool begun_ = false;
  double time_s_ = 0.0, rest_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
  Vector3 seen_m_ = Vector3::Zero();  // position of the last growth, and the force there
  double seen_n_ = 0.0;
  double age_s_ = 0.0;
  double slope_n_per_m_ = 0.0;  // of that growth
  double n_per_s_ = 0.0;        // likewise
  bool across_ = false;         // likewise
};

}  // namespace longreach
