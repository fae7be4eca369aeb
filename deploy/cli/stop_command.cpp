// longreach stop: stops both sides over every path, and reports each side as soon as it is stopped.

#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "deploy/cli/commands.hpp"
#include "deploy/cli/side_client.hpp"

namespace longreach {
namespace {

constexpr auto kFarCheck = std::chrono::milliseconds(20);
constexpr double kFarBesides_s = 2.0;  // in addition to the round trip, as for an engagement

class StopBothSides {
 public:
  using Say = std::function<void(const std::string&)>;

  StopBothSides(const Options& options, Say say)
      : master_(Side::kMaster, options), slave_(Side::kSlave, options), say_(std::move(say)) {}

  std::string run() {
    auto slave = std::async(std::launch::async, [this] { ask(slave_, slave_outcome_); });
    auto master = std::async(std::launch::async, [this] {
      ask(master_, master_outcome_);
      follow_session();
    });
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] {
        return master_outcome_.ended && (slave_outcome_.stopped || (slave_outcome_.ended && followed_));
      });
    }
    // A response that is still pending adds nothing.
    master_.cancel();
    slave_.cancel();
    slave.get();
    master.get();
    return result();
  }

 private:
  struct Outcome {
    bool stopped = false;
    bool ended = false;  // the side has responded or the call has failed
    std::optional<SideError> error{};
  };

  void ask(SideClient& client, Outcome& outcome) {
    std::optional<SideError> error;
    try {
      client.stop();
    } catch (const SideError& failure) {
      error = failure;
    }
    const std::lock_guard lock(mutex_);
    outcome.ended = true;
    outcome.error = error;
    if (!error)
      finish(outcome, &outcome == &slave_outcome_ ? "stopped at the slave" : "stopped at the master");
    changed_.notify_all();
  }

  void finish(Outcome& outcome, const std::string& sentence) {
    if (std::exchange(outcome.stopped, true)) return;
    say(sentence);
    changed_.notify_all();
  }

  void say(const std::string& sentence) {
    said_ += (said_.empty() ? "" : "; ") + sentence;
    if (say_) say_(sentence);
  }

  /// The master passes the stop on in the next datagram of its session, and receives the slave's new state.
  void follow_session() {
    const auto began = std::chrono::steady_clock::now();
    try {
      for (bool waits = master_outcome_.stopped; waits; std::this_thread::sleep_for(kFarCheck)) {
        const proto::Status status = master_.status();
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - began;
        const proto::Figures& link = status.link();
        const bool received = link.has_silence_s() && link.silence_s() >= 0.0;
        const std::lock_guard lock(mutex_);
        if (received && (status.far_state() == "Stopped" || status.far_state() == "Fault"))
          finish(slave_outcome_, "stopped at the slave, by the session of the master");
        waits = received && !slave_outcome_.stopped && waited.count() < link.rtt_s() + kFarBesides_s;
      }
    } catch (const SideError&) {
      // Then only the slave's own response counts.
    }
    const std::lock_guard lock(mutex_);
    followed_ = true;
    changed_.notify_all();
  }

  std::string result() {
    if (!master_outcome_.stopped && !slave_outcome_.stopped)
      throw SideError(SideError::Kind::kDown,
                      "neither side was stopped: " + std::string(slave_outcome_.error->what()) + "; " +
                          master_outcome_.error->what());
    for (const Outcome* one : {&master_outcome_, &slave_outcome_})
      if (!one->stopped) say(one->error->what());
    return said_;
  }

  SideClient master_, slave_;
  const Say say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Outcome master_outcome_, slave_outcome_;
  bool followed_ = false;  // the slave's state is no longer expected by the session
  std::string said_;
};

}  // namespace

std::string stop_sides(const Options& options, const std::function<void(const std::string&)>& say) {
  return StopBothSides(options, say).run();
}

ExitStatus run_stop(const Options& options) {
  if (options.json) {
    print_done(options, stop_sides(options));
  } else {
    (void)stop_sides(options, [&options](const std::string& sentence) { print_done(options, sentence); });
  }
  return ExitStatus::kDone;
}

}  // namespace longreach
