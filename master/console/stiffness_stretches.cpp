#include "master/console/stiffness_stretches.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kStretchForceMin_n = 0.2;
constexpr double kStretchSettles_s = 1.0;  // after the begin of a stretch, in addition to one RTT
constexpr double kStretchMin_s = 1.0;
constexpr double kStretchMotionMin_m = 5e-4;
constexpr double kSameNormal = 0.985;      // cosine of 10 degrees
constexpr double kSamePlace_m = 1e-3;      // refinements of a surface are smaller
constexpr double kSameGroup_m = 1e-5;      // a larger change of the position is another intercept
constexpr double kSameEstimate = 0.1;      // relative change
constexpr double kStretchWithheld = 0.02;  // fraction of the force that may be lacking

}  // namespace

bool StiffnessStretches::continues(const MasterView& view) const {
  return key_ && view.engagement == key_->engagement && view.scale == key_->scale &&
         view.inward.dot(key_->inward) > kSameNormal &&
         std::fabs(view.surface_m - key_->surface_m) < kSamePlace_m &&
         std::fabs(view.far.estimate.stiffness_n_per_m - key_->estimate_n_per_m) <
             kSameEstimate * key_->estimate_n_per_m;
}

void StiffnessStretches::begin(double seconds, const MasterView& view) {
  add_to(result_, judged());
  key_ = {view.engagement, view.scale, view.inward, view.surface_m, view.far.estimate.stiffness_n_per_m};
  began_s_ = seconds;
  fit_.clear();
  sampled_s_ = estimates_n_per_m_ = 0.0;
}

/// The samples after a gap may have another intercept.
void StiffnessStretches::skip() { fit_.begin_group(); }

void StiffnessStretches::add(double seconds, const MasterView& view, std::optional<double> rtt_s) {
  const double dt_s = std::max(0.0, seconds - last_s_);
  last_s_ = seconds;
  result_.touched = result_.touched || view.in_contact;
  if (view.stiffness_clamped) result_.cut_to_n_per_m = view.stiffness_max_n_per_m;
  if (view.state != SafetyState::kEngaged || view.clutched || view.mode != MotionMode::kPosition) {
    add_to(result_, judged());
    key_.reset();
    return;
  }
  if (!view.in_contact || !view.far_known || !view.far.estimate.valid) return skip();
  if (!continues(view)) begin(seconds, view);
  const double force_n = -view.inward.dot(view.spring_force_n);
  const bool settled = rtt_s && seconds >= began_s_ + *rtt_s + kStretchSettles_s;
  const bool clamped = view.force_clamped || view.stiffness_clamped;
  if (!settled || clamped || !(force_n > kStretchForceMin_n) || view.withheld_n > kStretchWithheld * force_n)
    return skip();
  const double x_m = view.inward.dot(view.p_MH);
  if (sampled_s_ == 0.0) x_min_m_ = x_max_m_ = x_m;
  if (std::fabs(view.surface_m - group_surface_m_) > kSameGroup_m) {
    skip();
    group_surface_m_ = view.surface_m;
  }
  x_min_m_ = std::fmin(x_min_m_, x_m);
  x_max_m_ = std::fmax(x_max_m_, x_m);
  sampled_s_ += dt_s;
  fit_.add(x_m, force_n);
  estimates_n_per_m_ += view.far.estimate.stiffness_n_per_m;
}

std::optional<StiffnessStretches::Stretch> StiffnessStretches::judged() const {
  if (!key_ || !fit_.valid() || sampled_s_ < kStretchMin_s || x_max_m_ - x_min_m_ < kStretchMotionMin_m)
    return std::nullopt;
  Stretch s;
  s.displayed_n_per_m = fit_.slope();
  s.estimated_n_per_m = ke_ * estimates_n_per_m_ / static_cast<double>(fit_.count());
  s.error = s.displayed_n_per_m / (wall_n_per_m_ ? ke_ * *wall_n_per_m_ : s.estimated_n_per_m) - 1.0;
  return s;
}

void StiffnessStretches::add_to(Result& result, const std::optional<Stretch>& stretch) {
  if (!stretch) return;
  if (result.judged == 0 || std::fabs(stretch->error) > std::fabs(result.worst.error))
    result.worst = *stretch;
  ++result.judged;
}

StiffnessStretches::Result StiffnessStretches::result() const {
  Result all = result_;
  add_to(all, judged());
  return all;
}

}  // namespace longreach
