#include "common/program/service_watch.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

#include "common/loop/mailbox.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::service_watch_test {
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
  watch.update(0);
  EXPECT_EQ(systemd.heard(), "");  // not ready before the first tick
  watch.update(1);
  EXPECT_EQ(systemd.heard(), "READY=1");
  EXPECT_EQ(systemd.heard(), "WATCHDOG=1");
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(12));
    watch.update(1);
    EXPECT_EQ(systemd.heard(), "") << "the loop stands still";
  }
  watch.update(2);
  EXPECT_EQ(systemd.heard(), "WATCHDOG=1");
  watch.update(3);
  EXPECT_EQ(systemd.heard(), "") << "not more often than is asked for";
}

TEST(ServiceWatch, WithoutAPeriodItTellsThatItIsReadyOnly) {
  for (const char* us : {"", "0", "-5", "soon"}) {
    const TemporaryFolder folder;
    const Supervisor systemd(folder.path() / "notify");
    *us == '\0' ? ::unsetenv("WATCHDOG_USEC") : ::setenv("WATCHDOG_USEC", us, 1);
    ServiceWatch watch;
    watch.update(1);
    watch.update(2);
    EXPECT_EQ(systemd.heard(), "READY=1") << us;
    EXPECT_EQ(systemd.heard(), "") << us;
  }
}

TEST(ServiceWatch, AnAbstractNameIsOneToo) {
  const std::string name = "longreach-notify-" + std::to_string(::getpid());
  const int heard = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  ASSERT_EQ(::bind(heard, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ::setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  ServiceWatch watch;
  ::unsetenv("NOTIFY_SOCKET");
  watch.update(1);
  std::array<char, 64> bytes{};
  EXPECT_EQ(::recv(heard, bytes.data(), bytes.size(), 0), 7);
  EXPECT_EQ(std::string(bytes.data()), "READY=1");
  ::close(heard);
}

TEST(ServiceWatch, SaysNothingToNobody) {
  ServiceWatch no_manager;
  no_manager.update(1);
  // Neither a path nor an abstract name; and one that no address holds.
  const TemporaryFolder folder;
  const Supervisor systemd(folder.path() / "notify");
  for (const std::string& name : {std::string("notify"), std::string(), "/" + std::string(500, 'x')}) {
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    ServiceWatch watch;
    watch.update(1);
    EXPECT_EQ(systemd.heard(), "") << name;
  }
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
}  // namespace longreach::service_watch_test
