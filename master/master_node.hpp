#pragma once
// The master without I/O. The node connects mapping and rendering, controls engagements and numbers the commands.
// Its inputs are the time, the state of the handle and the received messages; its outputs are the wrench and the
// command. step() has no side effects except on the state of the node, and neither allocates nor throws.

#include <memory>
#include <span>

#include "common/link/body_poses.hpp"
#include "common/link/envelope.hpp"
#include "common/link/stiffness_report.hpp"
#include "master/config/master_config.hpp"
#include "schema/state_master.hpp"

namespace longreach {

class ContactLaw;

/// What a tick of the node gets.
struct MasterInput : MasterTickInput {
  std::span<const Received<StiffnessReport>> reports{};
  std::span<const Received<Telemetry>> telemetry{};
  std::span<const Received<BodyPoses>> bodies{};
};

class MasterNode {
 public:
  explicit MasterNode(const MasterConfig& config);
  ~MasterNode();

  /// Advances by one tick.
  MasterOutput step(const MasterInput& input);

  /// Takes effect in the next step. Fields that can change only at start-up are ignored.
  void configure(const MasterConfig& config);
  /// Renders the contacts by `law`, which must outlive the node; null: by the passive springs. Only the laboratory calls it,
  /// for comparison.
  void render_by(const ContactLaw* law);

  /// Returns the view after the last step.
  [[nodiscard]] const MasterView& view() const;
  /// Returns true while the fields that must not change during an engagement are locked.
  [[nodiscard]] bool engaged() const;
  /// Returns whether a tick at `now` would come more than safety.gap_s after the previous tick. If so, data
  /// that arrived in between is too old to use.
  [[nodiscard]] bool stalled(Time now) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
