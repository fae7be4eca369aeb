// The page for the browser: what both sides tell goes to the viewers, what the one with the hand asks goes to
// the sides.

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

#include "common/config/config.hpp"
#include "common/loop/stop_signal.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/cli/view/view_feed.hpp"
#include "deploy/cli/view/view_hand.hpp"
#include "deploy/cli/view/view_server.hpp"

namespace longreach {
namespace {

constexpr std::size_t kWishesMax = 16;
constexpr auto kEndCheck = std::chrono::milliseconds(100);

/// Carries out wishes one after the other; what comes while too many wait is refused.
class Errands {
 public:
  using Say = std::function<void(std::string)>;

  Errands(const Options& options, Say say) : options_(options), say_(std::move(say)) {
    thread_ = std::thread([this] { run(); });
  }
  ~Errands() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      changed_.notify_all();
    }
    thread_.join();
  }
  Errands(const Errands&) = delete;
  Errands& operator=(const Errands&) = delete;

  void add(const ViewWish& wish) {
    const std::lock_guard lock(mutex_);
    if (wishes_.size() >= kWishesMax) return;
    wishes_.push_back(wish);
    changed_.notify_all();
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ended_ || !wishes_.empty(); });
      if (ended_) return;
      const ViewWish wish = wishes_.front();
      wishes_.pop_front();
      lock.unlock();
      go(wish);
      lock.lock();
    }
  }

  void go(const ViewWish& wish) const {
    try {
      say_("{\"said\":" + json_string(done(wish)) + ",\"refused\":false}");
    } catch (const std::exception& error) {
      say_("{\"said\":" + json_string(error.what()) + ",\"refused\":true}");
    }
  }

  [[nodiscard]] std::string done(const ViewWish& wish) const {
    using Kind = ViewWish::Kind;
    if (wish.kind == Kind::kStop) return stop_sides(options_);
    if (wish.kind == Kind::kLink) {
      LinkSetCommand command;
      command.profile = wish.link;
      set_link(options_, command);
      return "the link is now like " + wish.link;
    }
    SideClient master(Side::kMaster, options_);
    if (wish.kind == Kind::kMode) return master.set_mode(wish.mode);
    if (wish.kind == Kind::kScale) return master.set_scale(wish.scale);
    return master.engage();
  }

  const Options options_;
  const Say say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ViewWish> wishes_;
  bool ended_ = false;
  std::thread thread_;
};

/// Names of the link profiles that can be chosen; none where there is no folder of them.
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

}  // namespace

ExitStatus run_view(const Options& options, const ViewCommand& command) {
  const auto& stop = stop_requested();
  ViewServer server(command.listen);
  const auto say = [&server](std::string text) { server.say(std::move(text)); };
  // A stop waits for nothing that was asked before.
  Errands errands(options, say);
  Errands stops(options, say);
  ViewHand hand(options, [&server](const std::string& why) { server.revoke(why); });
  const ViewFeed feed(options, {.frame = [&](std::string frame) { server.show(std::move(frame)); },
                                .tell = [&](const std::string& topic,
                                            std::string text) { server.tell(topic, std::move(text)); }});
  server.tell("links", profiles_json());
  server.serve(
      {.act = [&](const ViewWish& wish) { (wish.kind == ViewWish::Kind::kStop ? stops : errands).add(wish); },
       .aim = [&](const proto::HandAim& aim) { hand.aim(aim); },
       .let_go = [&](bool lost) { hand.let_go(lost); }});
  if (options.json) {
    std::cout << "{\"address\":" << json_string(server.address()) << "}" << std::endl;
  } else {
    std::cout << "the page is at " << server.address() << "  (Ctrl-C ends it)" << std::endl;
  }
  while (!stop) std::this_thread::sleep_for(kEndCheck);
  server.stop();
  return ExitStatus::kDone;
}

}  // namespace longreach
