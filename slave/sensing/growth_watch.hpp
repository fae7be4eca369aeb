#pragma once
// In which direction does the tool's own motion make the force larger, although the force that is told does
// not point against it? A surface at rest, no stiffer than k_max, pushes harder only where the tool goes
// against its force:
//   |F| - |F_i| <= k_max max(0, -n (p - p_i)) + 1.3 g (t - t_i),   n = F/|F|
// for every place p_i of the last half millimetre and half second, to the deepest approach since; g is what
// it is known to grow by at rest (force_answer.hpp), for that is not the tool's doing. What grows
// by more than that and noise, and not faster than ten times k_max on the way gone, grows along d = p - p_i:
// the sign or the frame of the sensor is wrong, or the surface comes. What grows while the tool rests is not
// its own; nor is what grows within 60 degrees of against the force: there it is but a stiffer surface.

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
  /// What was seen does not count, as the tool gives way.
  void forget();
  void step(const GrowthSample& sample);

  [[nodiscard]] bool in_contact() const { return begun_; }
  /// Unit; zero: the force grows in no direction that it should not. Until the contact ends, or the tool goes
  /// that way and the force does not grow.
  [[nodiscard]] const Vector3& direction() const { return direction_; }
  [[nodiscard]] double age_s() const { return age_s_; }  // since it last did
  [[nodiscard]] double slope_n_per_m() const { return slope_n_per_m_; }
  [[nodiscard]] double n_per_s() const { return n_per_s_; }  // of that growth
  /// It grows across the force: a surface stiffer than k_max, on which the tool slides, could do that too.
  [[nodiscard]] bool across() const { return across_; }
  [[nodiscard]] double size_n() const { return size_n_; }  // |F|, smooth
  [[nodiscard]] const Vector3& place_m() const { return p_m_; }

 private:
  static constexpr std::size_t kPlaces = 24;
  struct Place {
    Vector3 p_m;
    double force_n;
    double deepest_m;  // approach since
    double time_s;
  };
  void smooth(const GrowthSample& sample);
  [[nodiscard]] bool rests(const Vector3& step_m, double dt);
  void look_back(const Vector3& normal, double trend_n_per_s);
  void doubt_again();

  GrowthBounds bounds_;
  Ring<Place> places_;
  Vector3 lagged_m_ = Vector3::Zero(), p_m_ = Vector3::Zero();  // as late as the sensor; and smooth
  Vector3 force_n_ = Vector3::Zero();
  double size_n_ = 0.0;  // |F|, smooth
  bool begun_ = false;
  double time_s_ = 0.0, rest_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
  Vector3 seen_m_ = Vector3::Zero();  // where it last grew, and to what
  double seen_n_ = 0.0;
  double age_s_ = 0.0;
  double slope_n_per_m_ = 0.0;  // of that growth
  double n_per_s_ = 0.0;        // likewise
  bool across_ = false;         // likewise
};

}  // namespace longreach
