#pragma once
// What the programs of both sides do alike, from the configuration to the end of the loop. Include this header only in
// main.cpp, like common/program/program.hpp.

#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "common/config/effective.hpp"
#include "common/crypto/session.hpp"
#include "common/link/protection.hpp"
#include "common/loop/real_time_loop.hpp"
#include "common/loop/stop_signal.hpp"
#include "common/net/adapter_channel.hpp"
#include "common/program/log.hpp"
#include "common/program/program.hpp"

namespace longreach {

/// Prints the text of --check. Returns the exit status.
template <class Message>
int print_check(const Effective<Message>& effective, const std::string& notes) {
  std::fputs(check_text(effective, notes).c_str(), stdout);
  return 0;
}

template <class Service>
struct SideProgram {
  using Shell = typename Service::Shell;
  using Message = typename Service::Message;

  /// Sets up signals, log, credentials, shell and service, and starts the recording of the options. Throws what they throw.
  SideProgram(const ProgramOptions& options, const Effective<Message>& effective)
      : config(prepared(options, effective.config)),
        security(security_of(options, Shell::Parts::kRole)),
        seed(draw_session(Cipher::kChaCha20Poly1305).number),
        shell(config, seed, with(0, Protection::kRpc, options.insecure)),
        service(shell, effective.config, {options.recordings, seed}, effective.origins) {
    if (!options.record.empty()) service.record_from_start(options.record, options.record_max_mb);
  }

  /// Runs the loop in a thread of its own, and ticked(now) there after each tick, until meanwhile(stop) returns, which runs in
  /// this thread. Throws what the loop has thrown, which also sets `stop`.
  template <class Ticked, class Meanwhile>
  void run(const Ticked& ticked, const Meanwhile& meanwhile) {
    std::atomic<bool>& stop = stop_requested();
    std::atomic<bool> end{false};
    std::exception_ptr failure;
    std::thread loop_thread([&] {
      try {
        for (const auto& note : ask_for_real_time(config.loop)) spdlog::warn("real_time note=\"{}\"", note);
        RealTimeLoop loop(config.loop.rate_hz);
        shell.wait_for_adapter();
        loop.run(end, [&](Time now, const LoopFigures& figures) {
          shell.tick(now, figures);
          ticked(now);
        });
      } catch (...) {
        failure = std::current_exception();
        stop = true;
      }
    });
    meanwhile(stop);
    end = true;
    loop_thread.join();
    if (failure) std::rethrow_exception(failure);
  }

  const typename Shell::Config config;
  const RpcSecurity security;
  const std::uint64_t seed;
  Shell shell;
  Service service;

 private:
  static typename Shell::Config prepared(const ProgramOptions& options, const Message& message) {
    auto config = to_struct(message);
    refuse_insecure(options.insecure, Shell::Parts::adapter_of(config), Shell::Parts::kDevice);
    (void)stop_requested();  // installs the signal handlers
    set_up_log(Shell::Parts::kSide, options.log);
    return config;
  }
};

}  // namespace longreach
