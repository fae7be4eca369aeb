#include "deploy/cli/view/view_server.hpp"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <charconv>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "common/site/rpc_security.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/view/page_session.hpp"

namespace longreach {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
using Tcp = net::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr auto kHandSilence = std::chrono::seconds(1);  // then another viewer may take control
constexpr auto kHandCheck = std::chrono::milliseconds(200);
constexpr auto kAcceptRetry = std::chrono::milliseconds(100);
constexpr int kSendBufferBytes = 65536;  // half a second of frames; older ones are obsolete

std::runtime_error cannot_listen(const std::string& listen, const std::string& why) {
  return std::runtime_error("the view cannot listen on " + listen + " (" + why +
                            "): set --listen to an address:port of this machine, e.g. 127.0.0.1:0");
}

Tcp::endpoint to_endpoint(const std::string& listen) {
  const std::size_t colon = listen.rfind(':');
  if (colon == std::string::npos) throw cannot_listen(listen, "the port is missing");
  std::string host = listen.substr(0, colon);
  if (host == "localhost") host = "127.0.0.1";
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  std::uint16_t port = 0;
  const char* last = listen.data() + listen.size();
  const auto [end, wrong] = std::from_chars(listen.data() + colon + 1, last, port);
  beast::error_code error;
  const auto address = net::ip::make_address(host, error);
  if (error || wrong != std::errc{} || end != last) throw cannot_listen(listen, "it is not a valid address");
  return {address, port};
}

}  // namespace

struct ViewServer::State {
  explicit State(const std::string& listen) : acceptor(context) { open(listen, to_endpoint(listen)); }

  void open(const std::string& listen, const Tcp::endpoint& endpoint) {
    beast::error_code error;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
    if (error) throw cannot_listen(listen, error.message());
    const int port = acceptor.local_endpoint().port();
    access.loopback = endpoint.address().is_loopback();
    access.token = draw_token();
    address = "http://" + listen.substr(0, listen.rfind(':')) + ":" + std::to_string(port) + "/" +
              access.token + "/";
  }

  void accept() {
    acceptor.async_accept([this](beast::error_code error, Tcp::socket socket) {
      if (error) return accept_later();
      if (connections < kConnectionsMax || make_room()) welcome(std::move(socket));
      accept();
    });
  }

  /// Usually this process has no free descriptors. Retrying at once would loop forever.
  void accept_later() {
    retry.expires_after(kAcceptRetry);
    retry.async_wait([this](beast::error_code error) {
      if (!error) accept();
    });
  }

  void welcome(Tcp::socket socket) {
    beast::error_code ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    socket.set_option(net::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    ++connections;
    const std::shared_ptr<void> slot(nullptr, [this](void*) { --connections; });
    const auto page_session =
        std::make_shared<PageSession>(std::move(socket), access, viewer_backend(), slot);
    page_sessions.push_back(page_session);
    page_session->read();
  }

  /// Drops the oldest connection that has not presented the token. Returns false if all have.
  bool make_room() {
    page_sessions.remove_if([](const auto& page_session) { return page_session.expired(); });
    const auto unknown_peer = std::ranges::find_if(
        page_sessions, [](const auto& page_session) { return !page_session.lock()->let_in(); });
    if (unknown_peer == page_sessions.end()) return false;
    unknown_peer->lock()->drop();
    page_sessions.erase(unknown_peer);
    return true;
  }

  Viewer::Backend viewer_backend() {
    return {
        .opened = [this](const auto& viewer) { on_opened(viewer); },
        .page_command = [this](const auto& viewer,
                               const PageCommand& page_command) { on_page_command(viewer, page_command); },
        .closed = [this](const auto& viewer) { on_closed(viewer); }};
  }

  void on_opened(const std::shared_ptr<Viewer>& viewer) {
    if (viewers.size() >= static_cast<std::size_t>(kViewersMax)) {
      viewer->tell(std::make_shared<const std::string>(
          R"({"full":"the maximum number of pages is open: close one of them"})"));
      return;
    }
    viewers.insert(viewer);
    for (const auto& [topic, text] : topics) viewer->tell(text);
    notify_holders();
  }

  void on_closed(const std::shared_ptr<Viewer>& viewer) {
    viewers.erase(viewer);
    if (viewer == holder) let_go(true);
    notify_holders();
  }

  void on_page_command(const std::shared_ptr<Viewer>& viewer, const PageCommand& page_command) {
    using Kind = PageCommand::Kind;
    // Every viewer may stop the robot.
    if (page_command.kind == Kind::kStop) return backend.act(page_command);
    if (page_command.kind == Kind::kTake) return take(viewer);
    if (viewer != holder) {
      // Aims that were in transit when the viewer lost control are not an error.
      if (page_command.kind != Kind::kAim && page_command.kind != Kind::kGive)
        viewer->tell(std::make_shared<const std::string>(
            R"({"said":"take control first: only the page that has control may do this","refused":true})"));
      return;
    }
    if (page_command.kind == Kind::kGive) {
      let_go(false);
      return notify_holders();
    }
    if (page_command.kind != Kind::kAim) return backend.act(page_command);
    aimed = Clock::now();
    backend.aim(page_command.aim);
  }

  void take(const std::shared_ptr<Viewer>& viewer) {
    if (holder && holder != viewer) {
      viewer->tell(std::make_shared<const std::string>(
          R"({"said":"another page has control: that page must return control first","refused":true})"));
      return;
    }
    holder = viewer;
    aimed = Clock::now();
    notify_holders();
  }

  void let_go(bool lost) {
    if (!holder) return;
    holder.reset();
    backend.let_go(lost);
  }

  /// The master has already timed out the hand of a silent page. Here the page also loses control, so that
  /// other viewers can take it.
  void check_hand() {
    timer.expires_after(kHandCheck);
    timer.async_wait([this](beast::error_code error) {
      if (error) return;
      if (holder && Clock::now() - aimed > kHandSilence) {
        holder->tell(std::make_shared<const std::string>(
            R"({"said":"no message from this page arrived for 1 s, so the page lost control","refused":true})"));
        let_go(true);
        notify_holders();
      }
      check_hand();
    });
  }

  void notify_holders() {
    const std::string viewers_text = std::to_string(viewers.size());
    for (const auto& viewer : std::set<std::shared_ptr<Viewer>>(viewers)) {
      const char* who = !holder ? "nobody" : holder == viewer ? "you" : "other";
      viewer->tell(std::make_shared<const std::string>(std::string(R"({"desk":{"holder":")") + who +
                                                       R"(","viewers":)" + viewers_text + "}}"));
    }
  }

