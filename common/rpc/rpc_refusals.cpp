#include "common/rpc/rpc_refusals.hpp"

#include <grpc/support/log.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kQuiet = std::chrono::seconds(1);
constexpr std::string_view kFailed = "Handshaking failed: ";

struct Tally {
  std::atomic<std::uint64_t> count = 0;  // read while a log line is written
  std::mutex mutex;
  std::uint64_t unsaid = 0;
  Clock::time_point silent_until;
};

Tally& tally() {
  static Tally one;
  return one;
}

/// "certificate verify failed" of gRPC's long line.
std::string_view reason(std::string_view line) {
  line = line.substr(0, line.find(" {"));
  for (const std::string_view before : {"SSL routines::", "Ssl handshake failed: ", "UNKNOWN:"}) {
    if (const auto at = line.rfind(before); at != std::string_view::npos)
      return line.substr(at + before.size());
  }
  return line;
}

void read_line(gpr_log_func_args* line) {
  const std::string_view message(line->message), file(line->file);
  // A server's connections alone: a client's are the caller's trouble, who is told.
  if (file.ends_with("chttp2_server.cc") && message.starts_with(kFailed))
    note_rpc_refusal("connection", reason(message.substr(kFailed.size())));
}

}  // namespace

void take_rpc_log() {
  gpr_set_log_function(read_line);
  gpr_set_log_verbosity(GPR_LOG_SEVERITY_DEBUG);  // at which refused connections are told
}

void note_rpc_refusal(std::string_view who, std::string_view why) {
  Tally& all = tally();
  const std::lock_guard lock(all.mutex);
  ++all.count;
  const auto now = Clock::now();
  if (now < all.silent_until) {
    ++all.unsaid;
    return;
  }
  spdlog::warn("rpc refused={} because=\"{}\" unsaid={} count={}", who, why, std::exchange(all.unsaid, 0),
               all.count.load());
  all.silent_until = now + kQuiet;
}

std::uint64_t rpc_refusals() { return tally().count; }

std::string readable_peer(const std::string& peer) {
  std::string text = peer.substr(peer.find(':') + 1);
  for (const auto& [coded, plain] : {std::pair{"%5B", "["}, {"%5D", "]"}, {"%25", "%"}}) {
    for (auto at = text.find(coded); at != std::string::npos; at = text.find(coded, at + 1))
      text.replace(at, 3, plain);
  }
  return text;
}

}  // namespace longreach
