// longreach view: forwards the data of both sides to the viewers, and the commands of the viewer in control
// to the sides.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

#include "common/config/config.hpp"
#include "common/loop/stop_signal.hpp"
#include "common/site/rpc_security.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/cli/view/view_feed.hpp"
#include "deploy/cli/view/view_hand.hpp"
#include "deploy/cli/view/view_server.hpp"

namespace longreach {
namespace {

constexpr std::size_t kPageCommandsMax = 16;
constexpr auto kEndCheck = std::chrono::milliseconds(100);

using Say = std::function<void(std::string)>;

/// Says the outcome of `act`, or why it failed.
void act_and_say(const Say& say, const std::function<std::string()>& act) {
  try {
    say("{\"said\":" + json_string(act()) + ",\"refused\":false}");
  } catch (const std::exception& error) {
    say("{\"said\":" + json_string(error.what()) + ",\"refused\":true}");
  }
}

/// Executes every stop at once, also while an earlier one waits for the response of a side.
class PageStops {
 public:
  PageStops(const Options& options, Say say) : options_(options), say_(std::move(say)) {}

  void add() {
    std::erase_if(running_, [](const auto& one) {
      return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    if (running_.size() >= kPageCommandsMax) return;  // each of them has been sent to both sides
    running_.push_back(std::async(std::launch::async,
                                  [this] { act_and_say(say_, [this] { return stop_sides(options_); }); }));
  }

 private:
  const Options options_;
  const Say say_;
  std::vector<std::future<void>> running_;
};

/// Executes commands one after the other. Commands that arrive while too many are pending are refused.
class CommandQueue {
 public:
  CommandQueue(const Options& options, Say say) : options_(options), say_(std::move(say)) {
    thread_ = std::thread([this] { run(); });
  }
  ~CommandQueue() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      changed_.notify_all();
    }
    thread_.join();
  }
  CommandQueue(const CommandQueue&) = delete;
  CommandQueue& operator=(const CommandQueue&) = delete;

  void add(const PageCommand& page_command) {
    const std::lock_guard lock(mutex_);
    if (page_commands_.size() >= kPageCommandsMax) return;
    page_commands_.push_back(page_command);
    changed_.notify_all();
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ended_ || !page_commands_.empty(); });
      if (ended_) return;
      const PageCommand page_command = page_commands_.front();
      page_commands_.pop_front();
      lock.unlock();
      act_and_say(say_, [&] { return done(page_command); });
      lock.lock();
    }
  }

  [[nodiscard]] std::string done(const PageCommand& page_command) const {
    using Do = PageCommand::Kind;
    if (page_command.kind == Do::kLink) {
      LinkSetCommand command;
      command.profile = page_command.link;
      set_link(options_, command);
      return "the link now has the profile " + page_command.link;
    }
    SideClient master(Side::kMaster, options_);
    proto::Action action;
    if (page_command.kind == Do::kMode) action.set_mode(page_command.mode);
    if (page_command.kind == Do::kScale) action.set_scale(page_command.value);
    if (page_command.kind == Do::kKv) action.set_kv_per_s(page_command.value);
    if (page_command.kind == Do::kEngage) action.mutable_engage();
    return master.run(action);
  }

  const Options options_;
  const Say say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PageCommand> page_commands_;
  bool ended_ = false;
  std::thread thread_;
};

/// Names of the link profiles that can be chosen; empty if there is no folder with profiles.
std::string profiles_json() {
  std::vector<std::string> names;
  try {
    for (const auto& file : std::filesystem::directory_iterator(find_deploy_folder() / "links"))
      if (file.path().extension() == ".txtpb") names.push_back(file.path().stem().string());
  } catch (const std::exception&) {
    names.clear();
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + json_string(name);
  return "{\"links\":[" + text + "]}";
}

/// "ssh -L 8080:127.0.0.1:8080 HOST" for http://127.0.0.1:8080/TOKEN/
std::string tunnel_to(const std::string& address) {
  const std::string here = address.substr(7, address.find('/', 7) - 7);
  std::array<char, 256> host{};
  const bool named = ::gethostname(host.data(), host.size() - 1) == 0 && host[0] != '\0';
  return "ssh -L " + here.substr(here.rfind(':') + 1) + ":" + here + " " + (named ? host.data() : "HOST");
}

}  // namespace

ExitStatus run_view(const Options& options, const ViewCommand& command) {
  const auto& stop = stop_requested();
  ViewServer server(command.listen);
  const auto say = [&server](std::string text) { server.say(std::move(text)); };
  CommandQueue command_queue(options, say);
  PageStops stops(options, say);
  ViewHand hand(options, [&server](const std::string& why) { server.revoke(why); });
  const ViewFeed feed(options, {.frame = [&](std::string frame) { server.show(std::move(frame)); },
                                .tell = [&](const std::string& topic,
                                            std::string text) { server.tell(topic, std::move(text)); }});
  server.tell("links", profiles_json());
  server.serve({.act =
                    [&](const PageCommand& page_command) {
                      if (page_command.kind == PageCommand::Kind::kStop) return stops.add();
                      command_queue.add(page_command);
                    },
                .aim = [&](const proto::HandAim& aim) { hand.aim(aim); },
                .let_go = [&](bool lost) { hand.let_go(lost); }});
  if (options.json) {
    std::cout << "{\"address\":" << json_string(server.address()) << "}" << std::endl;
  } else {
    std::cout << "the page is at " << server.address() << "  (Ctrl-C quits)" << std::endl;
    if (is_loopback(command.listen))
      std::cout << "for a browser on another computer, run there " << tunnel_to(server.address())
                << " and open the same address" << std::endl;
  }
  while (!stop) std::this_thread::sleep_for(kEndCheck);
  server.stop();
  if (options.connections) options.connections->cancel();
  return ExitStatus::kDone;
}

}  // namespace longreach
