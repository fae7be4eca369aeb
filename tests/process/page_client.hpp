#pragma once
// A page without a browser: a plain socket that speaks as much HTTP and WebSocket as the view's server needs.

#include <optional>
#include <string>

namespace longreach {

/// Of http://127.0.0.1:PORT/...
int port_of(const std::string& address);
/// "/TOKEN/" of http://127.0.0.1:PORT/TOKEN/.
std::string path_of(const std::string& address);

/// The first line of the answer to a request that is sent as it is; empty: none within 10 s.
std::string http_status(int port, const std::string& request);

/// A connection that says what it is told to, and is not in a hurry.
class OpenConnection {
 public:
  explicit OpenConnection(int port);
  ~OpenConnection();
  OpenConnection(const OpenConnection&) = delete;
  OpenConnection& operator=(const OpenConnection&) = delete;

  [[nodiscard]] bool send(const std::string& bytes) const;
  /// The server has closed it. Does not wait.
  [[nodiscard]] bool ended() const;

 private:
  int socket_ = -1;
};

class PageClient {
 public:
  /// Opens the WebSocket of the page at `address`, http://127.0.0.1:PORT/TOKEN/, as a browser on that page
  /// would; `ok()` says whether it was let in.
  explicit PageClient(const std::string& address);
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
