#pragma once
// Channel to a program on this machine: one end of a Unix socket (SOCK_SEQPACKET). The other end listens at a
// path and must belong to the same user or to root, according to the system; otherwise it is disconnected.
// The other end may start later, end and restart. The channel never blocks, and allocates nothing after
// construction.

#include <sys/types.h>

#include <optional>
#include <string>

#include "common/wire/channel.hpp"

namespace longreach {

/// Returns the path in an adapter address. Throws AddressError.
std::string unix_path(const std::string& address);

/// Connects to the program that listens there; returns -1 with errno if there is none. Never blocks.
int connect_unix(const std::string& path);
/// The same, with the identity of `user` towards the other end, regardless of the mode of the path; needs
/// root.
int connect_unix_as(uid_t user, const std::string& path);
/// Returns why there is no socket: "there is no such file", "it is a folder, not a socket"; empty: there is
/// one.
std::string no_socket_there(const std::string& path);
/// Returns why connect_unix(path) failed with `error`.
std::string why_not_connected(const std::string& path, int error);
/// Returns the user of the other end; none if the system does not report it.
std::optional<uid_t> peer_user(int socket);
/// Returns whether it is this user or root.
bool may_be_trusted(uid_t user);

class UnixChannel : public Channel {
 public:
  /// Throws AddressError.
  explicit UnixChannel(const std::string& address);
  ~UnixChannel() override;
  UnixChannel(const UnixChannel&) = delete;
  UnixChannel& operator=(const UnixChannel&) = delete;

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  /// Tries to connect from time to time while there is no other end.
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] bool connected() const { return socket_ >= 0; }
  /// The user of the listening program, if it was another user at the last attempt.
  [[nodiscard]] std::optional<uid_t> unknown_peer() const { return unknown_peer_; }

 private:
  void check_socket();
  void leave();

  std::string path_;
  int socket_ = -1;
  int wait_ = 0;  // sends until the next attempt to connect
  std::optional<uid_t> unknown_peer_{};
};

}  // namespace longreach
