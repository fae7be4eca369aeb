// What is told of a surface: the estimate for display, and the surface of the report.

#include "slave/estimation/surface.hpp"

namespace longreach {
namespace {

constexpr double kValidSd = 0.5;  // fraction

}  // namespace

ContactEstimate Surface::estimate() const {
  ContactEstimate result;
  ContactAnswer a = answer_;
  if (!identifier_.reported().law_fits() && local_reported_.valid) {
    a.stiffness = local_reported_.stiffness;
    a.secant = local_reported_.secant;
    a.depth_m = local_reported_.depth_m;
  }
  result.valid = pressed_ && a.valid && a.stiffness.sd < kValidSd * a.stiffness.value;
  if (!result.valid) return result;
  result.stiffness_n_per_m = a.stiffness.value;
  result.stiffness_sd_n_per_m = a.stiffness.sd;
  result.secant_n_per_m = a.secant.value;
  result.k = a.k.value;
  result.lambda = a.lambda.value;
  result.n = a.n.value;
  result.k_sd = a.k.sd;
  result.lambda_sd = a.lambda.sd;
  result.n_sd = a.n.sd;
  result.correlation = a.correlation;
  result.stiffness_verdict = a.stiffness.verdict;
  result.k_verdict = a.k.verdict;
  result.lambda_verdict = a.lambda.verdict;
  result.n_verdict = a.n.verdict;
  result.depth_m = a.depth_m;
  return result;
}

ReportedSurface Surface::report(const Vector3& anchor) const {
  const bool reported = reported_.stiffness_n_per_m() > 0.0;
  ReportedSurface result{.normal = reported ? reported_.normal() : normal_,
                         .stiffness = reported_.stiffness_n_per_m(),
                         .foot = reported_.foot_m(),
                         .touch_sequence = touch_sequence_,
                         .touch = touch_,
                         .pressed = pressed_};
  if (touch_sequence_ <= 0.0)
    result.offset = result.normal.dot((placed_sd_m_ > 0.0 ? place_m_
                                       : known_           ? known_point_m_
                                                          : point()) -
                                      anchor);
  return result;
}

}  // namespace longreach
