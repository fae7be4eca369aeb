#include "deploy/cli/view/viewer.hpp"

#include <algorithm>

namespace longreach {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMessageMaxBytes = 4096;
constexpr int kMessagesMax = 300;  // per second; a page sends 60 aims per second and the clicks
constexpr std::size_t kFramesMax = 4;
constexpr std::size_t kTextsMax = 64;

}  // namespace

Viewer::Viewer(beast::tcp_stream stream, Backend backend)
    : socket_(std::move(stream)), backend_(std::move(backend)) {
  auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.handshake_timeout = std::chrono::seconds(5);
  timeout.idle_timeout = std::chrono::seconds(10);
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.read_message_max(kMessageMaxBytes);
  socket_.text(true);
}

void Viewer::accept(const ViewHttpRequest& request) {
  beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own timeouts
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    self->opened_ = true;
    self->backend_.opened(self);
    self->read();
  });
}

void Viewer::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t bytes) {
    if (error) return self->close();
    self->on_message(bytes);
  });
}

void Viewer::on_message(std::size_t bytes) {
  const auto* text = static_cast<const char*>(buffer_.data().data());
  const auto page_command = socket_.got_text() ? read_page_command({text, bytes}) : std::nullopt;
  buffer_.consume(bytes);
  if (!page_command || too_many()) return close();
  backend_.page_command(shared_from_this(), *page_command);
  if (!closed_) read();
}

bool Viewer::too_many() {
  const auto now = Clock::now();
  if (now - counted_since_ > std::chrono::seconds(1)) {
    counted_since_ = now;
    said_ = 0;
  }
  return ++said_ > kMessagesMax;
}

void Viewer::show(const Text& frame) {
  const auto frames = std::count_if(queue_.begin(), queue_.end(), [](const Waiting& w) { return w.frame; });
  if (frames >= static_cast<std::ptrdiff_t>(kFramesMax)) {
    // The element that is being written is never dropped.
    const auto oldest =
        std::find_if(queue_.begin() + 1, queue_.end(), [](const Waiting& w) { return w.frame; });
    if (oldest != queue_.end()) queue_.erase(oldest);
  }
  push({frame, true});
}

void Viewer::tell(const Text& text) {
  if (queue_.size() >= kTextsMax) return close();
  push({text, false});
}

void Viewer::push(Waiting waiting) {
  if (closed_ || !opened_) return;
  queue_.push_back(std::move(waiting));
  if (queue_.size() == 1) write();
}

void Viewer::write() {
  const auto buffer = boost::asio::buffer(*queue_.front().text);
  socket_.async_write(buffer, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->close();
    self->queue_.pop_front();
    if (!self->queue_.empty()) self->write();
  });
}

void Viewer::close() {
  if (closed_) return;
  closed_ = true;
  beast::get_lowest_layer(socket_).close();
  if (opened_) backend_.closed(shared_from_this());
}

}  // namespace longreach
