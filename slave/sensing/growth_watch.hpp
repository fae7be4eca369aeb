#pragma once
// Detects a direction in which the motion of the tool increases the force although the reported force does
// not oppose that motion. A surface at rest, with a stiffness of at most k_max, pushes harder only if the
// tool moves against its force:
//   |F| - |F_i| <= k_max max(0, -n (p - p_i)) + 1.3 g (t - t_i),   n = F/|F|
// This holds for every position p_i within the last half millimetre and half second. The k_max term uses the
// deepest position p since then; g is the known growth at rest (force_answer.hpp), which the tool does not
// cause. If the force grows by more than this bound plus the noise, but by at most ten times k_max |p - p_i|,
// then either the sign or the frame of the sensor is wrong, or the surface is approaching along d = p - p_i.
// Growth that the inertia of a load may cause is not evidence. Growth while the tool is at rest is not
// attributed to motion. Growth during motion within 60 degrees of the direction opposite to the force only
// indicates a stiffer surface.

#include "common/core/ring.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct GrowthSample {
  Vector3 p_WE = Vector3::Zero();     // measured position of the tool, m
  Vector3 force_n = Vector3::Zero();  // in W
  bool in_contact = false;
  double dt = 0.0;             // s
  double trend_n_per_s = 0.0;  // g
  double uncertainty_n = 0.0;  // part of the force that the inertia of a load may cause
};

struct GrowthBounds {
  double stiffness_n_per_m = 2e4;  // k_max
  double noise_n = 0.05;
  double bandwidth_hz = 0.0;  // bandwidth of the sensor; 0: no lag
};

class GrowthWatch {
 public:
  explicit GrowthWatch(const GrowthBounds& bounds) : bounds_(bounds), places_(kPlaces) {}
  void configure(const GrowthBounds& bounds) { bounds_ = bounds; }
  [[nodiscard]] const GrowthBounds& bounds() const { return bounds_; }
  void reset();
  /// Discards the observations. Call this when the tool retreats.
  void forget();
  void step(const GrowthSample& sample);

  [[nodiscard]] bool in_contact() const { return begun_; }
  /// Direction (unit vector) of the motion that makes the force grow unexpectedly; zero if there is none. The
  /// direction is kept until the contact ends, or until the tool moves in this direction and the force does not grow.
  [[nodiscard]] const Vector3& direction() const { return direction_; }
  [[nodiscard]] double age_s() const { return age_s_; }  // time since the force last grew in this direction
  [[nodiscard]] double slope_n_per_m() const { return slope_n_per_m_; }
  [[nodiscard]] double n_per_s() const { return n_per_s_; }  // rate of the unexpected growth
  /// True if motion along direction() is perpendicular to the force, so that a surface stiffer than k_max on
  /// which the tool slides could also cause the growth.
  [[nodiscard]] bool across() const { return across_; }
  [[nodiscard]] double size_n() const { return size_n_; }  // filtered |F|
  /// Filtered position of the tool, with the delay of the force.
  [[nodiscard]] const Vector3& place_m() const { return p_m_; }

 private:
  static constexpr std::size_t kPlaces = 24;
  struct Place {
    Vector3 p_m;
    double force_n;
    /// Deepest approach since the tool was at this position.
    double deepest_m;
    double time_s;
  };
  void smooth(const GrowthSample& sample);
  [[nodiscard]] bool rests(const Vector3& step_m, double dt);
  void look_back(const Vector3& normal, const GrowthSample& sample);
  void doubt_again();

  GrowthBounds bounds_;
  Ring<Place> places_;
  /// Position with the delay of the sensor (`lagged_m_`), and in addition filtered like the force (`p_m_`).
  Vector3 lagged_m_ = Vector3::Zero(), p_m_ = Vector3::Zero();
  Vector3 force_n_ = Vector3::Zero();
  double size_n_ = 0.0;  // filtered |F|
  bool begun_ = false;
  double time_s_ = 0.0, rest_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
  /// Position at the last growth; seen_n_ is the force there.
  Vector3 seen_m_ = Vector3::Zero();
  double seen_n_ = 0.0;
  double age_s_ = 0.0;
  double slope_n_per_m_ = 0.0;  // slope of the unexpected growth
  double n_per_s_ = 0.0;
  bool across_ = false;
};

}  // namespace longreach
