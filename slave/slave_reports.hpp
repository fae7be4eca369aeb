#pragma once
// Messages of the slave and their timing. Reports are sent on every change and otherwise as a heartbeat;
// telemetry is sent at its own rate, and at least 60 times per second during an engagement, in which it also shows the
// master that the link works. Messages beyond the budget of the link are delayed.

#include <optional>

#include "common/link/playout.hpp"
#include "slave/estimation/contact.hpp"
#include "slave/send_schedule.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

/// The goals from the playout, which are searched for the goal of a touch.
struct PlayedGoals {
  const Playout& positions;
  const Playout& turns;
  Vector3 anchor_m;
  double sequence, turn_sequence;  // sequence numbers of the goals being played
};

/// A contact (in translation or rotation), the position of the tool relative to the anchor, and the direction
/// in which a limit holds the tool back.
struct ContactAtPlace {
  SlaveContact& contact;
  Vector3 place, held_back;
  Vector3 anchor;  // origin of positions
};

class SlaveReports {
 public:
  explicit SlaveReports(const SlaveConfig& config) { configure(config); }
  void configure(const SlaveConfig& config);

  /// Adds the stiffness report to `output` if one is due. Uses state, cause and engagement of `view`.
  void report(const SlaveInput& input, const SlaveView& view, std::uint64_t reached_sequence,
              const PlayedGoals& goals, const ContactAtPlace& translation, const ContactAtPlace& rotation,
              SlaveOutput& output);
  /// Adds the telemetry, for display and log, to `output` if it is due.
  void telemetry(const SlaveInput& input, const SlaveView& view, bool robot_ok, double penetration_m,
                 SlaveOutput& output);

 private:
  SlaveLinkConfig link_;
  double guard_n_ = 0.0, guard_nm_ = 0.0;  // limits of the guards; 0: not guarded
  SendSchedule reports_;
  std::uint64_t report_sequence_ = 0;
  StiffnessReport reported_{};
  std::optional<Time> news_at_{};  // of a surface
  Time reported_at_{};
  SendSchedule telemetry_;
  std::uint64_t telemetry_sequence_ = 0;
  /// Limits that were active since the last telemetry.
  Clamps clamps_{};
};

}  // namespace longreach
