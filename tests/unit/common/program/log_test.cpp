#include "common/program/log.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <thread>

#include "common/core/check.hpp"
#include "common/program/async_writer.hpp"

namespace longreach::log_test {
namespace {

TEST(Log, WritesOneEventALineWithTimeLevelAndSide) {
  const auto file = std::filesystem::temp_directory_path() / ("longreach-log-" + std::to_string(getpid()));
  set_up_log("slave", file.string());
  spdlog::info("state from={} to={}", "Idle", "Observing");
  spdlog::warn("stopped");
  close_log();
  std::ifstream in(file);
  std::string first, second, third;
  std::getline(in, first);
  std::getline(in, second);
  EXPECT_FALSE(std::getline(in, third));
  const std::string time = R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z )";
  EXPECT_TRUE(std::regex_match(first, std::regex(time + "info slave state from=Idle to=Observing"))) << first;
  EXPECT_TRUE(std::regex_match(second, std::regex(time + "warning slave stopped"))) << second;
  std::filesystem::remove(file);
}

std::string read_now(int fd) {
  std::array<char, 1 << 17> bytes{};
  const ssize_t n = ::read(fd, bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))};
}

TEST(Log, StalledReaderDelaysNothingAndGetsLossNotice) {
  const auto pipe =
      std::filesystem::temp_directory_path() / ("longreach-log-pipe-" + std::to_string(getpid()));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  const std::uint64_t before = log_lost();
  set_up_log("slave", pipe.string());
  spdlog::info("first");
  close_log();  // before lines are dropped, the oldest first
  const std::string words(1000, 'x');
  for (int i = 0; i < 1000; ++i)
    spdlog::info("line={} {}", i, words);  // 1 MB into 64 KiB: would never return
  EXPECT_GT(log_lost(), before + 300);
  EXPECT_LT(log_lost(), before + 1000);
  std::string read;
  for (int i = 0; i < 10'000 && read.find("line=999 ") == std::string::npos; ++i) {
    read += read_now(reader);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::close(reader);
  std::filesystem::remove(pipe);
  EXPECT_NE(read.find("info slave first"), std::string::npos);
  std::uint64_t reported = 0;
  const std::regex line("Z warning slave log lost=([0-9]+)\n");
  for (auto at = std::sregex_iterator(read.begin(), read.end(), line); at != std::sregex_iterator(); ++at)
    reported += std::stoull((*at)[1]);
  EXPECT_EQ(reported, log_lost() - before);
  EXPECT_NE(read.find("line=999 "), std::string::npos);
}

TEST(Log, AFullDiskLosesLinesAndIsSaidToHave) {
  const std::uint64_t before = log_lost();
  set_up_log("slave", "/dev/full");
  spdlog::info("one");
  spdlog::info("two");
  close_log();
  EXPECT_EQ(log_lost(), before + 2);
}

TEST(AsyncWriter, AFailedCheckEndsAProgramWhoseStandardErrorIsFull) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_NONBLOCK), 0);
  const std::string page(4096, 'a');
  while (::write(ends[1], page.data(), page.size()) > 0) {
  }
  ASSERT_EQ(::fcntl(ends[1], F_SETFL, 0), 0);  // a write waits
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    bound_standard_error();
    CHECK(child != 0);
    ::_exit(0);
  }
  int status = 0;
  pid_t ended = 0;
  for (int i = 0; i < 2000 && ended == 0; ++i) {
    ended = ::waitpid(child, &status, WNOHANG);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (ended == 0) ::kill(child, SIGKILL);
  EXPECT_EQ(ended, child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT) << status;
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(AsyncWriter, KeepsTheNewestWhereNobodyReadsAndEndsAllTheSame) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const std::string too_much(1 << 17, 'a');  // twice what a pipe takes
  {
    AsyncWriter async_writer(ends[1], 0);
    async_writer.offer(too_much);
    EXPECT_FALSE(async_writer.drain(std::chrono::milliseconds(50)));
    async_writer.offer("second");
    async_writer.offer("third");
    EXPECT_EQ(async_writer.lost(), 1u);
    std::string read;
    while (read.size() < too_much.size() + 5) read += read_now(ends[0]);
    EXPECT_EQ(read, too_much + "third");
  }
  EXPECT_FALSE(put(ends[1], too_much));
  EXPECT_FALSE(put(ends[1], "behind it"));
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Log, SaysWhatToDoWhenTheFileCannotBeWritten) {
  try {
    set_up_log("slave", "/proc/no/such/file");
    FAIL() << "opened";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("--log"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace longreach::log_test
