#include "common/program/log.hpp"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>

#include "common/config/config.hpp"
#include "common/program/async_writer.hpp"

namespace longreach {
namespace {

constexpr std::size_t kWaitingMaxBytes = 256 << 10;

std::unique_ptr<spdlog::formatter> line_form() {
  return std::make_unique<spdlog::pattern_formatter>("%Y-%m-%dT%H:%M:%S.%eZ %l %n %v",
                                                     spdlog::pattern_time_type::utc);
}

std::string line_of(spdlog::formatter& form, const spdlog::details::log_msg& message) {
  spdlog::memory_buf_t line;
  form.format(message, line);
  return {line.data(), line.size()};
}

class AsyncSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  AsyncSink(int fd, const std::string& side, bool hushable)
      : base_sink(line_form()),
        hushable_(hushable),
        async_writer_(fd, kWaitingMaxBytes, [side, form = std::shared_ptr(line_form())](std::uint64_t lost) {
          const std::string words = "log lost=" + std::to_string(lost);
          return line_of(*form, {side, spdlog::level::warn, words});
        }) {}

  void hush() { hushed_ = hushable_; }
  void drain() { async_writer_.drain(AsyncWriter::kFarewell); }
  [[nodiscard]] std::uint64_t lost() const { return async_writer_.lost(); }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (!hushed_) async_writer_.offer(line_of(*formatter_, message));
  }
  void flush_() override {}

  const bool hushable_;
  std::atomic<bool> hushed_{false};
  AsyncWriter async_writer_;
};

struct Present {
  std::mutex mutex;
  std::shared_ptr<AsyncSink> sink;
  std::uint64_t lost_before = 0;  // by those before it
};

Present& present() {
  static Present one;
  return one;
}

std::shared_ptr<AsyncSink> present_sink() {
  const std::lock_guard lock(present().mutex);
  return present().sink;
}

std::shared_ptr<AsyncSink> make_sink(const std::string& side, const std::string& file) {
  if (file.empty()) return std::make_shared<AsyncSink>(STDERR_FILENO, side, true);
  // Without waiting: a pipe by that name may have no reader.
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
  if (fd < 0)
    throw ConfigError("cannot write the log file '" + file + "' (" + std::strerror(errno) +
                      "); choose another file with --log");
  auto sink = std::make_shared<AsyncSink>(fd, side, false);
  ::close(fd);
  return sink;
}

}  // namespace

void set_up_log(const std::string& side, const std::string& file) {
  auto sink = make_sink(side, file);
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(side, sink));
  const std::lock_guard lock(present().mutex);
  if (present().sink) present().lost_before += present().sink->lost();
  present().sink = std::move(sink);
}

void hush_log() {
  if (const auto sink = present_sink()) sink->hush();
}

void close_log() {
  if (const auto sink = present_sink()) sink->drain();
}

std::uint64_t log_lost() {
  const std::lock_guard lock(present().mutex);
  return present().lost_before + (present().sink ? present().sink->lost() : 0);
}

}  // namespace longreach
