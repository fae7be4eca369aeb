#include "master/rendering/surface.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace longreach {
namespace {

constexpr double kMotionLeast_m = 1e-4;  // motion from which a direction is believed
constexpr double kSameNormal = 0.98;     // cosine: 11 degrees

}  // namespace

SurfaceChange Surface::on_report(const ContactStiffness& contact, std::uint64_t reached_sequence,
                                 const GoalHistory& history, bool may_turn, double forget_depth_m) {
  if (!contact.stiffness.allFinite() || !std::isfinite(contact.touch_sequence))
    return SurfaceChange::kRejected;
  if (!contact.in_contact) {
    if (!known_) return SurfaceChange::kNone;
    const auto reached = history.at(static_cast<double>(reached_sequence));
    if (!reached || inward_.dot(*reached) - offset_m_ < forget_depth_m) return SurfaceChange::kNone;
    known_ = false;
    return SurfaceChange::kGone;
  }
  const Matrix3 K = 0.5 * (contact.stiffness + contact.stiffness.transpose());
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(K);
  const double k_max = eigen.eigenvalues()(2);
  if (!(k_max > 1e-9 * K.cwiseAbs().maxCoeff()))
    return SurfaceChange::kNone;  // in contact, but not identified yet
  const auto goal = history.at(contact.touch_sequence);
  if (!goal) return SurfaceChange::kRejected;

  Vector3 n = eigen.eigenvectors().col(2).normalized();
  const Vector3 motion = history.motion_before(contact.touch_sequence, kMotionLeast_m);
  if (n.dot(motion) < 0.0) n = -n;
  const bool same = known_ && n.dot(inward_) > kSameNormal;
  if (!same) {
    if (!may_turn || !n.allFinite()) return SurfaceChange::kNew;
    inward_ = n;
    known_ = true;
  }
  offset_m_ = inward_.dot(*goal);
  stiffness_ = inward_.dot(K * inward_);
  return same ? SurfaceChange::kUpdated : SurfaceChange::kNew;
}

}  // namespace longreach
