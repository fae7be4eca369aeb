#include "common/io/service_watch.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

#include "common/io/mailbox.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace longreach {
namespace {

/// What systemd would listen on.
class Supervisor {
 public:
  explicit Supervisor(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "40000", 1);
  }
  ~Supervisor() {
    ::close(socket_);
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
  }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  [[nodiscard]] std::string heard() const {
    std::array<char, 64> bytes{};
    const ssize_t n = ::recv(socket_, bytes.data(), bytes.size(), 0);
    return n < 0 ? "" : std::string(bytes.data(), static_cast<std::size_t>(n));
  }

 private:
  int socket_;
};

TEST(ServiceWatch, TellsThatItIsReadyAndLivesOnlyWhileTheLoopTicks) {
  const TemporaryFolder folder;
  const Supervisor systemd(folder.path() / "notify");
  ServiceWatch watch;
  watch.look(0);
  EXPECT_EQ(systemd.heard(), "");  // not ready before the first tick
  watch.look(1);
  EXPECT_EQ(systemd.heard(), "READY=1");
  EXPECT_EQ(systemd.heard(), "WATCHDOG=1");
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(12));
    watch.look(1);
    EXPECT_EQ(systemd.heard(), "") << "the loop stands still";
  }
  watch.look(2);
  EXPECT_EQ(systemd.heard(), "WATCHDOG=1");
}

TEST(ServiceWatch, SaysNothingToNobody) {
  ServiceWatch watch;
  watch.look(1);
}

TEST(Mailbox, KeepsNothingOfACommandThatWasAnswered) {
  Mailbox<std::string, int> mailbox;
  std::atomic<const std::string*> seen{nullptr};
  std::thread loop([&] {
    while (seen == nullptr) {
      const std::string* command = mailbox.take();
      if (command == nullptr) continue;
      mailbox.answer(1);
      seen = command;
    }
  });
  EXPECT_EQ(mailbox.post("a secret that is longer than a small string", std::chrono::seconds(60)), 1);
  loop.join();
  EXPECT_EQ(*seen.load(), "");
}

}  // namespace
}  // namespace longreach
