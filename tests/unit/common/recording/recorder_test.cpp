// The recorder writes what the loop wrote down, and whatever happens to it, the loop does not notice.
#include "common/recording/recorder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/recording_folder.hpp"
#include "master/recording/master_record_buffer.hpp"
#include "slave/recording/slave_record_buffer.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::recorder_test {
namespace {

constexpr double kRateHz = 1000.0;

/// Of 100 ticks: the buffer holds what is added in 200 ms, for which a busy machine may stop the recorder.
constexpr auto kPace = std::chrono::milliseconds(5);

/// The loop's part: `count` ticks from `from` on.
void add_ticks(MasterRecordBuffer& record_buffer, std::uint64_t from, std::uint64_t count) {
  const Received<StiffnessReport> report{};
  const Received<Telemetry> telemetry{};
  for (std::uint64_t tick = from; tick < from + count; ++tick) {
    MasterInput in;
    in.now = Time(Duration(1'000'000 * static_cast<std::int64_t>(tick)));
    if (tick % 100 == 0) in.reports = {&report, 1};
    if (tick % 30 == 0) in.telemetry = {&telemetry, 1};
    record_buffer.add_tick(tick, 0, in, MasterOutput{}, MasterView{});
    if (record_buffer.link_due(tick)) record_buffer.add_link({.now = in.now});
  }
}

/// Numbers of the ticks in a file: they must follow each other from 0 on, but for `gaps`.
struct Ticks {
  std::uint64_t count = 0, gaps = 0, reports = 0, telemetry = 0, views = 0, links = 0;
  bool whole = false;
};
Ticks read_ticks(const std::filesystem::path& path) {
  McapReader reader(path);
  Ticks out;
  std::uint64_t next = 0;
  while (const auto message = reader.next()) {
    const std::string& topic = message->channel->topic;
    if (topic == "/master/received_report") ++out.reports;
    if (topic == "/master/received_telemetry") ++out.telemetry;
    if (topic == "/master/view") ++out.views;
    if (topic == "/master/link") ++out.links;
    if (topic != "/master/tick") continue;
    recording::MasterTick tick;
    EXPECT_TRUE(tick.ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
    if (tick.tick() != next) ++out.gaps;
    next = tick.tick() + 1;
    ++out.count;
  }
  out.whole = reader.whole();
  return out;
}

template <class Condition>
bool eventually(const Condition& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

TEST(Recorder, WritesEveryTickWithItsMessages) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  Recorder recorder(
      {.file = folder.path() / "a.mcap", .max_bytes = 1'000'000'000, .facts = {{"side", "master"}}},
      record_buffer);
  record_buffer.add_config(Time{}, 0, "text");
  add_ticks(record_buffer, 0, 3000);
  recorder.stop();
  const Ticks ticks = read_ticks(folder.path() / "a.mcap");
  EXPECT_EQ(ticks.count, 3000u);
  EXPECT_EQ(ticks.gaps, 0u);
  EXPECT_EQ(ticks.reports, 30u);
  EXPECT_EQ(ticks.telemetry, 100u);
  EXPECT_EQ(ticks.views, 300u);
  EXPECT_EQ(ticks.links, 60u);
  EXPECT_TRUE(ticks.whole);
  const RecordingStatus status = recorder.status();
  EXPECT_FALSE(status.running);
  EXPECT_FALSE(status.failed);
  EXPECT_EQ(status.ended, "stopped");
  EXPECT_EQ(status.bytes, std::filesystem::file_size(folder.path() / "a.mcap"));
}

TEST(Recorder, KeepsNothingOnceItHasEnded) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  Recorder recorder({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000'000}, record_buffer);
  recorder.stop();
  for (unsigned i = 0; i < 100; ++i) {
    record_buffer.add_config(Time{}, i, std::string(1000, 'c'));
    record_buffer.add_event(Time{}, "event");
  }
  EXPECT_EQ(record_buffer.notes(), 0u);
}

TEST(Recorder, HasWrittenWhatIsOlderBeforeItEnds) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  Recorder recorder({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000'000}, record_buffer);
  add_ticks(record_buffer, 0, 500);
  // Somebody else reads the file while it is being written: that is what kill -9 leaves.
  EXPECT_TRUE(eventually([&] { return read_ticks(folder.path() / "a.mcap").count == 500; }));
  EXPECT_FALSE(read_ticks(folder.path() / "a.mcap").whole);
  EXPECT_TRUE(recorder.status().running);
}

TEST(Recorder, EndsAtItsLargestSizeAndSaysSo) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  std::atomic<int> ended = 0;
  Recorder recorder({.file = folder.path() / "a.mcap",
                     .max_bytes = 1'000'000,
                     .ended =
                         [&](const RecordingStatus& status) {
                           EXPECT_TRUE(status.failed);
                           ++ended;
                         }},
                    record_buffer);
  for (std::uint64_t i = 0; recorder.status().running && i < 100'000; ++i) {
    add_ticks(record_buffer, 100 * i, 100);
    std::this_thread::sleep_for(kPace);
  }
  ASSERT_FALSE(recorder.status().running);
  EXPECT_EQ(recorder.status().ended, "it reached its maximum size of 1 MB");
  const std::uint64_t size = std::filesystem::file_size(folder.path() / "a.mcap");
  add_ticks(record_buffer, 0, 20'000);  // the loop goes on
  recorder.stop();
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "a.mcap"), size);
  EXPECT_GT(size, 1'000'000u);
  EXPECT_LT(size, 4'000'000u);  // what one look at the tape may find, and the summary
  EXPECT_TRUE(read_ticks(folder.path() / "a.mcap").whole);
}

TEST(Recorder, OnAFullDiskEndsAndSaysSo) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  Recorder recorder({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000'000}, record_buffer);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full{3'000'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  for (std::uint64_t i = 0; recorder.status().running && i < 100'000; ++i) {
    add_ticks(record_buffer, 100 * i, 100);
    std::this_thread::sleep_for(kPace);
  }
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_FALSE(recorder.status().running);
  EXPECT_TRUE(recorder.status().failed);
  EXPECT_EQ(recorder.status().ended, "writing failed: File too large");
  EXPECT_LE(std::filesystem::file_size(folder.path() / "a.mcap"), 3'000'000u);
  const Ticks ticks = read_ticks(folder.path() / "a.mcap");
  EXPECT_GT(ticks.count, 0u);
  EXPECT_EQ(ticks.gaps, 0u);
}

TEST(Recorder, CannotBeginWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  EXPECT_THROW(Recorder({.file = folder.path() / "none" / "a.mcap", .max_bytes = 1'000'000}, record_buffer),
               RecordingError);
  Recorder first({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000}, record_buffer);
  MasterRecordBuffer other(kRateHz, Duration(0));
  EXPECT_THROW(Recorder({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000}, other), RecordingError);
}

TEST(RecordBuffer, DropsAndCountsWholeTicksWhenNobodyReads) {
  const TemporaryFolder folder;
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  add_ticks(record_buffer, 0, 20'000);
  const std::uint64_t dropped = record_buffer.ticks_dropped();
  EXPECT_GT(dropped, 10'000u);
  {
    Recorder recorder({.file = folder.path() / "a.mcap", .max_bytes = 1'000'000'000}, record_buffer);
    ASSERT_TRUE(eventually([&] { return recorder.status().bytes > 100'000; }));
    recorder.stop();
    EXPECT_EQ(recorder.status().ticks_not_recorded, dropped);
  }
  const Ticks ticks = read_ticks(folder.path() / "a.mcap");
  EXPECT_EQ(ticks.count, 20'000u - dropped);
}

TEST(RecordBuffer, CostsTheLoopNoAllocation) {
  MasterRecordBuffer record_buffer(kRateHz, Duration(0));
  test::count_allocations(true);
  add_ticks(record_buffer, 0, 2000);
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
  SlaveRecordBuffer slave(kRateHz, Duration(0));
  const Received<MotionCommand> command{};
  SlaveInput in;
  in.commands = {&command, 1};
  SlaveOutput out;
  out.report.emplace();
  out.telemetry.emplace();
  test::count_allocations(true);
  for (std::uint64_t tick = 0; tick < 1000; ++tick) slave.add_tick(tick, 0, in, out, SlaveView{});
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
}

TEST(RecordingFolder, TakesNamesThatAreNames) {
  const TemporaryFolder folder;
  EXPECT_EQ(recording_path(folder.path() / "new", "a-1.x_Y", "slave"),
            folder.path() / "new" / "a-1.x_Y-slave.mcap");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "new"));
  for (const char* name : {"", ".", "..", "../x", "a/b", "-x", "a b", "\n"})
    EXPECT_THROW((void)recording_path(folder.path(), name, "slave"), RecordingError) << name;
  EXPECT_THROW((void)recording_path("/proc/none", "x", "slave"), RecordingError);
}

}  // namespace
}  // namespace longreach::recorder_test
