#include "common/recording/record_buffer.hpp"

#include <google/protobuf/text_format.h>

#include <chrono>
#include <numeric>
#include <utility>

#include "common/loop/side_clock.hpp"

namespace longreach {

LinkSample link_sample(Time now, const SideFigures& figures) {
  LinkSample out;
  out.now = now;
  out.link = figures.link;
  out.accepted = figures.accepted;
  out.rejected = std::accumulate(figures.rejected.begin(), figures.rejected.end(), std::uint64_t{0});
  out.session = figures.session;
  out.missed_ticks = figures.loop.missed_ticks;
  out.ticks_late_100ms = figures.loop.ticks_late_100ms;
  return out;
}

RecordBuffer::RecordBuffer(std::string side, Duration to_log_time)
    : side_(std::move(side)), to_log_time_(to_log_time) {}

void RecordBuffer::add_config(Time now, std::uint32_t number, std::string text) {
  note({now, true, number, std::move(text)});
}

void RecordBuffer::add_event(Time now, std::string text) { note({now, false, 0, std::move(text)}); }

void RecordBuffer::note(Note note) {
  const std::lock_guard lock(noting_);
  if (open()) notes_.push_back(std::move(note));
}

void RecordBuffer::close() {
  const std::lock_guard lock(noting_);
  open_.store(false, std::memory_order_relaxed);
  std::vector<Note>().swap(notes_);
}

void RecordBuffer::declare(McapWriter& writer) {
  config_channel_ = writer.add_channel(topic("config"), *recording::Config::descriptor());
  event_channel_ = writer.add_channel(topic("event"), *recording::Event::descriptor());
  link_channel_ = writer.add_channel(topic("link"), *recording::Link::descriptor());
  declare_ticks(writer);
}

void RecordBuffer::drain(McapWriter& writer) {
  // Notes first: a configuration comes before the ticks that work with it.
  std::vector<Note> notes;
  {
    const std::lock_guard lock(noting_);
    notes.swap(notes_);
  }
  for (const Note& note : notes) write_note(note, writer);
  drain_ticks(writer);
}

void RecordBuffer::write_note(const Note& note, McapWriter& writer) {
  if (note.is_config) {
    recording::Config config;
    config.set_number(note.number);
    config.set_text(note.text);
    writer.write(config_channel_, log_time_ns(note.now), config);
  } else {
    recording::Event event;
    event.set_text(note.text);
    writer.write(event_channel_, log_time_ns(note.now), event);
  }
}

void RecordBuffer::write_link(const LinkSample& s, McapWriter& writer) {
  link_.Clear();
  if (s.link.rtt_s) link_.set_rtt_s(*s.link.rtt_s);
  link_.set_jitter_s(s.link.jitter_s);
  link_.set_loss(s.link.loss);
  link_.set_reorder(s.link.reorder);
  link_.set_silence_s(s.link.silence_s);
  link_.set_rate_hz(s.link.rate_hz);
  link_.set_bytes_per_s(s.link.bytes_per_s);
  link_.set_accepted(s.accepted);
  link_.set_rejected(s.rejected);
  link_.set_session(s.session);
  link_.set_missed_ticks(s.missed_ticks);
  link_.set_ticks_late_100ms(s.ticks_late_100ms);
  link_.set_ticks_not_recorded(ticks_dropped());
  writer.write(link_channel_, log_time_ns(s.now), link_);
}

std::string recorded_text(const google::protobuf::Message& config) {
  std::string text;
  google::protobuf::TextFormat::PrintToString(config, &text);
  return text;
}

Duration monotonic_to_unix() {
  using std::chrono::duration_cast;
  return duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()) -
         boottime_now().time_since_epoch();
}

}  // namespace longreach
