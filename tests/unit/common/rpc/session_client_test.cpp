// The master's search for a session, against a slave's RPC server that lives in the test.
#include "common/rpc/session_client.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/rpc/rpc_server.hpp"
#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach::session_client_test {
namespace {

/// What the loop would know and take.
class FakeLoop {
 public:
  SessionClient::Present present() {
    const std::lock_guard lock(mutex_);
    return {adopted_.empty() ? 0 : adopted_.back().number, silence_s_, "192.0.2.7:47001", unknown_peers_};
  }
  bool adopt(const Session& session) {
    const std::lock_guard lock(mutex_);
    adopted_.push_back(session);
    silence_s_ = 0.0;
    return true;
  }
  void speak_again() {
    const std::lock_guard lock(mutex_);
    silence_s_ = 0.0;
  }
  void receive_nothing() {
    const std::lock_guard lock(mutex_);
    silence_s_ = std::numeric_limits<double>::infinity();
  }
  void receive_from_elsewhere() {
    const std::lock_guard lock(mutex_);
    unknown_peers_ = 127;
  }
  void fall_silent() {
    const std::lock_guard lock(mutex_);
    silence_s_ = 1.5;
  }
  std::vector<Session> adopted() {
    const std::lock_guard lock(mutex_);
    return adopted_;
  }

 private:
  std::mutex mutex_;
  std::vector<Session> adopted_;
  double silence_s_ = 0.0;
  std::uint64_t unknown_peers_ = 0;
};

bool eventually(const std::function<bool()>& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

struct Search {
  explicit Search(const std::string& address, bool take = false)
      : session_client(
            address, RpcSecurity{}, take, 400.0, [this] { return loop.present(); },
            [this](const Session& s) { return loop.adopt(s); }) {}
  FakeLoop loop;
  SessionClient session_client;
};

TEST(SessionClient, OpensASessionAtTheStart) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address());
  ASSERT_TRUE(eventually([&] { return !search.loop.adopted().empty(); }));
  const Session session = search.loop.adopted().front();
  EXPECT_EQ(session.number, 77u);
  EXPECT_EQ(session.cipher, Cipher::kChaCha20Poly1305);
  for (const std::byte b : session.secret) EXPECT_EQ(b, std::byte{'s'});
  EXPECT_EQ(search.session_client.trouble(), "");
}

TEST(SessionClient, KeepsKnownSessionAndReplacesForgottenOne) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address());
  ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 1; }));
  search.loop.fall_silent();
  ASSERT_TRUE(eventually([&] { return backend.calls().size() >= 3; }));
  EXPECT_EQ(search.loop.adopted().size(), 1u);
  EXPECT_EQ(search.session_client.trouble(), "");
  backend.put_session(78);  // as after a restart
  ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 2; }));
  EXPECT_EQ(search.loop.adopted().back().number, 78u);
}

TEST(SessionClient, SaysWhoDoesNotAnswerAndWhatToDoAndFindsItLater) {
  FakeBackend backend("slave");
  auto server = std::make_unique<RpcServer>("127.0.0.1:0", backend, "slave");
  const std::string address = server->address();
  server.reset();
  Search search(address);
  ASSERT_TRUE(eventually([&] { return !search.session_client.trouble().empty(); }));
  for (const std::string& part : {address, std::string("slave"), std::string("no program is listening there"),
                                  std::string("longreach-slave"), std::string("link.slave_rpc")})
    EXPECT_NE(search.session_client.trouble().find(part), std::string::npos)
        << search.session_client.trouble();
  RpcServer again(address, backend, "slave");
  ASSERT_TRUE(eventually([&] { return !search.loop.adopted().empty(); })) << search.session_client.trouble();
  EXPECT_TRUE(eventually([&] { return search.session_client.trouble().empty(); }));
}

TEST(SessionClient, SaysWhyTheSlaveRefusesAndGoesOnAsking) {
  FakeBackend backend("slave");
  backend.refuse(Refusal{Refusal::Kind::kPrecondition, "another master is connected"});
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address());
  ASSERT_TRUE(eventually([&] { return backend.calls().size() >= 3; }));
  EXPECT_NE(search.session_client.trouble().find("another master is connected"), std::string::npos)
      << search.session_client.trouble();
  EXPECT_TRUE(search.loop.adopted().empty());
  backend.refuse(std::nullopt);
  EXPECT_TRUE(eventually([&] { return !search.loop.adopted().empty(); }));
}

