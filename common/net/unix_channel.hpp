#pragma once
// Channel to a program on this machine over a Unix socket (SOCK_SEQPACKET). The other program listens at a
// path and must run as the same user or as root, as reported by the operating system; otherwise the channel
// disconnects. The other program may start later than this one, and may restart. The channel never blocks,
// and it does not allocate memory after construction. Asio is not used: its sockets allocate memory for each
// connection, which here begins in the control loop, and its connect() reports a full queue of the other
// program as another error.

#include <sys/types.h>

#include <optional>
#include <string>

#include "common/wire/channel.hpp"

namespace longreach {

/// Returns the path in an adapter address. Does not connect yet. Throws AddressError for an invalid address.
std::string unix_path(const std::string& address);

/// Connects to the program that listens at `path`. Returns the socket, or -1 (with errno set) if no program
/// listens there. Never blocks.
int connect_unix(const std::string& path);
/// Same as connect_unix, but the connection appears to come from `user`. The permissions of the path are
/// ignored. Requires root.
int connect_unix_as(uid_t user, const std::string& path);
/// Returns why there is no socket at `path`, e.g. "there is no such file" or "it is a folder, not a socket";
/// empty if there is one.
std::string no_socket_there(const std::string& path);
/// Returns why connect_unix(path) failed with `error`.
std::string why_not_connected(const std::string& path, int error);
/// Returns the user that runs the program at the other end, or none if the system does not report it.
std::optional<uid_t> peer_user(int socket);
/// Returns whether `user` is the user of this program or root.
bool may_be_trusted(uid_t user);

class UnixChannel : public Channel {
 public:
  /// Throws AddressError.
  explicit UnixChannel(const std::string& address);
  ~UnixChannel() override;
  UnixChannel(const UnixChannel&) = delete;
  UnixChannel& operator=(const UnixChannel&) = delete;

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  /// While there is no connection, tries to connect from time to time.
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] bool connected() const { return socket_ >= 0; }
  /// User of the listening program, if the last connection was refused because that user is not allowed.
  [[nodiscard]] std::optional<uid_t> unknown_peer() const { return unknown_peer_; }

 private:
  void check_socket();
  void leave();

  std::string path_;
  int socket_ = -1;
  int wait_ = 0;  // number of calls of send() until the next attempt to connect
  std::optional<uid_t> unknown_peer_{};
};

}  // namespace longreach
