#pragma once
// Buffers the records of the slave's loop for a recording: the exact inputs and outputs of each tick, so that
// the node can be replayed, and, less often, its view. The functions for the loop copy into preallocated
// memory; they do not block, allocate or make system calls. Ticks that do not fit are dropped and counted.

#include <cstdint>
#include <variant>

#include "common/recording/record_buffer.hpp"
#include "common/recording/record_ring.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

/// A step of the node. `input` does not contain the messages; they are recorded before it.
struct SlaveTickRecord {
  std::uint64_t tick = 0;    // number of the step, from 0 at the first step of the node
  std::uint32_t config = 0;  // number of the node's configuration
  std::uint32_t commands = 0;
  SlaveInput input{};
  SlaveOutput output{};
};

class SlaveRecordBuffer : public RecordBuffer {
 public:
  SlaveRecordBuffer(double rate_hz, Duration to_log_time);

  /// For the loop: adds a step and the resulting view of the node.
  void add_tick(std::uint64_t tick, std::uint32_t config, const SlaveInput& input, const SlaveOutput& output,
                const SlaveView& view);
  /// For the loop: returns whether a record of the link is due after this tick.
  [[nodiscard]] bool link_due(std::uint64_t tick) const { return tick % link_every_ == 0; }
  void add_link(const LinkSample& sample);

 private:
  struct ViewRecord {
    std::uint64_t tick = 0;
    Time now{};
    SlaveView view{};
  };
  using Record = std::variant<Received<MotionCommand>, SlaveTickRecord, ViewRecord, LinkSample>;

  void declare_ticks(McapWriter& writer) override;
  void drain_ticks(McapWriter& writer) override;
  void write_record(const Received<MotionCommand>& record, McapWriter& writer);
  void write_record(const SlaveTickRecord& record, McapWriter& writer);
  void write_record(const ViewRecord& record, McapWriter& writer);
  void write_record(const LinkSample& record, McapWriter& writer) { write_link(record, writer); }

  std::uint64_t view_every_, link_every_;  // in ticks
  RecordRing<Record> ring_;
  std::uint16_t command_channel_ = 0, tick_channel_ = 0, view_channel_ = 0;
  recording::ReceivedCommand command_;
  recording::SlaveTick tick_;
  recording::SlaveView view_;
};

/// Writes the input without the messages; the caller sets the number of messages in `out`.
void write(const SlaveInput& input, recording::SlaveInput& out);
void write(const SlaveOutput& output, recording::SlaveOutput& out);
void write(const SlaveView& view, recording::SlaveView& out);
/// Throws RecordingError.
SlaveInput read(const recording::SlaveInput& in);

}  // namespace longreach
