#include "slave/estimation/reported_tangent.hpp"

#include <algorithm>
#include <cmath>

#include "common/link/stiffness_report.hpp"

namespace longreach {
namespace {

constexpr double kWrong = 0.3;       // of the held value, and 5 sd: another object
constexpr double kWrongSd = 0.3;     // fraction, of what replaces it
constexpr double kRenewed = 0.02;    // fraction
constexpr double kElsewhere = 0.01;  // likewise
constexpr double kExponentMost = 3.0;
constexpr int kRenewalsMost = 3;

}  // namespace

/// A power law with n from 1 to 3 and the held slope at the held depth has a slope between the held one and
/// (depth/held depth)² of it at another.
bool ReportedTangent::surely_wrong(const ContactAnswer& a) const {
  const double value = a.stiffness.value, held = stiffness_n_per_m_, sd = a.stiffness.sd;
  if (!(held > 0.0) || !(sd < kWrongSd * value)) return false;
  const double ratio = depth_m_ > 0.0 && a.depth_m > 0.0 ? a.depth_m / depth_m_ : 1.0;
  const double other = held * std::pow(ratio, kExponentMost - 1.0);
  const double off = std::max(std::min(held, other) - value, value - std::max(held, other));
  return off > std::max(kWrong * held, 5.0 * sd);
}

bool ReportedTangent::step(const ContactAnswer& a, const Vector3& normal, double asked_m, bool elsewhere,
                           double first_sd) {
  if (!a.valid) return false;
  const double value = a.stiffness.value;
  if (!(value > 0.0 && value <= kStiffnessMaxNPerM)) return false;
  const double sd = a.stiffness.sd / value;
  const bool farther =
      stiffness_n_per_m_ > 0.0 && std::abs(a.depth_m - asked_m) > std::abs(depth_m_ - asked_m);
  // Nothing is replaced by what is hardly known, unless it is surely wrong.
  if ((farther || !(sd < first_sd)) && !surely_wrong(a)) return false;
  if (stiffness_n_per_m_ > 0.0) {
    // ‖S n nᵀ - S' n' n'ᵀ‖² = (S - S')² + 2 S S' |n × n'|²
    const double ratio = value / stiffness_n_per_m_;
    const double off_value = std::abs(ratio - 1.0);
    const double off_normal = std::sqrt(2.0 * ratio) * normal.cross(normal_).norm();
    const double off = std::hypot(off_value, off_normal);
    const bool large = off > std::max(config_.deadband, 3.0 * sd) || (elsewhere && off > kElsewhere);
    const bool renewed = renewals_ < kRenewalsMost && sd < 0.5 * sd_ &&
                         std::max(off_value, off_normal) > std::max(kRenewed, 3.0 * sd);
    if (!large && !renewed) return false;
    if (!large) ++renewals_;
  }
  stiffness_n_per_m_ = value;
  sd_ = sd;
  depth_m_ = a.depth_m;
  place(a);
  normal_ = normal;
  return true;
}

void ReportedTangent::place(const ContactAnswer& a) {
  if (a.valid && stiffness_n_per_m_ > 0.0)
    foot_m_ = std::max(0.0, a.depth_m - a.depth_m * (a.secant.value / stiffness_n_per_m_));
}

}  // namespace longreach
