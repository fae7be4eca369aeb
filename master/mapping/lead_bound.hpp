#pragma once
// Determines when the lead of the goal is bounded: from the report that a limit holds the robot back until
// the robot has reached a goal that was commanded within the bound. Ending the bound together with the report
// would not suffice: because of the delay, the goal would repeatedly run ahead and be pulled back. At a surface of
// stiffness k, the lead is at most a tenth of the depth at which the force is the limit of the force guard, so that a
// hand that retreats soon reduces the force.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/link/stiffness_report.hpp"
#include "master/mapping/mapping.hpp"

namespace longreach {

class LeadBound {
 public:
  /// `lead_max` is Mapping::kLead_m or Mapping::kLead_rad.
  explicit LeadBound(double lead_max) : lead_max_(lead_max) {}

  void reset() { *this = LeadBound(lead_max_); }

  /// Processes a report of the current engagement. `reached` is the number of the newest command whose goal
  /// the robot has reached.
  void on_report(const ContactReport& report, std::uint64_t reached) {
    if (!report.held_back.isZero(0.0)) {
      bound_ = {report.place, report.held_back, lead_of(report)};
    } else if (within_ && reached >= *within_) {
      reset();
    }
  }

  /// Records that command `sequence` is sent. Its goal is `ahead` (m or rad) beyond the position of the
  /// bound, along the bound's direction.
  void on_command(std::uint64_t sequence, double ahead) {
    constexpr double kRounding = 1e-9;
    if (bound_.direction.isZero(0.0) || ahead > bound_.lead + kRounding) {
      within_.reset();
    } else if (!within_) {
      within_ = sequence;
    }
  }

  [[nodiscard]] const GoalBound& bound() const { return bound_; }

 private:
  [[nodiscard]] double lead_of(const ContactReport& report) const {
    constexpr double kOfGuard = 0.1;
    double out = lead_max_;
    for (const ReportedSurface& surface : report.surfaces) {
      const double opposes = -surface.normal.dot(report.held_back);  // cosine of the angle
      if (!surface.pressed || !(opposes > 0.5) || !(surface.stiffness > 0.0) || !(report.guard > 0.0))
        continue;
      out = std::min(out, kOfGuard * report.guard / surface.stiffness);
    }
    return out;
  }

  double lead_max_;
  GoalBound bound_{};
  /// The command since which all goals have been within the bound.
  std::optional<std::uint64_t> within_{};
};

}  // namespace longreach