TEST(SessionClient, SaysWhoHasTakenTheRobotAndDoesNotTakeItBack) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address(), true);
  ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 1; }));
  EXPECT_EQ(search.session_client.taken_by(), "");
  backend.put_session(78);
  backend.refuse(
      Refusal{Refusal::Kind::kPrecondition, "another master has control of the robot", "192.0.2.9:4711"});
  search.loop.fall_silent();
  ASSERT_TRUE(eventually([&] { return search.session_client.taken_by() == "192.0.2.9:4711"; }));
  // The words follow a moment later.
  EXPECT_TRUE(eventually([&] {
    return search.session_client.trouble().find(
               "another master (192.0.2.9:4711) took control of the robot") != std::string::npos;
  }));
  ASSERT_TRUE(eventually([&] { return backend.calls().size() >= 4; }));
  const auto calls = backend.calls();
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "open_session take"), 1) << "at the start alone";
  backend.refuse(std::nullopt);
  EXPECT_TRUE(eventually(
      [&] { return search.loop.adopted().size() == 2 && search.session_client.taken_by().empty(); }));
}

TEST(SessionClient, SaysThatDatagramsDoNotComeBackThoughRpcAnswers) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address());
  ASSERT_TRUE(eventually([&] { return !search.loop.adopted().empty(); }));
  EXPECT_EQ(search.session_client.trouble(), "");
  search.loop.receive_nothing();
  ASSERT_TRUE(eventually([&] {
    const std::string said = search.session_client.trouble();
    return said.starts_with("RPC at " + server.address() +
                            " responds, but no datagrams arrive from 192.0.2.7:47001") &&
           said.find("firewall") != std::string::npos && said.find("link.slave") != std::string::npos;
  })) << search.session_client.trouble();
  search.loop.receive_from_elsewhere();
  ASSERT_TRUE(eventually([&] {
    return search.session_client.trouble().find("127 datagrams arrived from other addresses") !=
           std::string::npos;
  })) << search.session_client.trouble();
  search.loop.speak_again();
  ASSERT_TRUE(eventually([&] { return search.session_client.trouble().empty(); }));
}

TEST(SessionClient, ForgetsItsTroubleWhenTheSlaveIsHeardAgain) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  Search search(server.address());
  ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 1; }));
  backend.refuse(Refusal{Refusal::Kind::kUnavailable, "not now"});
  search.loop.fall_silent();
  ASSERT_TRUE(eventually([&] { return !search.session_client.trouble().empty(); }));
  search.loop.speak_again();
  EXPECT_TRUE(eventually([&] { return search.session_client.trouble().empty(); }));
}

TEST(SessionClient, TakesTheRobotOnceAndReturnsItAtTheEnd) {
  FakeBackend backend("slave");
  RpcServer server("127.0.0.1:0", backend, "slave");
  {
    Search search(server.address(), true);
    ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 1; }));
    backend.put_session(78);
    search.loop.fall_silent();
    ASSERT_TRUE(eventually([&] { return search.loop.adopted().size() == 2; }));
  }
  EXPECT_EQ(backend.calls(),
            (std::vector<std::string>{"open_session take", "open_session", "close_session 78"}));
}

TEST(SessionClient, EndsThoughItsCallIsNotAnswered) {
  // Takes connections and never says a word.
  asio::io_context context;
  asio::ip::tcp::acceptor silent(context, {asio::ip::address_v4::loopback(), 0});
  const auto began = std::chrono::steady_clock::now();
  {
    const Search search("127.0.0.1:" + std::to_string(silent.local_endpoint().port()));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(60));  // the call itself: 120 s
}

TEST(SessionClient, FindsTheSlavesRpcServerBesideItsDatagrams) {
  EXPECT_EQ(slave_rpc_address("127.0.0.1:47001", ""), "127.0.0.1:47020");
  EXPECT_EQ(slave_rpc_address("[::1]:9", ""), "[::1]:47020");
  EXPECT_EQ(slave_rpc_address("robot:47001", "elsewhere:1"), "elsewhere:1");
}

}  // namespace
}  // namespace longreach::session_client_test
