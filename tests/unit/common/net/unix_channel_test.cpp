#include "common/net/unix_channel.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>

#include "common/config/config.hpp"
#include "common/net/adapter_channel.hpp"
#include "common/net/address.hpp"
#include "common/wire/adapter_port.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::unix_channel_test {
namespace {

int listen_at(const std::string& path) {
  sockaddr_un own{};
  own.sun_family = AF_UNIX;
  path.copy(own.sun_path, sizeof own.sun_path - 1);
  const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
  EXPECT_EQ(::listen(fd, 1), 0);
  return fd;
}

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string received(UnixChannel& channel) {
  std::array<std::byte, 8> buffer{};
  const auto size = channel.receive(buffer);
  return size ? std::string(reinterpret_cast<const char*>(buffer.data()), std::min(*size, buffer.size())) +
                    ":" + std::to_string(*size)
              : "nothing";
}

struct UnixChannelTest : ::testing::Test {
  TemporaryFolder folder;
  std::string path = folder.path() / "socket";
  UnixChannel channel{"unix:" + path};

  /// As often as it takes to look for the other end again.
  void check_socket() {
    for (int i = 0; i < 30 && !channel.connected(); ++i) channel.send(bytes("x"));
  }
};

TEST_F(UnixChannelTest, SpeaksToWhatListensThereHoweverOftenItStartsAgain) {
  check_socket();
  EXPECT_FALSE(channel.connected());
  EXPECT_EQ(received(channel), "nothing");
  for (int i = 0; i < 3; ++i) {
    const int listener = listen_at(path);
    check_socket();
    ASSERT_TRUE(channel.connected());
    const int peer = ::accept(listener, nullptr, nullptr);
    channel.send(bytes("hello"));
    std::array<char, 16> heard{};
    ASSERT_EQ(::recv(peer, heard.data(), heard.size(), 0), 1);
    ASSERT_EQ(::recv(peer, heard.data(), heard.size(), 0), 5);
    EXPECT_EQ(std::string(heard.data(), 5), "hello");
    ASSERT_EQ(::send(peer, "to you", 6, 0), 6);
    ASSERT_EQ(::send(peer, "longer than it", 14, 0), 14);
    EXPECT_EQ(received(channel), "to you:6");
    EXPECT_EQ(received(channel), "longer t:14");
    EXPECT_EQ(received(channel), "nothing");
    EXPECT_TRUE(channel.connected());
    ::close(peer);
    ::close(listener);
    ::unlink(path.c_str());
    EXPECT_EQ(received(channel), "nothing");
    EXPECT_FALSE(channel.connected());
  }
  EXPECT_FALSE(channel.unknown_peer());
}

TEST_F(UnixChannelTest, SaysNothingToWhatBelongsToAnotherUser) {
  if (::geteuid() != 0) return;  // another user is needed
  ::chmod(folder.path().c_str(), 0777);
  int pipes[2];
  ASSERT_EQ(::pipe(pipes), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::setuid(65534) != 0) ::_exit(1);
    const int listener = listen_at(path);
    [[maybe_unused]] const ssize_t reported = ::write(pipes[1], "x", 1);
    const int peer = ::accept(listener, nullptr, nullptr);
    char byte = 0;
    ::_exit(::recv(peer, &byte, 1, 0) == 0 ? 0 : 2);
  }
  char ready = 0;
  ASSERT_EQ(::read(pipes[0], &ready, 1), 1);
  for (int i = 0; i < 30 && !channel.unknown_peer(); ++i) channel.send(bytes("x"));
  EXPECT_EQ(channel.unknown_peer(), 65534u);
  EXPECT_FALSE(channel.connected());
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);  // it heard nothing
  ::close(pipes[0]);
  ::close(pipes[1]);
  AdapterFigures figures{.present = true, .unknown_peer = channel.unknown_peer()};
  EXPECT_NE(adapter_trouble(figures, "robot", "unix:/x").find("belongs to another user (uid 65534)"),
            std::string::npos);
}

TEST(UnixChannel, TrustsThisUserAndRoot) {
  EXPECT_TRUE(may_be_trusted(::geteuid()));
  EXPECT_TRUE(may_be_trusted(0));
  EXPECT_FALSE(may_be_trusted(::geteuid() + 1));
}

TEST(UnixChannel, RefusesWhatIsNoAddressOfAnAdapter) {
  for (const std::string& address :
       {std::string("127.0.0.1:47101"), std::string("/run/robot"), std::string("unix:here"),
        std::string("unix:"), "unix:/" + std::string(107, 'x')})
    EXPECT_THROW(UnixChannel{address}, AddressError) << address;
  EXPECT_EQ(unix_path("unix:/" + std::string(106, 'x')).size(), 107u);
}

TEST(AdapterChannel, RpcInClearAndSomethingRealDoNotGoTogether) {
  const AdapterConfig real{.address = "unix:/run/robot"};
  EXPECT_THROW(refuse_insecure(true, real, "robot"), ConfigError);
  EXPECT_NO_THROW(refuse_insecure(false, real, "robot"));
  EXPECT_NO_THROW(refuse_insecure(true, {}, "robot"));
}

}  // namespace
}  // namespace longreach::unix_channel_test
