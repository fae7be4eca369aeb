// Recordings of the real programs: killed, on a full disk, started and stopped on the way.
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/mcap_writer.hpp"
#include "proto/recording.pb.h"
#include "tests/process/load.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::record_test {
namespace {

double unix_now_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// The ticks of a recording follow each other without a gap.
struct Recorded {
  std::uint64_t first_tick = 0, ticks = 0;
  double last_s = 0.0;  // Unix time
  bool whole = false;
};
Recorded read_recording(const std::filesystem::path& path) {
  McapReader reader(path);
  Recorded out;
  while (const auto message = reader.next()) {
    if (!message->channel->topic.ends_with("/tick")) continue;
    recording::SlaveTick tick;  // the numbers are the same fields on both sides
    EXPECT_TRUE(tick.ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
    if (out.ticks == 0) out.first_tick = tick.tick();
    EXPECT_EQ(tick.tick(), out.first_tick + out.ticks);
    ++out.ticks;
    out.last_s = 1e-9 * static_cast<double>(message->log_time_ns);
  }
  out.whole = reader.whole();
  return out;
}

class Recording : public Station {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  /// The recording drill of both sides below the folder: tables have one time base.
  void expect_exported_by_name() const {
    RunningProgram by_name("/usr/bin/env", {"XDG_STATE_HOME=" + folder_.path().string(),
                                            std::string(LONGREACH_BIN) + "/longreach", "record", "export",
                                            "drill", "--out", file("tables")});
    EXPECT_EQ(by_name.wait(std::chrono::seconds(60)), 0) << by_name.output();
    const auto zero_s = [&](const std::string& table) {
      std::ifstream in(file("tables/" + table));
      std::string line;
      std::getline(in, line);
      double t_s = 0.0, log_time_ns = 0.0;
      char comma = ' ';
      in >> t_s >> comma >> log_time_ns;
      return 1e-9 * log_time_ns - t_s;
    };
    EXPECT_GT(zero_s("slave_tick.csv"), 1e9);
    EXPECT_NEAR(zero_s("slave_tick.csv"), zero_s("master_tick.csv"), 1e-5);
  }
  TemporaryFolder folder_;
};

TEST_F(Recording, OfAKilledProgramHoldsWhatIsOlderThanASecond) {
  // Again where this machine held a recorder up for longer than it may take.
  double missing_s = 1e9;
  for (int attempt = 0; attempt < 3 && missing_s > 1.0; ++attempt) {
    const std::string path = file("slave" + std::to_string(attempt) + ".mcap");
    start_slave({"--record", path});
    ASSERT_TRUE(eventually([this] { return slave_.counter("ticks") > 3000; })) << outputs();
    const double killed_s = unix_now_s();
    slave_program_->signal(SIGKILL);
    ASSERT_EQ(slave_program_->wait(std::chrono::seconds(10)), 128 + SIGKILL);
    const Recorded recorded = read_recording(path);
    EXPECT_EQ(recorded.first_tick, 0u);
    EXPECT_GT(recorded.ticks, 1000u);
    EXPECT_FALSE(recorded.whole);
    missing_s = killed_s - recorded.last_s;
  }
  EXPECT_LT(missing_s, 1.0);
}

TEST_F(Recording, OnAFullDiskEndsWithAnEventAndChangesNothingElse) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full{2'000'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);  // the programs inherit it
  start_slave({"--record", file("slave.mcap")});
  start_master({"--operator", "none", "--engage", "--record", file("master.mcap")});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  Disturbance disturbance(slave_, master_);
  ASSERT_TRUE(both_engaged()) << outputs();
  for (StationSide* side : {&slave_, &master_}) {
    ASSERT_TRUE(eventually([side] {
      const auto status = side->status();
      return status && status->has_recording() && !status->recording().running();
    })) << outputs();
    const auto status = side->status();
    ASSERT_TRUE(status);
    EXPECT_TRUE(status->recording().failed());
    EXPECT_EQ(status->recording().ended(), "writing failed: File too large");
  }
  for (const RunningProgram* program : {slave_program_.get(), master_program_.get()}) {
    EXPECT_TRUE(says(*program, "because=\"writing failed: File too large\"")) << outputs();
    EXPECT_TRUE(says(*program, "warn")) << outputs();
  }
  // Both loops go on.
  const auto ticks = slave_.counter("ticks");
  EXPECT_TRUE(eventually([&] { return slave_.counter("ticks") > ticks + 1000; }));
  EXPECT_EQ(slave_.state(), "Engaged") << outputs();
  EXPECT_EQ(master_.state(), "Engaged") << outputs();
  disturbance.expect_none("a full disk");
  EXPECT_GT(read_recording(file("slave.mcap")).ticks, 1000u);
}

TEST_F(Recording, IsWholeAndTheRobotIsReturnedAfterAHangUp) {
  start_slave({"--record", file("slave.mcap")});
  start_master({"--operator", "script", "--engage", "--record", file("master.mcap")});
  ASSERT_TRUE(both_engaged()) << outputs();
  master_program_->signal(SIGHUP);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  EXPECT_NE(master_program_->output().find("end ticks="), std::string::npos) << outputs();
  EXPECT_TRUE(eventually([this] {
    const auto status = slave_.status();
    return status && status->lease().empty();
  }));
  slave_program_->signal(SIGHUP);
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  EXPECT_TRUE(read_recording(file("slave.mcap")).whole);
  EXPECT_TRUE(read_recording(file("master.mcap")).whole);
}

TEST_F(Recording, GoesOnAfterAHangUpThatIsIgnored) {
  struct Ignored {
    Ignored() { std::signal(SIGHUP, SIG_IGN); }  // as nohup(1) does; programs inherit it
    ~Ignored() { std::signal(SIGHUP, SIG_DFL); }
  };
  {
    const Ignored ignored;
    start_slave();
    ASSERT_TRUE(eventually([this] { return slave_.counter("ticks") > 100; })) << outputs();
  }
  slave_program_->signal(SIGHUP);
  const std::uint64_t ticks = slave_.counter("ticks");
  EXPECT_TRUE(eventually([&] { return slave_.counter("ticks") > ticks + 500; })) << outputs();
}

TEST_F(Recording, FromTheStartHasEveryTick) {
  start_slave({"--record", file("slave.mcap")});
  start_master({"--operator", "script", "--engage", "--record", file("master.mcap")});
  ASSERT_TRUE(both_engaged()) << outputs();
  ASSERT_TRUE(eventually([this] { return master_.counter("ticks") > 2000; }));
  master_program_->signal(SIGTERM);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  slave_program_->signal(SIGTERM);
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  for (const char* name : {"slave.mcap", "master.mcap"}) {
    const Recorded recorded = read_recording(file(name));
    EXPECT_EQ(recorded.first_tick, 0u) << name;
    EXPECT_GT(recorded.ticks, 2000u) << name;
    EXPECT_TRUE(recorded.whole) << name;
  }
}

TEST_F(Recording, IsReplayedBitForBitAfterAllThatMayChangeOnTheWay) {
  start_slave({"--record", file("slave.mcap")});
  start_master({"--operator", "script", "--engage", "--profile", "analog", "--record", file("master.mcap")});
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_NE(master_.set("mapping.scale", "0.5"), "") << "refused: it does not reach the node";
  EXPECT_EQ(master_.set("hand.grip", "FIRM"), "");
  EXPECT_EQ(slave_.set("estimator.forgetting", "0.99"), "");
  EXPECT_EQ(slave_.set_delay(0.05), "");
  EXPECT_EQ(master_.stop(), "");
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Stopped"; })) << outputs();
  EXPECT_EQ(slave_.set("command.force_guard_n", "10"), "");
  EXPECT_EQ(master_.set("mapping.mode", "RATE"), "");
  EXPECT_EQ(master_.set("mapping.scale", "0.5"), "");
  EXPECT_EQ(master_.set("rendering.force_max_n", "12"), "");
  EXPECT_EQ(master_.engage(), "");
  ASSERT_TRUE(both_engaged()) << outputs();
  const auto ticks = slave_.counter("ticks");
  ASSERT_TRUE(eventually([&] { return slave_.counter("ticks") > ticks + 2000; }));
  master_program_->signal(SIGTERM);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  slave_program_->signal(SIGKILL);
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(20)), 128 + SIGKILL) << outputs();
  RunningProgram replay("longreach-lab", {"replay", file("master.mcap"), file("slave.mcap")});
  EXPECT_EQ(replay.wait(std::chrono::seconds(120)), 0) << replay.output();
  EXPECT_NE(replay.output().find("master: "), std::string::npos) << replay.output();
  EXPECT_NE(replay.output().find("slave: "), std::string::npos) << replay.output();
  EXPECT_NE(replay.output().find("slave.mcap is truncated"), std::string::npos) << replay.output();
  EXPECT_EQ(replay.output().find("difference"), std::string::npos) << replay.output();
}

