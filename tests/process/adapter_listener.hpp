#pragma once
// The listening end of an adapter's socket, in the test itself. Nothing of the product's.

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace longreach {

class AdapterListener {
 public:
  /// In a folder of its own that goes with it. `anyone`: takes a program of any user.
  explicit AdapterListener(bool anyone = false);
  ~AdapterListener();
  AdapterListener(const AdapterListener&) = delete;
  AdapterListener& operator=(const AdapterListener&) = delete;

  [[nodiscard]] std::string address() const { return "unix:" + path_.string(); }
  /// Of whoever has connected. Never waits.
  std::optional<std::size_t> receive(std::span<std::byte> buffer);
  void send(std::span<const std::byte> datagram) const;

 private:
  bool anyone_;
  std::filesystem::path folder_, path_;
  int fd_ = -1, peer_ = -1;
};

}  // namespace longreach
