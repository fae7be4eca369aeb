// A recording run again: bit for bit the same, or the first value that is not. LONGREACH_FULL=1: ten minutes.
#include "deploy/lab/recording/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>

#include "common/config/config.hpp"
#include "common/link/header.hpp"
#include "common/recording/mcap_reader.hpp"
#include "common/recording/mcap_writer.hpp"
#include "common/recording/quiet_protobuf.hpp"
#include "common/recording/recording_error.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/recording/message_difference.hpp"
#include "proto/recording.pb.h"
#include "tests/support/temporary_folder.hpp"

namespace longreach::replay_test {
namespace {

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A session in which something happens all the time: approach, touches, presses, both modes, scales, holds,
/// stops, clutch, a handle that is let go.
void record_session(const std::filesystem::path& file, double seconds, const std::string& profile) {
  const proto::LabConfig config = configure({"profile=" + profile}, LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 11);
  lab.record(file);
  while (lab.now_s() < seconds) {
    const auto ms = static_cast<int>(std::llround(1e3 * lab.now_s()));
    OperatorRequests& requests = lab.requests();
    if (ms % 23'000 == 21'000) requests.mode = MotionMode::kRate;
    if (ms % 23'000 == 22'000) requests.mode = MotionMode::kPosition;
    if (ms % 17'000 == 16'000) requests.scale_steps = -1;
    if (ms % 17'000 == 16'500) requests.scale = 0.8;
    if (ms % 29'000 == 28'000) requests.hold = true;
    if (ms % 61'000 == 60'000) requests.stop = true;
    if (ms % 29'000 == 28'700 || ms % 61'000 == 60'700) requests.engage = true;
    requests.clutch = ms % 31'000 > 30'500;
    if (ms % 37'000 == 36'000) lab.let_go(true);
    if (ms % 37'000 == 36'600) lab.let_go(false);
    lab.step();
  }
  lab.end_recording();
}

using Change = std::function<bool(const std::string& topic, google::protobuf::Message& message)>;

/// The file with another content: `change` returns whether a message stays.
void rewrite(const std::filesystem::path& from, const std::filesystem::path& to, const Change& change) {
  McapReader reader(from);
  RecordingFile file(to);
  McapWriter writer(file, "test");
  std::map<std::string, std::uint16_t> channels;
  while (const auto message = reader.next()) {
    const std::string& topic = message->channel->topic;
    const std::string& type = reader.schemas().at(message->channel->schema).name;
    const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
    const std::unique_ptr<google::protobuf::Message> copy(
        google::protobuf::MessageFactory::generated_factory()->GetPrototype(descriptor)->New());
    ASSERT_TRUE(copy->ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
    if (!change(topic, *copy)) continue;
    if (!channels.contains(topic)) channels[topic] = writer.add_channel(topic, *descriptor);
    writer.write(channels[topic], message->log_time_ns, *copy);
  }
  writer.finish();
}

/// Flips the last bit.
double nudged(double value) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u); }

const SideReplay& side_of(const FileReplay& replay, const std::string& side) {
  return *std::find_if(replay.sides.begin(), replay.sides.end(),
                       [&](const SideReplay& s) { return s.side == side; });
}

class Replay : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    record_session(file("session"), 20.0, "analog");
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::filesystem::path file(const std::string& name) { return folder_->path() / (name + ".mcap"); }
  static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> Replay::folder_;

TEST_F(Replay, IsBitForBitWhatWasRecorded) {
  const double seconds = std::getenv("LONGREACH_FULL") != nullptr ? 600.0 : 40.0;
  record_session(file("long"), seconds, "moon");
  const auto began = std::chrono::steady_clock::now();
  const FileReplay replayed = replay_file(file("long"));
  const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  EXPECT_TRUE(replayed.whole);
  EXPECT_EQ(replayed.commit, commit());
  ASSERT_EQ(replayed.sides.size(), 2u);
  for (const SideReplay& side : replayed.sides) {
    EXPECT_FALSE(side.difference) << side.side << " tick " << side.difference->tick << " "
                                  << side.difference->field;
    EXPECT_EQ(side.stopped, "") << side.side;
    EXPECT_EQ(side.ticks, static_cast<std::uint64_t>(std::llround(1e3 * seconds))) << side.side;
    EXPECT_GT(static_cast<double>(side.messages), 20.0 * seconds) << side.side;
  }
  const double times = seconds / spent_s;
  std::printf("%.0f s replayed in %.2f s: %.0f times faster than real time\n", seconds, spent_s, times);
  if (std::getenv("LONGREACH_FULL") != nullptr) {
    EXPECT_GT(times, 20.0);
  }
}

TEST_F(Replay, NamesTheFirstDifferenceOfAnInputThatWasChanged) {
  rewrite(file("session"), file("flipped"), [](const std::string& topic, google::protobuf::Message& message) {
    if (topic != "/master/tick") return true;
    auto& tick = static_cast<recording::MasterTick&>(message);
    auto& hand = *tick.mutable_input()->mutable_handle()->mutable_position_m();
    if (tick.tick() == 9000) hand.set_x(hand.x() + 1e-4);
    return true;
  });
  const FileReplay replayed = replay_file(file("flipped"));
  const SideReplay& master = side_of(replayed, "master");
  ASSERT_TRUE(master.difference);
  EXPECT_EQ(master.difference->tick, 9000u);
  EXPECT_NEAR(master.difference->time_s, 9.0, 1e-9);
  EXPECT_EQ(master.difference->field.rfind("output.wrench.force_n.", 0), 0u) << master.difference->field;
  EXPECT_NE(master.difference->recorded, master.difference->replayed);
  EXPECT_EQ(master.ticks, 9000u);
  EXPECT_FALSE(side_of(replayed, "slave").difference) << "the other side is another replay";
  std::ostringstream out, err;
  EXPECT_EQ(replay({file("flipped").string()}, out, err), 1);
  EXPECT_NE(out.str().find("master: first difference at tick 9000 (9.000000 s): output.wrench.force_n."),
            std::string::npos)
      << out.str();
}

TEST_F(Replay, NamesTheLastBitOfAnOutput) {
  double recorded = 0.0;
  rewrite(file("session"), file("output"), [&](const std::string& topic, google::protobuf::Message& message) {
    if (topic != "/slave/tick") return true;
    auto& tick = static_cast<recording::SlaveTick&>(message);
    if (tick.tick() != 1234) return true;
    auto& joints = *tick.mutable_output()->mutable_joint_setpoint_rad();
    recorded = nudged(joints.joint4());
    joints.set_joint4(recorded);
    return true;
  });
  const SideReplay slave = side_of(replay_file(file("output")), "slave");
  ASSERT_TRUE(slave.difference);
  EXPECT_EQ(slave.difference->tick, 1234u);
  EXPECT_EQ(slave.difference->field, "output.joint_setpoint_rad.joint4");
  EXPECT_EQ(std::stod(slave.difference->recorded), recorded);
  EXPECT_EQ(std::stod(slave.difference->replayed), nudged(recorded));
}

TEST_F(Replay, NamesAMessageThatWasNotSent) {
  std::uint64_t at = 0;
  rewrite(file("session"), file("command"),
          [&](const std::string& topic, google::protobuf::Message& message) {
            if (topic != "/master/tick") return true;
            auto& tick = static_cast<recording::MasterTick&>(message);
            if (at == 0 && tick.tick() > 500 && tick.output().has_command()) {
              at = tick.tick();
              tick.mutable_output()->clear_command();
            }
            return true;
          });
  const SideReplay master = side_of(replay_file(file("command")), "master");
  ASSERT_TRUE(master.difference);
  EXPECT_EQ(master.difference->tick, at);
  EXPECT_EQ(master.difference->field, "output.command");
  EXPECT_EQ(master.difference->recorded, "absent");
}

TEST_F(Replay, NamesWhatIsShownElsewhere) {
  rewrite(file("session"), file("view"), [](const std::string& topic, google::protobuf::Message& message) {
    if (topic != "/slave/view") return true;
    auto& view = static_cast<recording::SlaveView&>(message);
    if (view.tick() == 3000) view.set_state(recording::FAULT);
    return true;
  });
  const SideReplay slave = side_of(replay_file(file("view")), "slave");
  ASSERT_TRUE(slave.difference);
  EXPECT_EQ(slave.difference->tick, 3000u);
  EXPECT_EQ(slave.difference->field, "view.state");
  EXPECT_EQ(slave.difference->recorded, "FAULT");
}

TEST_F(Replay, SaysWhyItCannotBegin) {
  rewrite(file("session"), file("late"), [](const std::string& topic, google::protobuf::Message& message) {
    if (topic != "/master/tick") return !topic.starts_with("/slave/");
    return static_cast<recording::MasterTick&>(message).tick() >= 5000;
  });
  const SideReplay master = side_of(replay_file(file("late")), "master");
  EXPECT_FALSE(master.difference);
  EXPECT_EQ(master.ticks, 0u);
  EXPECT_EQ(master.stopped.rfind("the recording starts at tick 5000, ", 0), 0u) << master.stopped;
  EXPECT_NE(master.stopped.find("--record"), std::string::npos);
  std::ostringstream out, err;
  EXPECT_EQ(replay({file("late").string()}, out, err), 2);
}

TEST_F(Replay, SaysWhatIsMissing) {
  rewrite(file("session"), file("gap"), [](const std::string& topic, google::protobuf::Message& message) {
    if (topic == "/slave/received_command")
      return static_cast<recording::ReceivedCommand&>(message).receipt().sequence() != 700;
    if (topic != "/master/tick") return true;
    const auto tick = static_cast<recording::MasterTick&>(message).tick();
    return tick < 4000 || tick > 4009;
  });
  const FileReplay replayed = replay_file(file("gap"));
  const SideReplay& master = side_of(replayed, "master");
  EXPECT_FALSE(master.difference);
  EXPECT_EQ(master.ticks, 4000u);
  // Where a message was taken in the gap, too, that is as good a reason.
  EXPECT_EQ(master.stopped.rfind("ticks 4000 to 4009 are missing", 0), 0u) << master.stopped;
  const SideReplay& slave = side_of(replayed, "slave");
  EXPECT_FALSE(slave.difference);
  EXPECT_GT(slave.ticks, 2000u);
  EXPECT_EQ(slave.stopped.rfind("some messages that tick ", 0), 0u) << slave.stopped;
}

TEST_F(Replay, FollowsARecordingThatWasCut) {
  const std::string bytes = read_all(file("session"));
  std::ofstream(file("cut"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  const FileReplay replayed = replay_file(file("cut"));
  EXPECT_FALSE(replayed.whole);
  for (const SideReplay& side : replayed.sides) {
    EXPECT_FALSE(side.difference);
    EXPECT_EQ(side.stopped, "");
    EXPECT_GT(side.ticks, 5000u);
    EXPECT_LT(side.ticks, 20'000u);
  }
  std::ostringstream out, err;
  EXPECT_EQ(replay({file("cut").string()}, out, err), 0) << err.str();
  std::array<char, 80> expected{};
  std::snprintf(expected.data(), expected.size(), "cut.mcap is truncated: data after %.1f s is lost",
                replayed.last_s);
  EXPECT_GT(replayed.last_s, 4.0);
  EXPECT_NE(out.str().find(expected.data()), std::string::npos) << out.str();
}

TEST_F(Replay, NamesTheFileOfAMessageThatCannotBeRead) {
  {
    RecordingFile damaged(file("damaged"));
    McapWriter writer(damaged, "test");
    writer.add_metadata("longreach", {{"wire", std::to_string(kWireVersion)}});
    const auto configs = writer.add_channel("/master/config", *recording::Config::descriptor());
    recording::Config config;
    config.set_text("\xff");  // not UTF-8
    const QuietProtobuf quiet;
    writer.write(configs, 1, config);
    writer.finish();
  }
  std::ostringstream out, err;
  testing::internal::CaptureStderr();
  EXPECT_EQ(replay({file("damaged").string()}, out, err), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(err.str().find("damaged.mcap is damaged: a message does not match the schema "
                           "longreach.recording.Config"),
            std::string::npos)
      << err.str();
}

TEST_F(Replay, RefusesWhatIsNoRecording) {
  std::ofstream(file("text")) << "no recording";
  EXPECT_THROW((void)replay_file(file("text")), RecordingError);
  std::ostringstream out, err;
  EXPECT_EQ(replay({file("text").string(), file("none").string()}, out, err), 2);
  EXPECT_NE(err.str().find("text.mcap is not a recording"), std::string::npos) << err.str();
  EXPECT_NE(err.str().find("none.mcap"), std::string::npos) << err.str();
}

TEST_F(Replay, RefusesWhatAnotherWireVersionRecorded) {
  {
    RecordingFile out(file("old"));
    McapWriter writer(out, "test");
    writer.add_metadata("longreach", {{"wire", "3"}, {"commit", "0123abcd"}});
    const auto channel = writer.add_channel("/master/tick", *recording::MasterTick::descriptor());
    writer.write(channel, 1, recording::MasterTick());
    writer.finish();
  }
  std::ostringstream out, err;
  EXPECT_EQ(replay({file("old").string()}, out, err), 2);
  EXPECT_NE(err.str().find("old.mcap was recorded with wire version 3, but this program uses version 5"),
            std::string::npos)
      << err.str();
  EXPECT_NE(err.str().find("commit 0123abcd"), std::string::npos) << err.str();
}

TEST_F(Replay, OfTheSameRunHasTheSameBytes) {
  record_session(file("again1"), 3.0, "analog");
  record_session(file("again2"), 3.0, "analog");
  EXPECT_TRUE(read_all(file("again1")) == read_all(file("again2")));
}

TEST(MessageDifference, IsTheFirstOneInTheSchemasOrder) {
  recording::MasterOutput a, b;
  a.mutable_wrench()->mutable_force_n()->set_y(0.0);
  b.mutable_wrench()->mutable_force_n()->set_y(-0.0);
  b.set_sequence(4);
  auto difference = first_difference(a, b);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->field, "wrench.force_n.y");
  EXPECT_EQ(difference->b, "-0");
  b.mutable_wrench()->mutable_force_n()->set_y(0.0);
  difference = first_difference(a, b);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->field, "sequence");
  b.clear_sequence();
  EXPECT_FALSE(first_difference(a, b));
  recording::MasterInput c, d;
  c.set_rtt_s(0.0);
  difference = first_difference(c, d);
  ASSERT_TRUE(difference) << "absent is not zero";
  EXPECT_EQ(difference->field, "rtt_s");
  EXPECT_EQ(difference->b, "absent");
}

}  // namespace
}  // namespace longreach::replay_test
