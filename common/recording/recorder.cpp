#include "common/recording/recorder.hpp"

#include <chrono>

#include "common/recording/build_name.hpp"
#include "common/recording/recording_error.hpp"

namespace longreach {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(10);
constexpr auto kFlushPeriod = std::chrono::milliseconds(250);
constexpr double kMega = 1e6;

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(static_cast<std::uint64_t>(static_cast<double>(bytes) / kMega + 0.5)) + " MB";
}

}  // namespace

Recorder::Recorder(const RecorderOptions& options, RecordBuffer& record_buffer)
    : options_(options), record_buffer_(record_buffer), file_(options.file), writer_(file_, build_name()) {
  writer_.add_metadata("longreach", options_.facts);
  record_buffer_.declare(writer_);
  writer_.flush();
  if (file_.failed())
    throw RecordingError("cannot record into " + options_.file.string() + ": " + file_.error());
  status_.file = options_.file.string();
  status_.running = true;
  publish();
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() { stop(); }

void Recorder::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

RecordingStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Recorder::run() {
  auto flush_due = Clock::now() + kFlushPeriod;
  std::string why;
  while (why.empty()) {
    {
      std::unique_lock lock(mutex_);
      if (wake_.wait_for(lock, kPollPeriod, [this] { return stopping_; })) break;
    }
    record_buffer_.drain(writer_);
    if (Clock::now() >= flush_due || writer_.size() >= options_.max_bytes) {
      writer_.flush();
      flush_due = Clock::now() + kFlushPeriod;
    }
    publish();
    why = trouble();
  }
  if (why.empty()) record_buffer_.drain(writer_);
  record_buffer_.close();
  writer_.finish();
  const bool failed = !why.empty() || file_.failed();
  end(failed ? trouble() : "stopped", failed);
}

std::string Recorder::trouble() const {
  if (file_.failed()) return "writing failed: " + file_.error();
  if (writer_.size() >= options_.max_bytes)
    return "it reached its maximum size of " + megabytes(options_.max_bytes);
  return "";
}

void Recorder::publish() {
  const std::lock_guard lock(mutex_);
  status_.bytes = file_.size();
  status_.seconds = std::chrono::duration<double>(Clock::now() - began_).count();
  status_.ticks_not_recorded = record_buffer_.ticks_dropped();
}

void Recorder::end(const std::string& why, bool failed) {
  publish();
  {
    const std::lock_guard lock(mutex_);
    status_.running = false;
    status_.failed = failed;
    status_.ended = why;
  }
  if (options_.ended) options_.ended(status());
}

}  // namespace longreach
