#pragma once
// A page without a browser: a plain socket that speaks as much HTTP and WebSocket as the view's server needs.

#include <optional>
#include <string>

namespace longreach {

/// The first line of the answer to a request that is sent as it is; empty: none within 10 s.
std::string http_status(int port, const std::string& request);

class PageClient {
 public:
  /// Opens http://127.0.0.1:PORT/live as a browser on that page would; `ok()` says whether it was let in.
  explicit PageClient(int port);
  ~PageClient();
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  [[nodiscard]] bool ok() const { return ok_; }
  /// False when the server has closed, or takes nothing for a second.
  bool send(const std::string& text) const;
  /// The next message; none: closed, or nothing within 10 s.
  std::optional<std::string> read();
  /// Reads until a message contains `part`; false when there is none within 20 s.
  bool read_until(const std::string& part);

 private:
  bool receive(std::size_t bytes);

  int socket_ = -1;
  bool ok_ = false;
  std::string received_;
};

}  // namespace longreach
