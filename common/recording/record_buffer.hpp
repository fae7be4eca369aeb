#pragma once
// Buffer between the threads of a side and the recorder. The loop adds records in its ticks; other threads
// add configurations and events. This class contains the part for the other threads; TickBuffer adds the part for the
// loop.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "common/link/delay_monitor.hpp"
#include "common/loop/side_figures.hpp"
#include "common/recording/mcap_writer.hpp"
#include "proto/recording.pb.h"

namespace longreach {

/// Periodic sample of the link and loop statistics that the RPC status also contains.
struct LinkSample {
  Time now{};
  LinkFigures link{};
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t session = 0;  // 0: no session
  std::uint64_t missed_ticks = 0;
  std::uint64_t ticks_late_100ms = 0;
};

/// Returns the statistics that a recording contains.
LinkSample link_sample(Time now, const SideFigures& figures);

class RecordBuffer {
 public:
  /// `side`, "master" or "slave", is the first part of all topics. `to_log_time` is the offset from the clock
  /// of the loop to the log time of the file.
  RecordBuffer(std::string side, Duration to_log_time);
  virtual ~RecordBuffer() = default;
  RecordBuffer(const RecordBuffer&) = delete;
  RecordBuffer& operator=(const RecordBuffer&) = delete;

  /// Add a configuration or an event; called by any thread except the loop. A configuration must be added
  /// before the loop receives it.
  void add_config(Time now, std::uint32_t number, std::string text);
  void add_event(Time now, std::string text);

  /// Declares the topics. Called once by the recorder, before the first drain().
  void declare(McapWriter& writer);
  /// Writes all collected records. Called by the recorder.
  void drain(McapWriter& writer);
  /// Stops collecting records. Called by the recorder.
  void close();
  /// Returns the number of configurations and events that are not yet written.
  [[nodiscard]] std::size_t notes() const {
    const std::lock_guard lock(noting_);
    return notes_.size();
  }
  [[nodiscard]] std::uint64_t ticks_dropped() const { return dropped_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t log_time_ns(Time now) const {
    return static_cast<std::uint64_t>((now + to_log_time_).time_since_epoch().count());
  }

 protected:
  [[nodiscard]] bool open() const { return open_.load(std::memory_order_relaxed); }
  void drop_tick() { dropped_.store(ticks_dropped() + 1, std::memory_order_relaxed); }
  [[nodiscard]] std::string topic(const std::string& name) const { return "/" + side_ + "/" + name; }
  void write_link(const LinkSample& sample, McapWriter& writer);

  virtual void declare_ticks(McapWriter& writer) = 0;
  virtual void drain_ticks(McapWriter& writer) = 0;

 private:
  struct Note {
    Time now{};
    bool is_config = false;
    std::uint32_t number = 0;
    std::string text;
  };

  void note(Note note);
  void write_note(const Note& note, McapWriter& writer);

  std::string side_;
  Duration to_log_time_;
  std::atomic<bool> open_{true};
  std::atomic<std::uint64_t> dropped_{0};  // written by the loop only
  mutable std::mutex noting_;              // never locked by the loop
  std::vector<Note> notes_;
  std::uint16_t config_channel_ = 0, event_channel_ = 0, link_channel_ = 0;
  recording::Link link_;
};

/// Returns the text of a configuration for a recording: the fields that are set, in full precision.
std::string recorded_text(const google::protobuf::Message& config);

/// Returns the current offset from the clock of the loop (CLOCK_BOOTTIME) to Unix time.
Duration monotonic_to_unix();

}  // namespace longreach
