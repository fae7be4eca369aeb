#pragma once
// A channel to a program of this machine: this end of a Unix socket (SOCK_SEQPACKET), whose other end listens
// at a path and belongs to the same user or to root; the system says to whom. Anybody else's is left again.
// The other end may come later, end and come again. Never waits; allocates nothing after construction.

#include <sys/types.h>

#include <optional>
#include <string>

#include "common/wire/channel.hpp"

namespace longreach {

/// The path of an adapter's address. Throws AddressError.
std::string unix_path(const std::string& address);

/// To what listens there; -1: nothing does, with errno. Never waits.
int connect_unix(const std::string& path);
/// Likewise, for the other end a program of `user`, whatever the path's mode; root alone can do that.
int connect_unix_as(uid_t user, const std::string& path);
/// Why no socket can be there: "there is no such file", "it is a folder, not a socket"; empty: one is.
std::string no_socket_there(const std::string& path);
/// Why connect_unix(path) failed with `error`.
std::string why_not_connected(const std::string& path, int error);
/// Who has the other end; none: the system does not say.
std::optional<uid_t> peer_user(int socket);
/// This user, or root.
bool may_be_trusted(uid_t user);

class UnixChannel : public Channel {
 public:
  /// Throws AddressError.
  explicit UnixChannel(const std::string& address);
  ~UnixChannel() override;
  UnixChannel(const UnixChannel&) = delete;
  UnixChannel& operator=(const UnixChannel&) = delete;

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  /// Looks for the other end now and then while there is none.
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] bool connected() const { return socket_ >= 0; }
  /// What listens there belongs to somebody else, when it was looked for last.
  [[nodiscard]] std::optional<uid_t> unknown_peer() const { return unknown_peer_; }

 private:
  void check_socket();
  void leave();

  std::string path_;
  int socket_ = -1;
  int wait_ = 0;  // sends until it is looked for again
  std::optional<uid_t> unknown_peer_{};
};

}  // namespace longreach