TEST_F(Recording, StartsAndStopsOnTheWay) {
  const std::string folder = file("longreach/recordings");
  start_slave({"--recordings", folder});
  start_master({"--operator", "none", "--engage", "--recordings", folder});
  ASSERT_TRUE(both_engaged()) << outputs();
  Disturbance disturbance(slave_, master_);
  const auto client = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc), "--slave",
                                 "127.0.0.1:" + std::to_string(ports_.slave_rpc)});
    RunningProgram program("longreach", words);
    const int status = program.wait(std::chrono::seconds(60)).value_or(-1);
    return std::to_string(status) + " " + program.output();
  };
  const std::string begun = client({"record", "start", "drill"});
  EXPECT_TRUE(begun.starts_with("0 ")) << begun;
  EXPECT_NE(begun.find(folder + "/drill-slave.mcap"), std::string::npos) << begun;
  const std::string again = client({"record", "start", "other"});
  EXPECT_TRUE(again.starts_with("1 ")) << again;
  EXPECT_NE(again.find("is already being recorded"), std::string::npos) << again;
  EXPECT_NE(client({"status"}).find("drill-master.mcap, "), std::string::npos);
  for (StationSide* side : {&slave_, &master_})
    ASSERT_TRUE(eventually([side] {
      const auto status = side->status();
      return status && status->recording().bytes() > 300'000;
    })) << outputs();
  const std::string ended = client({"record", "stop"});
  EXPECT_TRUE(ended.starts_with("0 ")) << ended;
  EXPECT_TRUE(client({"record", "stop"}).starts_with("1 ")) << "no recording is in progress";
  EXPECT_NE(client({"record", "list", folder}).find("drill-slave.mcap"), std::string::npos);
  const std::string tables = client({"record", "export", folder + "/drill-slave.mcap", "--csv"});
  EXPECT_TRUE(tables.starts_with("0 ")) << tables;
  EXPECT_TRUE(std::filesystem::exists(folder + "/drill-slave/slave_tick.csv")) << tables;
  expect_exported_by_name();
  for (const char* name : {"/drill-slave.mcap", "/drill-master.mcap"}) {
    const Recorded recorded = read_recording(folder + name);
    EXPECT_TRUE(recorded.whole);
    EXPECT_GT(recorded.first_tick, 0u);
    EXPECT_GT(recorded.ticks, 500u);
  }
  RunningProgram replay("longreach-lab", {"replay", folder + "/drill-slave.mcap"});
  EXPECT_EQ(replay.wait(std::chrono::seconds(60)), 2) << replay.output();
  EXPECT_NE(replay.output().find("a replay requires a recording from the start (--record)"),
            std::string::npos)
      << replay.output();
  // And a second one.
  EXPECT_TRUE(client({"record", "start", "drill"}).starts_with("1 ")) << "nothing is overwritten";
  EXPECT_TRUE(client({"record", "start"}).starts_with("0 "));
  EXPECT_EQ(slave_.state(), "Engaged") << outputs();
  disturbance.expect_none("recordings");
}

