#pragma once
// A tool that moves among planes or other forces, and the contact that the slave makes of it.

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "common/core/random.hpp"
#include "slave/estimation/contact.hpp"

namespace longreach::contact_bench {

inline constexpr double kDt = 1e-3;

/// A plane that pushes along `normal` wherever the tool is behind it.
struct Plane {
  Vector3 normal;
  double place_m;  // along the normal
  double stiffness_n_per_m;
};

/// A tool that goes from place to place at 5 mm/s, among planes or what else there is.
struct Bench {
  explicit Bench(std::vector<Plane> all) : planes(std::move(all)) {
    force = [this](const Vector3& p) {
      Vector3 sum = Vector3::Zero();
      for (const Plane& plane : planes)
        sum += plane.stiffness_n_per_m * std::max(0.0, plane.place_m - plane.normal.dot(p)) * plane.normal;
      return sum;
    };
  }

  void go(const Vector3& to, double speed = 5e-3) {
    while ((to - p_m).norm() > 1e-12) {
      const Vector3 step = clamp_norm(Vector3(to - p_m), speed * kDt);
      p_m += step;
      feel(step / kDt);
    }
  }
  void rest(double seconds) {
    for (double t = 0.0; t < seconds; t += kDt) feel(Vector3::Zero());
  }
  void feel(const Vector3& v) {
    const Vector3 noise(0.02 * random.normal(), 0.02 * random.normal(), 0.02 * random.normal());
    contact.step({.p_WE = p_m, .v_WE = v, .force_n = force(p_m) + noise, .dt = kDt, .bias_n = bias_n});
  }
  /// Those that there are, and how many of them are pressed.
  [[nodiscard]] int there() const {
    return count([](const ReportedSurface& s) { return s.touch > 0; });
  }
  [[nodiscard]] int pressed() const {
    return count([](const ReportedSurface& s) { return s.pressed; });
  }
  [[nodiscard]] ReportedSurface facing(const Vector3& normal) const {
    for (const ReportedSurface& s : contact.report(Vector3::Zero())) {
      if (s.touch > 0 && s.normal.dot(normal) > 0.98) return s;
    }
    return {};
  }

  std::vector<Plane> planes;
  std::function<Vector3(const Vector3&)> force;
  Random random{1};
  Vector3 p_m = Vector3::Zero(), bias_n = Vector3::Zero();
  SlaveContact contact{SensingConfig{}, EstimatorConfig{}};

 private:
  template <class Which>
  int count(Which which) const {
    const auto all = contact.report(Vector3::Zero());
    return static_cast<int>(std::ranges::count_if(all, which));
  }
};

}  // namespace longreach::contact_bench
