#pragma once
// A client of the page without a browser: a plain socket that implements the subset of HTTP and WebSocket
// that the view server requires.

#include <optional>
#include <string>

namespace longreach {

/// Returns the PORT of http://127.0.0.1:PORT/...
int port_of(const std::string& address);
/// Returns "/TOKEN/" of http://127.0.0.1:PORT/TOKEN/.
std::string path_of(const std::string& address);

/// Sends a request unchanged and returns the first line of the response, or an empty string if there is none
/// within 10 s.
std::string http_status(int port, const std::string& request);

/// A TCP connection that sends arbitrary bytes and stays open without a timeout.
class OpenConnection {
 public:
  explicit OpenConnection(int port);
  ~OpenConnection();
  OpenConnection(const OpenConnection&) = delete;
  OpenConnection& operator=(const OpenConnection&) = delete;

  [[nodiscard]] bool send(const std::string& bytes) const;
  /// Returns, without blocking, whether the server has closed the connection.
  [[nodiscard]] bool ended() const;

 private:
  int socket_ = -1;
};

class PageClient {
 public:
  /// Opens the WebSocket of the page at `address` (http://127.0.0.1:PORT/TOKEN/), as a browser would on that
  /// page. `ok()` returns whether the server accepted the connection.
  explicit PageClient(const std::string& address);
  ~PageClient();
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  [[nodiscard]] bool ok() const { return ok_; }
  /// Returns false if the server has closed the connection or does not receive the data within one second.
  bool send(const std::string& text) const;
  /// Returns the next message, or std::nullopt if the connection was closed or there is no message within 10
  /// s.
  std::optional<std::string> read();
  /// Reads until a message contains `part`. Returns false if there is none within 20 s.
  bool read_until(const std::string& part);

 private:
  bool receive(std::size_t bytes);

  int socket_ = -1;
  bool ok_ = false;
  std::string received_;
};

}  // namespace longreach