  template <class Do>
  void for_all(Do what) {
    // Iterates over a copy, because a viewer that is disconnected leaves the set.
    for (const auto& viewer : std::set<std::shared_ptr<Viewer>>(viewers)) what(*viewer);
  }

  void show_pending() {
    std::optional<std::string> frame;
    {
      const std::lock_guard lock(mutex);
      frame.swap(pending);
    }
    if (!frame) return;
    const auto text = std::make_shared<const std::string>(*std::move(frame));
    for_all([&](Viewer& viewer) { viewer.show(text); });
  }

  int connections = 0;  // all viewers are destroyed with the context
  net::io_context context{1};
  PageBackend backend;
  Tcp::acceptor acceptor;
  net::steady_timer timer{context}, retry{context};
  PageAccess access;
  std::string address;
  std::mutex mutex;
  std::optional<std::string> pending;  // frame that the thread has not fetched yet
  // Used by the thread only.
  std::set<std::shared_ptr<Viewer>> viewers;
  std::list<std::weak_ptr<PageSession>> page_sessions;  // oldest first; some have ended
  std::map<std::string, Viewer::Text> topics;
  std::shared_ptr<Viewer> holder;
  Clock::time_point aimed{};
  std::thread thread;
};

ViewServer::ViewServer(const std::string& listen) : state_(std::make_unique<State>(listen)) {}
ViewServer::~ViewServer() { stop(); }

void ViewServer::serve(PageBackend backend) {
  state_->backend = std::move(backend);
  state_->accept();
  state_->check_hand();
  state_->thread = std::thread([state = state_.get()] { state->context.run(); });
}

void ViewServer::stop() {
  state_->context.stop();
  if (state_->thread.joinable()) state_->thread.join();
}

const std::string& ViewServer::address() const { return state_->address; }

void ViewServer::show(std::string frame) {
  {
    const std::lock_guard lock(state_->mutex);
    const bool asked = state_->pending.has_value();
    state_->pending = std::move(frame);
    if (asked) return;
  }
  boost::asio::post(state_->context, [state = state_.get()] { state->show_pending(); });
}

void ViewServer::tell(const std::string& topic, std::string text) {
  const auto shared = std::make_shared<const std::string>(std::move(text));
  boost::asio::post(state_->context, [state = state_.get(), topic, shared] {
    Viewer::Text& last = state->topics[topic];
    if (last && *last == *shared) return;
    last = shared;
    state->for_all([&](Viewer& viewer) { viewer.tell(shared); });
  });
}

void ViewServer::say(std::string text) {
  const auto shared = std::make_shared<const std::string>(std::move(text));
  boost::asio::post(state_->context, [state = state_.get(), shared] {
    state->for_all([&](Viewer& viewer) { viewer.tell(shared); });
  });
}

void ViewServer::revoke(const std::string& why) {
  boost::asio::post(state_->context, [state = state_.get(), why] {
    if (!state->holder) return;
    state->holder->tell(
        std::make_shared<const std::string>("{\"said\":" + json_string(why) + ",\"refused\":true}"));
    state->let_go(true);
    state->notify_holders();
  });
}

}  // namespace longreach
