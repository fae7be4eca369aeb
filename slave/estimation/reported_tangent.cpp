#include "slave/estimation/reported_tangent.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kWrong = 0.3;    // of the held value, and 5 sd: another object
constexpr double kWrongSd = 0.3;  // fraction, of what replaces it

}  // namespace

bool ReportedTangent::step(const ContactAnswer& a, const Vector3& normal) {
  if (!a.valid) return false;
  const double value = a.stiffness.value;
  const double sd = a.stiffness.sd / value;
  // Nothing is replaced by what is hardly known, unless it is surely wrong.
  const double held = stiffness_n_per_m_;
  const bool wrong =
      held > 0.0 && sd < kWrongSd && std::abs(value - held) > std::max(kWrong * held, 5.0 * sd * value);
  if (!(sd < config_.first_sd) && !wrong) return false;
  if (stiffness_n_per_m_ > 0.0) {
    // ‖S n nᵀ - S' n' n'ᵀ‖² = (S - S')² + 2 S S' |n × n'|²
    const double off = std::sqrt(std::pow(value - stiffness_n_per_m_, 2) +
                                 2.0 * value * stiffness_n_per_m_ * normal.cross(normal_).squaredNorm()) /
                       stiffness_n_per_m_;
    const bool large = off > std::max(config_.deadband, 3.0 * sd);
    const bool refined = !corrected_ && sd < 0.01 && off > std::max(0.02, 3.0 * sd);
    if (!large && !refined) return false;
    if (!large) corrected_ = true;
  }
  stiffness_n_per_m_ = value;
  depth_m_ = a.depth_m;
  foot_m_ = std::max(0.0, a.depth_m - a.depth_m * (a.secant.value / value));
  normal_ = normal;
  return true;
}

}  // namespace longreach
