#pragma once
// Between a side's loop and the recorder: what the loop writes down in its ticks, and what other threads add
// beside it (configurations, events). The loop's half is in the tape of each side (master_tape, slave_tape);
// here is what both have in common, for the threads around the loop.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "common/link/delay_monitor.hpp"
#include "common/recording/mcap_writer.hpp"
#include "proto/recording.pb.h"

namespace longreach {

/// Now and then: the link and the loop, as status shows them.
struct LinkSample {
  Time now{};
  LinkFigures link{};
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t session = 0;  // 0: none
  std::uint64_t missed_ticks = 0;
  std::uint64_t ticks_late_100ms = 0;
};

class RecordBuffer {
 public:
  /// `side`: master or slave, the first part of all topics. `to_log_time`: from the loop's clock to the
  /// file's.
  RecordBuffer(std::string side, Duration to_log_time);
  virtual ~RecordBuffer() = default;
  RecordBuffer(const RecordBuffer&) = delete;
  RecordBuffer& operator=(const RecordBuffer&) = delete;

  /// Any thread but the loop's. A configuration is added before the loop gets it.
  void add_config(Time now, std::uint32_t number, std::string text);
  void add_event(Time now, std::string text);

  /// Recorder: once, before the first drain.
  void declare(McapWriter& writer);
  /// Recorder: writes all that has been gathered.
  void drain(McapWriter& writer);
  /// Recorder: nothing is taken or kept any more.
  void close();
  /// Configurations and events that wait for the recorder.
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
  [[nodiscard]] std::string topic(const char* name) const { return "/" + side_ + "/" + name; }
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
  std::atomic<std::uint64_t> dropped_{0};  // written by the loop alone
  mutable std::mutex noting_;              // never the loop
  std::vector<Note> notes_;
  std::uint16_t config_channel_ = 0, event_channel_ = 0, link_channel_ = 0;
  recording::Link link_;
};

/// A configuration as a recording keeps it: what is set, every digit.
std::string recorded_text(const google::protobuf::Message& config);

/// From CLOCK_MONOTONIC to Unix time, now.
Duration monotonic_to_unix();

}  // namespace longreach
