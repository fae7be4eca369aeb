#pragma once
// Collects the records of a side's loop for a recording: the exact inputs and outputs of each tick, so that a node can be
// replayed, and, less often, its view. The functions that the loop calls copy data into preallocated memory; they do not
// wait, allocate or make system calls. If there is no space for a tick, it is dropped and counted.
//
// `Side` names what differs between the sides:
//
//   Input, Output, View                 structs of the node; Input is a TickInput with spans of Received messages
//   TickInput
//   Messages                            std::tuple of the types of these messages
//   Tick, ShownView                     recorded messages
//   kName                               "master" or "slave", the first part of all topics
//   for_each_message(input, f)          calls f with each span
//   count_messages(input, recorded)     records their numbers

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <variant>

#include "common/recording/record_buffer.hpp"
#include "common/recording/record_rates.hpp"
#include "common/recording/record_ring.hpp"
#include "common/recording/recorded_values.hpp"

namespace longreach {

template <class Side>
class TickBuffer : public RecordBuffer {
 public:
  using Input = typename Side::Input;
  using Output = typename Side::Output;
  using View = typename Side::View;

  /// `rate_hz` is the rate of the loop. `to_log_time` is added to the side's clock to obtain the log time.
  TickBuffer(double rate_hz, Duration to_log_time)
      : RecordBuffer(Side::kName, to_log_time),
        view_every_(ticks_between(rate_hz, kViewHz)),
        link_every_(ticks_between(rate_hz, kLinkHz)),
        ring_(record_capacity(rate_hz)) {}

  /// Loop thread: adds step `tick` (from 0) with configuration `config`, and the resulting view of the node.
  void add_tick(std::uint64_t tick, std::uint32_t config, const Input& input, const Output& output,
                const View& view) {
    if (!open()) return;
    std::size_t messages = 0;
    Side::for_each_message(input, [&messages](const auto& span) { messages += span.size(); });
    // A tick is recorded completely or not at all, because an input without its messages is useless.
    if (ring_.room() < messages + 2) {
      drop_tick();
      return;
    }
    Side::for_each_message(input, [this](const auto& span) {
      for (const auto& message : span) ring_.next() = message;
    });
    ring_.next() = TickRecord{tick, config, input, output};
    if (tick % view_every_ == 0) ring_.next() = ViewRecord{tick, input.now, view};
    ring_.publish();
  }
  /// Loop thread: returns whether a record of the link is due after this tick.
  [[nodiscard]] bool link_due(std::uint64_t tick) const { return tick % link_every_ == 0; }
  /// Loop thread: adds a record of the link.
  void add_link(const LinkSample& sample) {
    if (!open() || ring_.room() == 0) return;
    ring_.next() = sample;
    ring_.publish();
  }

 private:
  /// The messages of `input` are recorded before it, and only their numbers are used.
  struct TickRecord {
    std::uint64_t tick = 0;
    std::uint32_t config = 0;
    Input input{};
    Output output{};
  };
  struct ViewRecord {
    std::uint64_t tick = 0;
    Time now{};
    View view{};
  };
  template <class Tuple>
  struct RecordsWith;
  template <class... Message>
  struct RecordsWith<std::tuple<Message...>> {
    using Type = std::variant<Received<Message>..., TickRecord, ViewRecord, LinkSample>;
  };
  using Record = typename RecordsWith<typename Side::Messages>::Type;

  /// The topic of a type of record, and the message that is filled for each record.
  struct Topic {
    std::uint16_t channel = 0;
    std::unique_ptr<google::protobuf::Message> message{};
  };

  void declare_ticks(McapWriter& writer) override {
    std::size_t i = 0;
    const auto declare = [&](const std::string& name, const google::protobuf::Message& message) {
      topics_[i++] = {writer.add_channel(topic(name), *message.GetDescriptor()),
                      std::unique_ptr<google::protobuf::Message>(message.New())};
    };
    const auto declare_received = [&declare]<class Message>(const Message&) {
      using Form = ReceivedForm<Message>;
      declare(std::string("received_") + Form::kName, Form::Type::default_instance());
    };
    std::apply([&](const auto&... message) { (declare_received(message), ...); }, typename Side::Messages{});
    declare("tick", Side::Tick::default_instance());
    declare("view", Side::ShownView::default_instance());
  }

  void drain_ticks(McapWriter& writer) override {
    for (std::size_t i = 0; i < ring_.capacity(); ++i) {
      const Record* record = ring_.front();
      if (record == nullptr) return;
      std::visit([&](const auto& r) { write_record(r, topics_[record->index()], writer); }, *record);
      ring_.pop();
    }
  }

  template <class Message>
  void write_record(const Received<Message>& record, Topic& to, McapWriter& writer) {
    to_recorded(record, cleared<typename ReceivedForm<Message>::Type>(to));
    writer.write(to.channel, log_time_ns(record.received), *to.message);
  }
  void write_record(const TickRecord& record, Topic& to, McapWriter& writer) {
    auto& out = cleared<typename Side::Tick>(to);
    out.set_tick(record.tick);
    out.set_config(record.config);
    to_message<typename Side::TickInput>(record.input, *out.mutable_input());
    Side::count_messages(record.input, *out.mutable_input());
    to_message(record.output, *out.mutable_output());
    writer.write(to.channel, log_time_ns(record.input.now), out);
  }
  void write_record(const ViewRecord& record, Topic& to, McapWriter& writer) {
    auto& out = cleared<typename Side::ShownView>(to);
    to_message(record.view, out);
    out.set_tick(record.tick);
    writer.write(to.channel, log_time_ns(record.now), out);
  }
  void write_record(const LinkSample& record, Topic& /*to*/, McapWriter& writer) {
    write_link(record, writer);
  }

  template <class Message>
  static Message& cleared(Topic& topic) {
    topic.message->Clear();
    return static_cast<Message&>(*topic.message);
  }

  std::uint64_t view_every_, link_every_;  // intervals, ticks
  RecordRing<Record> ring_;
  std::array<Topic, std::variant_size_v<Record>> topics_{};
};

}  // namespace longreach