/// What the library of the format's authors says of a file: exit status, what was found as JSON.
std::string checked(const std::string& how, const std::string& path) {
  RunningProgram check(LONGREACH_NODE, {LONGREACH_RECORDINGS_CHECK, how, path});
  const int status = check.wait(std::chrono::seconds(120)).value_or(-1);
  return std::to_string(status) + " " + check.output();
}

TEST_F(Recording, IsReadByTheLibraryOfItsFormat) {
  start_slave({"--record", file("slave.mcap")});
  start_master({"--operator", "script", "--engage", "--record", file("master.mcap")});
  ASSERT_TRUE(both_engaged()) << outputs();
  ASSERT_TRUE(eventually([this] { return master_.counter("ticks") > 3000; }));
  master_program_->signal(SIGTERM);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  slave_program_->signal(SIGKILL);
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(20)), 128 + SIGKILL) << outputs();
  // By its index, all schemas and checksums.
  const std::string master = checked("indexed", file("master.mcap"));
  EXPECT_TRUE(master.starts_with("0 {")) << master;
  for (const char* part : {R"("/master/tick":{"schema":"longreach.recording.MasterTick")",
                           R"("/master/view":{"schema":"longreach.recording.MasterView")",
                           R"("/master/link":{"schema":"longreach.recording.Link")",
                           R"("/master/received_report")", R"("/master/received_telemetry")",
                           R"("/master/config")", R"("metadata":{"longreach":{)", R"("side":"master")"})
    EXPECT_NE(master.find(part), std::string::npos) << part << " in " << master;
  const Recorded recorded = read_recording(file("master.mcap"));
  EXPECT_NE(master.find(R"("messages":)" + std::to_string(recorded.ticks) + R"(,"last_tick":)" +
                        std::to_string(recorded.ticks - 1)),
            std::string::npos)
      << recorded.ticks << " in " << master;
  // Cut: from its start.
  EXPECT_TRUE(checked("indexed", file("slave.mcap")).starts_with("1 "));
  const std::string slave = checked("stream", file("slave.mcap"));
  EXPECT_TRUE(slave.starts_with("0 {")) << slave;
  const Recorded cut = read_recording(file("slave.mcap"));
  EXPECT_NE(slave.find(R"("messages":)" + std::to_string(cut.ticks) + R"(,"last_tick":)" +
                       std::to_string(cut.ticks - 1)),
            std::string::npos)
      << cut.ticks << " in " << slave;
  EXPECT_NE(slave.find(R"("complete":false)"), std::string::npos) << slave;
  const std::string whole = checked("stream", file("master.mcap"));
  EXPECT_NE(whole.find(R"("complete":true)"), std::string::npos) << whole;
}

