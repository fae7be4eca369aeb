#pragma once
// A ball above the half space z < 0 in Simbody, with its Hunt-Crossley force. Simbody's headers are C++17, so
// this header does not include them.

#include <array>
#include <memory>

namespace longreach::oracle {

class SimbodyBall {
 public:
  /// Both surfaces have the same plane-strain modulus, Pa, and dissipation, s/m; no friction.
  SimbodyBall(double radius_m, double modulus_pa, double dissipation_s_per_m);
  ~SimbodyBall();

  /// Force on the ball with its centre at p, m, and the velocity v, m/s.
  std::array<double, 3> force_n(const std::array<double, 3>& p, const std::array<double, 3>& v);

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace longreach::oracle
