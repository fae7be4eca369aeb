#pragma once
// What the shells of both sides have in common: socket, adapter, record buffer, and what other threads exchange with the loop,
// which never blocks it. `Parts` names what differs:
//
//   Config, Message            configuration, plain and as protobuf message
//   Side, Adapter              the side, and the adapter of the real device or robot
//   Snapshot                   has the members side, view and adapter
//   RecordBuffer
//   Change                     SideChange<Config>, or derived from it
//   Command                    variant of Change, ImpairmentConfig, RecordingChange<RecordBuffer> and more
//   kSide, kRole, kDevice      "master", RpcRole::kMaster and "haptic device"; "slave", RpcRole::kSlave and "robot"
//   adapter_of(config)         the adapter of a Config

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "common/core/random.hpp"
#include "common/crypto/session.hpp"
#include "common/loop/latest_value.hpp"
#include "common/loop/mailbox.hpp"
#include "common/loop/stop_level.hpp"
#include "common/loop/wait_for_adapter.hpp"
#include "common/net/adapter_channel.hpp"
#include "common/net/udp_channel.hpp"
#include "common/recording/record_buffer.hpp"
#include "common/site/rpc_security.hpp"

namespace longreach {

enum class LoopAnswer { kDone, kEngaged, kOccupied };  // kOccupied: another master has control

template <class Config>
struct SideChange {
  Config config{};
  bool only_disengaged = false;  // a field changed that must not change during an engagement
  bool impairment = false;       // config.link.impairment changed
  std::uint32_t number = 0;      // number of the configuration, for recordings
};
/// Sets the record buffer; null: no recording. Once this has been processed, the loop no longer uses the previous buffer.
template <class RecordBuffer>
struct RecordingChange {
  RecordBuffer* record_buffer = nullptr;
};

template <class Parts_>
class SideShell {
 public:
  using Parts = Parts_;
  using Config = typename Parts::Config;
  using Command = typename Parts::Command;
  using Snapshot = typename Parts::Snapshot;
  using RecordBuffer = typename Parts::RecordBuffer;

  /// Waits until the adapter responds, for at most 2 s; returns at once if there is none. Call this before the first tick.
  void wait_for_adapter() {
    if (adapter_) longreach::wait_for_adapter(*adapter_);
  }
  /// Sets the record buffer. Call this only before the first tick; later, use RecordingChange.
  void record(RecordBuffer* record_buffer) { record_buffer_ = record_buffer; }
  /// Returns the snapshot of the last tick. May be called only in the loop thread.
  [[nodiscard]] const Snapshot& last() const { return snapshot_; }

  Mailbox<Command, LoopAnswer>& mailbox() { return mailbox_; }
  StopLevel& stops() { return stops_; }
  LatestValue<Snapshot>& snapshots() { return snapshots_; }
  [[nodiscard]] std::string address() const { return channel_.local_address(); }

 protected:
  /// Throws AddressError, or std::runtime_error if the socket cannot be opened. `peer`: address of the slave. `random` draws
  /// the artificial impairment. `reduced`: bits of Protection that do not act outside the node. `described`: what the adapter
  /// needs of the configuration besides its own part.
  template <class... Described>
  SideShell(const Config& config, const std::optional<std::string>& peer, const Random& random,
            std::uint32_t reduced, const Described&... described)
      : channel_(config.link.listen, peer),
        adapter_channel_(open_adapter_channel(Parts::adapter_of(config))),
        side_(config, channel_, random),
        reduced_(reduced) {
    if (adapter_channel_)
      adapter_.emplace(*adapter_channel_, with_prompt_timeout(Parts::adapter_of(config), config.loop.rate_hz),
                       described..., draw_session(Cipher::kChaCha20Poly1305).number);
  }

  /// Carries out a command of both sides.
  LoopAnswer obey_common(const Command& command, Time now) {
    if (const auto* impairment = std::get_if<ImpairmentConfig>(&command)) {
      side_.port().impairment().configure(*impairment, now);
    } else if (const auto* recording = std::get_if<RecordingChange<RecordBuffer>>(&command)) {
      record_buffer_ = recording->record_buffer;
    } else {
      const auto& change = std::get<typename Parts::Change>(command);
      if (change.only_disengaged && side_.node().engaged()) return LoopAnswer::kEngaged;
      side_.configure(change.config);
      config_number_ = change.number;
      if (change.impairment) side_.port().impairment().configure(change.config.link.impairment, now);
    }
    return LoopAnswer::kDone;
  }

  /// Ends a tick: publishes the snapshot, in which the caller has set what only its side has, and records the tick.
  void publish() {
    snapshot_.side = side_.figures();
    snapshot_.view = side_.node().view();
    snapshot_.view.reduced |= reduced_;
    if (adapter_) {
      snapshot_.adapter = adapter_->figures();
      snapshot_.adapter.unknown_peer = adapter_channel_->unknown_peer();
    }
    snapshots_.write(snapshot_);
    const std::uint64_t tick = ticks_++;
    if (record_buffer_ == nullptr) return;
    record_buffer_->add_tick(tick, config_number_, side_.input(), side_.output(), side_.node().view());
    if (record_buffer_->link_due(tick))
      record_buffer_->add_link(link_sample(side_.input().now, side_.figures()));
  }

  UdpChannel channel_;
  std::unique_ptr<UnixChannel> adapter_channel_;
  std::optional<typename Parts::Adapter> adapter_{};
  typename Parts::Side side_;
  RecordBuffer* record_buffer_ = nullptr;  // null: no recording
  std::uint64_t ticks_ = 0;                // number of steps of the node
  std::uint32_t config_number_ = 0;        // number of the node's configuration
  std::uint32_t reduced_;
  Snapshot snapshot_{};
  StopLevel stops_;
  Mailbox<Command, LoopAnswer> mailbox_;
  LatestValue<Snapshot> snapshots_;
};

}  // namespace longreach