TEST_F(Recording, OfNothingOrOfMuchIsReadByTheLibraryOfItsFormat) {
  {
    RecordingFile empty(file("empty.mcap"));
    McapWriter(empty, "test").finish();
    RecordingFile large(file("large.mcap"));
    McapWriter writer(large, "test");
    recording::Event event;
    event.set_text(std::string(20'000'000, 'x'));
    const auto channel = writer.add_channel("/x", *event.descriptor());
    for (std::uint64_t i = 0; i < 3; ++i) writer.write(channel, i, event);
    event.set_text("");
    for (std::uint64_t i = 0; i < 100'000; ++i) writer.write(channel, 10 + i, event);
    writer.finish();
  }
  EXPECT_TRUE(checked("indexed", file("empty.mcap")).starts_with("0 {"));
  EXPECT_TRUE(checked("stream", file("empty.mcap")).starts_with("0 {"));
  const std::string large = checked("indexed", file("large.mcap"));
  EXPECT_TRUE(large.starts_with("0 {")) << large;
  EXPECT_NE(large.find(R"("messages":100003)"), std::string::npos) << large;
}

TEST_F(Recording, OverwritesNothing) {
  start_slave({"--record", file("slave.mcap"), "--seconds", "0.2"});
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  start_slave({"--record", file("slave.mcap")});
  EXPECT_EQ(slave_program_->wait(std::chrono::seconds(20)), 2) << outputs();
  EXPECT_NE(slave_program_->output().find("the file already exists; choose another name"), std::string::npos)
      << outputs();
}

}  // namespace
}  // namespace longreach::record_test
