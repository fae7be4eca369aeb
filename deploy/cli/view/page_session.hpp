#pragma once
// One connection to the view server, until its request has been served or it becomes a viewer. Each request
// has a timeout of 5 s. The session runs in the server's thread.

#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <optional>

#include "deploy/cli/view/page_access.hpp"
#include "deploy/cli/view/viewer.hpp"

namespace longreach {

class PageSession : public std::enable_shared_from_this<PageSession> {
 public:
  /// `access` must outlive the session. `slot` is held until the connection ends.
  PageSession(boost::asio::ip::tcp::socket socket, const PageAccess& access, Viewer::Backend backend,
              std::shared_ptr<void> slot);

  void read();
  /// True after the first request with the correct token.
  [[nodiscard]] bool let_in() const { return let_in_; }
  /// Closes the connection to make room for another one.
  void drop() { stream_.close(); }

 private:
  void on_request();

  boost::beast::tcp_stream stream_;
  const PageAccess& access_;
  Viewer::Backend backend_;
  std::shared_ptr<void> slot_;
  bool let_in_ = false;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
};

}  // namespace longreach
