#pragma once
// A ball above the half-space z < 0 in Simbody, with Simbody's Hunt-Crossley force. This header does not
// include Simbody's headers, because they are C++17.

#include <array>
#include <memory>

namespace longreach::oracle {

class SimbodyBall {
 public:
  /// Both surfaces have the same plane-strain modulus (Pa) and dissipation (s/m). There is no friction.
  SimbodyBall(double radius_m, double modulus_pa, double dissipation_s_per_m);
  ~SimbodyBall();

  /// Returns the force on the ball for the centre p (m) and the velocity v (m/s).
  std::array<double, 3> force_n(const std::array<double, 3>& p, const std::array<double, 3>& v);

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace longreach::oracle
