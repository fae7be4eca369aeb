#pragma once
// Messages of the slave and their timing: reports on change, otherwise as a heartbeat; telemetry at its own
// rate. Messages beyond the budget of the link wait.

#include <optional>

#include "common/link/playout.hpp"
#include "slave/estimation/contact.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

/// A constant rate: late calls do not shift it, and missed ones do not accumulate.
class SendSchedule {
 public:
  bool due(Time now, double rate_hz);
  void hurry() { next_.reset(); }

 private:
  std::optional<Time> next_{};
};

/// The goals among which a touch is located.
struct PlayedGoals {
  const Playout& positions;
  const Playout& turns;
  Vector3 anchor_m;
  double sequence, turn_sequence;  // as played
};

/// A contact in translation or in rotation, with the position of the tool from the anchor and the direction
/// in which a limit holds it back.
struct ContactAtPlace {
  SlaveContact& contact;
  Vector3 place, held_back;
  Vector3 anchor;  // origin of positions
};

class SlaveReports {
 public:
  explicit SlaveReports(const SlaveLinkConfig& link) : link_(link) {}
  void configure(const SlaveLinkConfig& link) { link_ = link; }

  /// The haptic message, if it is due. Uses state, cause and engagement of `view`.
  void report(const SlaveInput& input, const SlaveView& view, std::uint64_t reached_sequence,
              const PlayedGoals& goals, const ContactAtPlace& translation, const ContactAtPlace& rotation,
              SlaveOutput& output);
  /// For display and log, if it is due.
  void telemetry(const SlaveInput& input, const SlaveView& view, bool robot_ok, double penetration_m,
                 SlaveOutput& output);

 private:
  SlaveLinkConfig link_;
  SendSchedule reports_;
  std::uint64_t report_sequence_ = 0;
  StiffnessReport reported_{};
  Time reported_at_{};
  SendSchedule telemetry_;
  std::uint64_t telemetry_sequence_ = 0;
  Clamps clamps_{};  // since the last telemetry
};

}  // namespace longreach
