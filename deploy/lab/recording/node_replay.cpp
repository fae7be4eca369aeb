#include "deploy/lab/recording/node_replay.hpp"

#include "common/config/config.hpp"
#include "common/recording/recorded_values.hpp"
#include "common/recording/recording_error.hpp"
#include "deploy/lab/recording/message_difference.hpp"

namespace longreach {
namespace {

template <class Message>
void parse(std::string_view bytes, Message& out) {
  if (!out.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    throw RecordingError("a message does not match the schema " + out.GetTypeName());
}

/// A message that the node received before a tick.
template <class Message>
Received<Message> parsed(std::string_view bytes) {
  typename ReceivedForm<Message>::Type message;
  parse(bytes, message);
  return from_recorded<Message>(message);
}

template <class Message>
auto struct_of(const std::string& config) {
  Message message;
  load_text("the recorded configuration", config, message);
  return to_struct(message);
}

}  // namespace

NodeReplay::NodeReplay(std::string side) { result_.side = std::move(side); }

void NodeReplay::take(std::string_view name, std::string_view bytes) {
  if (over()) return;
  if (name == "config") {
    recording::Config config;
    parse(bytes, config);
    configs_[config.number()] = config.text();
  } else {
    take_own(name, bytes);
  }
}

bool NodeReplay::prepare(std::uint64_t tick, std::uint32_t config, std::int64_t now_ns, bool complete) {
  if (!began() && tick != 0) {
    stop("the recording starts at tick " + std::to_string(tick) +
         ", so the previous state of the node is unknown; a replay requires a recording from the "
         "start (--record)");
    return false;
  }
  if (tick != next_tick_) {
    stop("ticks " + std::to_string(next_tick_) + " to " + std::to_string(tick - 1) +
         " are missing because the recording could not be written fast enough");
    return false;
  }
  if (!complete) {
    stop("some messages that tick " + std::to_string(tick) + " used are not in the recording");
    return false;
  }
  if (!began() || config != config_) {
    const auto text = configs_.find(config);
    if (text == configs_.end()) {
      stop("configuration " + std::to_string(config) + " is not in the recording");
      return false;
    }
    began() ? configure(text->second) : begin(text->second);
    config_ = config;
  }
  if (tick == 0) first_ns_ = now_ns;
  now_ns_ = now_ns;
  next_tick_ = tick + 1;
  return true;
}

void NodeReplay::compare(const char* what, const google::protobuf::Message& recorded,
                         const google::protobuf::Message& replayed) {
  recorded.SerializeToString(&recorded_bytes_);
  replayed.SerializeToString(&replayed_bytes_);
  if (recorded_bytes_ == replayed_bytes_) return;
  auto difference = first_difference(recorded, replayed);
  if (!difference) return;
  result_.difference =
      ReplayDifference{next_tick_ - 1, to_seconds(Duration(now_ns_ - first_ns_)),
                       std::string(what) + "." + difference->field, difference->a, difference->b};
}

void NodeReplay::book_tick(std::size_t messages) {
  if (over()) return;
  ++result_.ticks;
  result_.messages += messages;
  result_.seconds = to_seconds(Duration(now_ns_ - first_ns_));
}

template <class Node, class Config, class Tick, class Output, class View>
void ReplayOf<Node, Config, Tick, Output, View>::begin(const std::string& config) {
  node_ = std::make_unique<Node>(struct_of<Config>(config));
}

template <class Node, class Config, class Tick, class Output, class View>
void ReplayOf<Node, Config, Tick, Output, View>::configure(const std::string& config) {
  node_->configure(struct_of<Config>(config));
}

template <class Node, class Config, class Tick, class Output, class View>
void ReplayOf<Node, Config, Tick, Output, View>::take_own(std::string_view name, std::string_view bytes) {
  if (name == "tick") {
    parse(bytes, tick_);
    step();
  } else if (name == "view") {
    parse(bytes, view_);
    if (!is_last_tick(view_.tick())) return;
    shown_.Clear();
    to_message(node_->view(), shown_);
    shown_.set_tick(view_.tick());
    compare("view", view_, shown_);
  } else {
    take_received(name, bytes);
  }
}

template <class Node, class Config, class Tick, class Output, class View>
template <class Input>
void ReplayOf<Node, Config, Tick, Output, View>::step_node(const Input& in, std::size_t messages) {
  const auto out = node_->step(in);
  output_.Clear();
  to_message(out, output_);
  compare("output", tick_.output(), output_);
  book_tick(messages);
}

void MasterReplay::take_received(std::string_view name, std::string_view bytes) {
  if (name == "received_report") reports_.push_back(parsed<StiffnessReport>(bytes));
  if (name == "received_telemetry") telemetry_.push_back(parsed<Telemetry>(bytes));
  if (name == "received_bodies") bodies_.push_back(parsed<BodyPoses>(bytes));
}

void MasterReplay::step() {
  const recording::MasterInput& recorded = tick_.input();
  const bool complete = reports_.size() == recorded.reports() && telemetry_.size() == recorded.telemetry() &&
                        bodies_.size() == recorded.bodies();
  if (!prepare(tick_.tick(), tick_.config(), recorded.now_ns(), complete)) return;
  const MasterInput in{from_recorded<MasterTickInput>(recorded), reports_, telemetry_, bodies_};
  step_node(in, reports_.size() + telemetry_.size() + bodies_.size());
  reports_.clear();
  telemetry_.clear();
  bodies_.clear();
}

void SlaveReplay::take_received(std::string_view name, std::string_view bytes) {
  if (name == "received_command") commands_.push_back(parsed<MotionCommand>(bytes));
}

void SlaveReplay::step() {
  const recording::SlaveInput& recorded = tick_.input();
  const bool complete = commands_.size() == recorded.commands();
  if (!prepare(tick_.tick(), tick_.config(), recorded.now_ns(), complete)) return;
  const SlaveInput in{from_recorded<SlaveTickInput>(recorded), commands_};
  step_node(in, commands_.size());
  commands_.clear();
}

}  // namespace longreach
