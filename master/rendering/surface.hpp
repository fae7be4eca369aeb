#pragma once
// The surface that the slave has met, in the space of the goal: inward unit normal n and offset d, the plane
// n . g = d. Learnt from stiffness reports alone: the normal is the principal axis of the reported tensor,
// its sense that of the operator's own motion up to the touch sequence, the offset the goal at the touch
// sequence.
//
// It is remembered after the contact ends, so that the next touch is felt without delay, and forgotten when
// the slave reports a goal behind it that was reached in free space.

#include <cstdint>

#include "common/link/stiffness_report.hpp"
#include "common/spatial/spatial.hpp"
#include "master/rendering/goal_history.hpp"

namespace longreach {

/// What a report meant for the surface.
enum class SurfaceChange : std::uint8_t {
  kNone,      // nothing new, or not enough is known yet
  kRejected,  // not finite, or a touch that this side never commanded
  kUpdated,   // same surface, refined offset or other stiffness
  kNew,       // another normal: the old one no longer holds
  kGone       // proven to be free space
};

class Surface {
 public:
  /// `may_turn`: whether another normal may be taken now (no force is rendered). `forget_depth_m` > 0.
  SurfaceChange on_report(const ContactStiffness& contact, std::uint64_t reached_sequence,
                          const GoalHistory& history, bool may_turn, double forget_depth_m);
  void clear() { known_ = false; }

  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] const Vector3& inward() const { return inward_; }  // unit
  [[nodiscard]] double offset_m() const { return offset_m_; }      // in the goal's space
  [[nodiscard]] double stiffness_n_per_m() const {
    return stiffness_;
  }  // n^T K n of the last report in contact

 private:
  bool known_ = false;
  Vector3 inward_ = Vector3::UnitX();
  double offset_m_ = 0.0;
  double stiffness_ = 0.0;
};

}  // namespace longreach
