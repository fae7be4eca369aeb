#pragma once
// Replays one side of a recording: reads its messages in order, steps the node with them, and compares the
// results.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/recording/mcap_reader.hpp"
#include "deploy/lab/recording/replay.hpp"
#include "master/master_node.hpp"
#include "proto/config.pb.h"
#include "proto/recording.pb.h"
#include "slave/slave_node.hpp"

namespace longreach {

class NodeReplay {
 public:
  explicit NodeReplay(std::string side);
  virtual ~NodeReplay() = default;
  NodeReplay(const NodeReplay&) = delete;
  NodeReplay& operator=(const NodeReplay&) = delete;

  /// Processes a message. `name` is the name of the topic without the side. Messages after a difference or a
  /// stop are ignored.
  void take(std::string_view name, std::string_view bytes);
  [[nodiscard]] const SideReplay& result() const { return result_; }

  /// Ends the replay for this reason, for example because a part of the recording is lost.
  void stop(std::string why) { result_.stopped = std::move(why); }

 protected:
  /// Processes a message from a topic of this node.
  virtual void take_own(std::string_view name, std::string_view bytes) = 0;
  virtual void begin(const std::string& config) = 0;
  virtual void configure(const std::string& config) = 0;
  [[nodiscard]] virtual bool began() const = 0;

  /// Returns whether the node can run this tick: the node has been started, the tick is the next one, and its
  /// configuration and messages are present.
  bool prepare(std::uint64_t tick, std::uint32_t config, std::int64_t now_ns, bool complete);
  /// Stores the first difference between the two messages, if there is one.
  void compare(const char* what, const google::protobuf::Message& recorded,
               const google::protobuf::Message& replayed);
  void book_tick(std::size_t messages);
  [[nodiscard]] bool over() const { return result_.difference || !result_.stopped.empty(); }
  [[nodiscard]] bool is_last_tick(std::uint64_t tick) const { return began() && tick + 1 == next_tick_; }

 private:
  SideReplay result_{};
  std::map<std::uint32_t, std::string> configs_;
  std::uint32_t config_ = 0;  // number of the current configuration
  std::uint64_t next_tick_ = 0;
  std::int64_t first_ns_ = 0, now_ns_ = 0;
  std::string recorded_bytes_, replayed_bytes_;
};

/// The part that is common to the replays of both sides.
template <class Node, class Config, class Tick, class Output, class View>
class ReplayOf : public NodeReplay {
 public:
  using NodeReplay::NodeReplay;

 protected:
  /// Steps the node with the recorded input and compares its output with the recorded one.
  virtual void step() = 0;
  /// Processes a message that the node received before the next tick.
  virtual void take_received(std::string_view name, std::string_view bytes) = 0;
  template <class Input>
  void step_node(const Input& in, std::size_t messages);

  Tick tick_;
  std::unique_ptr<Node> node_;

 private:
  void take_own(std::string_view name, std::string_view bytes) override;
  void begin(const std::string& config) override;
  void configure(const std::string& config) override;
  [[nodiscard]] bool began() const override { return node_ != nullptr; }

  Output output_;
  View view_, shown_;
};

class MasterReplay : public ReplayOf<MasterNode, proto::MasterConfig, recording::MasterTick,
                                     recording::MasterOutput, recording::MasterView> {
 public:
  MasterReplay() : ReplayOf("master") {}

 private:
  void step() override;
  void take_received(std::string_view name, std::string_view bytes) override;

  std::vector<Received<StiffnessReport>> reports_;
  std::vector<Received<Telemetry>> telemetry_;
  std::vector<Received<BodyPoses>> bodies_;
};

class SlaveReplay : public ReplayOf<SlaveNode, proto::SlaveConfig, recording::SlaveTick,
                                    recording::SlaveOutput, recording::SlaveView> {
 public:
  SlaveReplay() : ReplayOf("slave") {}

 private:
  void step() override;
  void take_received(std::string_view name, std::string_view bytes) override;

  std::vector<Received<MotionCommand>> commands_;
};

}  // namespace longreach
