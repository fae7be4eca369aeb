#pragma once
// The listening end of an adapter socket, implemented for tests without using code of the product.

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace longreach {

class AdapterListener {
 public:
  /// Listens in its own temporary folder. If `anyone` is true, accepts programs of any user.
  explicit AdapterListener(bool anyone = false);
  ~AdapterListener();
  AdapterListener(const AdapterListener&) = delete;
  AdapterListener& operator=(const AdapterListener&) = delete;

  [[nodiscard]] std::string address() const { return "unix:" + path_.string(); }
  /// Receives a datagram from the connected program and returns its size, or std::nullopt if there is none.
  /// Does not block.
  std::optional<std::size_t> receive(std::span<std::byte> buffer);
  void send(std::span<const std::byte> datagram) const;

 private:
  bool anyone_;
  std::filesystem::path folder_, path_;
  int fd_ = -1, peer_ = -1;
};

}  // namespace longreach
