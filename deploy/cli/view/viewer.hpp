#pragma once
// One open page: a WebSocket with a short send queue. The viewer runs in the server's thread.

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "deploy/cli/view/page_command.hpp"

namespace longreach {

using ViewHttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  struct Backend {
    std::function<void(const std::shared_ptr<Viewer>&)> opened;
    std::function<void(const std::shared_ptr<Viewer>&, const PageCommand&)> page_command;
    std::function<void(const std::shared_ptr<Viewer>&)> closed;  // called once, if `opened` was called
  };
  using Text = std::shared_ptr<const std::string>;

  Viewer(boost::beast::tcp_stream stream, Backend backend);

  void accept(const ViewHttpRequest& request);
  /// Sends a frame. If too many frames are queued, the oldest one is dropped.
  void show(const Text& frame);
  /// Sends a message that must not be dropped. A viewer with too many queued messages is disconnected.
  void tell(const Text& text);
  void close();

 private:
  struct Waiting {
    Text text;
    bool frame = false;
  };

  void read();
  void on_message(std::size_t bytes);
  [[nodiscard]] bool too_many();
  void push(Waiting waiting);
  void write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Backend backend_;
  boost::beast::flat_buffer buffer_;
  std::deque<Waiting> queue_;  // the first element is being written
  bool opened_ = false;
  bool closed_ = false;
  int said_ = 0;  // number of messages received since `counted_since_`
  std::chrono::steady_clock::time_point counted_since_{};
};

}  // namespace longreach
