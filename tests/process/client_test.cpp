// The client as a user meets it: what it prints, what it changes, and with which status it ends.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "tests/process/client_run.hpp"

namespace longreach::client_test {
namespace {

struct Ended {
  int status = -1;
  std::string out;
  std::string err;
};

Ended run(const std::vector<std::string>& arguments) {
  ClientRun client(arguments);
  client.read();
  return {client.status(), client.out(), client.err()};
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in:\n" << text;
}

void expect_one_sentence(const Ended& ended, int status, const std::string& about) {
  EXPECT_EQ(ended.status, status) << ended.out << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  expect_contains(ended.err, about);
}

TEST(Client, BadUsageEndsWithStatus2AndOneSentence) {
  const FakeStation station;
  const auto expect = [&](const std::vector<std::string>& command, const std::string& about) {
    expect_one_sentence(run(station.arguments(command)), 2, about);
  };
  expect({"dance"}, "dance");
  expect({"status", "--wings"}, "wings");
  expect({"link", "set", "--loss", "2"}, "loss = 2 is outside 0 to 1");
  expect({"link", "set", "--profile", "mars-by-horse"}, "mars-by-horse");
  expect({"scale", "3"}, "0.05 to 1");
  expect({"record", "start", "a/b"}, "'a/b' is not a valid recording name");
  expect({"record", "list", "/no/such/folder"}, "the folder /no/such/folder does not exist");
  expect({"record", "export", "/etc/passwd"}, "/etc/passwd is not a recording");
  expect({"set", "slave", "estimator.forgetting", "2"}, "estimator.forgetting");
  expect({"set", "slave", "estimator.nonsense", "1"}, "nonsense");
  expect({"get", "slave", "estimator.nonsense"}, "nonsense");
  EXPECT_TRUE(station.master.calls().empty());
  EXPECT_TRUE(station.slave.calls().empty());
}

TEST(Client, PrintsHelpWithoutACommandAndSaysThatThisIsBadUsage) {
  const Ended ended = run({});
  EXPECT_EQ(ended.status, 2);
  expect_contains(ended.out, "Usage: longreach");
}

TEST(Client, StatusShowsBothSides) {
  const FakeStation station;
  const Ended ended = run(station.arguments({"status"}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const std::string& part : {station.master_address, station.slave_address, std::string("Engaged"),
                                  std::string("1.3 s"), std::string("rejected_replay")})
    expect_contains(ended.out, part);
  EXPECT_EQ(ended.err, "");
  const Ended json = run(station.arguments({"--json", "status"}));
  EXPECT_EQ(json.status, 0);
  expect_contains(json.out, "{\"master\":{\"side\":\"master\"");
  expect_contains(json.out, "\"slave\":{\"side\":\"slave\"");
}

TEST(Client, ASideThatIsDownIsNamedWithItsAddressAndWhatToStart) {
  FakeStation station;
  station.slave_server->stop();
  const Ended status = run(station.arguments({"status"}));
  expect_one_sentence(status, 1, "the slave does not respond at " + station.slave_address);
  expect_contains(status.err, "longreach-slave");
  expect_contains(status.out, "Engaged");  // the master is shown all the same
  expect_one_sentence(run(station.arguments({"get", "slave"})), 1, station.slave_address);
  const Ended json = run(station.arguments({"get", "slave", "--json"}));
  EXPECT_EQ(json.status, 1);
  EXPECT_TRUE(json.out.starts_with("{\"error\":\"the slave does not respond at")) << json.out;
}

TEST(Client, ShowsAConfigurationOfManyMegabytes) {
  FakeStation station;
  constexpr std::size_t kBytes = 6 << 20;  // gRPC reads 4 MiB unless it is told otherwise
  station.slave.put_mesh(kBytes);
  const Ended ended = run(station.arguments({"get", "slave"}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_GT(ended.out.size(), kBytes);
}

/// A port that accepts connections and never says a word.
class SilentPort {
 public:
  SilentPort() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket_, reinterpret_cast<sockaddr*>(&address), size);
    ::listen(socket_, 8);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    address_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  }
  ~SilentPort() { ::close(socket_); }
  SilentPort(const SilentPort&) = delete;
  SilentPort& operator=(const SilentPort&) = delete;
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  int socket_;
  std::string address_;
};

TEST(Client, DoesNotWaitLongerThanItsTimeout) {
  const FakeStation station;
  const SilentPort silent;
  const auto with = [&](std::vector<std::string> command, const std::string& timeout = "300ms") {
    const std::vector<std::string> front{"--master",  silent.address(), "--slave", station.slave_address,
                                         "--timeout", timeout};
    command.insert(command.begin(), front.begin(), front.end());
    return run(command);
  };
  expect_one_sentence(with({"status"}), 1, "does not respond at " + silent.address() + " within 0.3 s");
  expect_one_sentence(with({"link", "set", "--delay", "1s"}), 1, silent.address());
  EXPECT_TRUE(station.slave.calls().empty());
  const Ended watch = with({"watch", "--hz", "20", "--count", "2"});
  EXPECT_EQ(watch.status, 1);
  expect_contains(watch.out, "master does not respond");
  // Here the slave must answer in time, on a busy machine too.
  EXPECT_EQ(with({"stop"}, "3s").status, 0);
  EXPECT_EQ(station.slave.calls(), std::vector<std::string>{"stop"});
}

TEST(Client, NoticesWhenTheAddressesAreSwapped) {
  const FakeStation station;
  const Ended ended = run(
      {"--master", station.slave_address, "--slave", station.master_address, "link", "set", "--delay", "1s"});
  expect_one_sentence(ended, 1, "is the master, not the slave");
  EXPECT_TRUE(station.slave.calls().empty());
}

TEST(Client, SetsAndGetsFields) {
  const FakeStation station;
  EXPECT_EQ(run(station.arguments({"get", "slave", "estimator.forgetting"})).out, "0.99\n");
  const Ended set =
      run(station.arguments({"set", "slave", "estimator.forgetting", "0.995", "estimator.exponent", "1.5"}));
  EXPECT_EQ(set.status, 0) << set.err;
  EXPECT_EQ(run(station.arguments({"get", "slave", "estimator.forgetting"})).out, "0.995\n");
  EXPECT_EQ(run(station.arguments({"get", "slave", "estimator.exponent"})).out, "1.5\n");
}

TEST(Client, TheDelayOfBothDirectionsIsEachItsOwn) {
  const FakeStation station;
  EXPECT_EQ(run(station.arguments({"link", "set", "--delay", "650ms"})).status, 0);
  EXPECT_EQ(station.slave.present_link().delay_s(), 0.65);
  EXPECT_EQ(station.master.present_link().delay_s(), 0.65);
  EXPECT_EQ(run(station.arguments({"link", "set", "--loss", "2%", "--direction", "up"})).status, 0);
  EXPECT_EQ(station.slave.present_link().delay_s(), 0.65);
  EXPECT_EQ(station.slave.present_link().loss(), 0.02);
  EXPECT_EQ(station.master.present_link().loss(), 0.0);
  const Ended show = run(station.arguments({"link", "show"}));
  expect_contains(show.out, "delay 650 ms, loss 2 %");
  EXPECT_EQ(run(station.arguments({"link", "clear"})).status, 0);
  EXPECT_EQ(station.slave.present_link().delay_s(), 0.0);
  EXPECT_EQ(station.master.present_link().delay_s(), 0.0);
}

TEST(Client, AProfileReplacesTheWholeDirectionAndOptionsGoOverIt) {
  FakeStation station;
  proto::Impairment before;
  before.set_duplicate(0.5);
  station.slave.put_link(before);
  const Ended ended = run(station.arguments({"link", "set", "--profile", "moon", "--loss", "3%"}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(station.slave.present_link().duplicate(), 0.0);
  EXPECT_EQ(station.slave.present_link().delay_s(), 1.3);  // deploy/links/moon.txtpb
  EXPECT_EQ(station.slave.present_link().loss(), 0.03);
  EXPECT_EQ(station.master.present_link().delay_s(), 1.3);
}

TEST(Client, ALinkChangesNowhereWhenOneSideIsDown) {
  FakeStation station;
  station.master_server->stop();
  expect_one_sentence(run(station.arguments({"link", "set", "--delay", "1s"})), 1, station.master_address);
  EXPECT_TRUE(station.slave.calls().empty());
}

TEST(Client, ALinkIsPutBackWhenTheOtherSideRefuses) {
  FakeStation station;
  proto::Impairment before;
  before.set_delay_s(0.25);
  before.set_duplicate(0.5);
  station.slave.put_link(before);
  station.master.refuse(Refusal{Refusal::Kind::kPrecondition, "not now"});
  const Ended ended = run(station.arguments({"link", "set", "--profile", "moon"}));
  expect_one_sentence(ended, 1, "not now");
  expect_contains(ended.err, "restored");
  EXPECT_EQ(station.slave.present_link().SerializeAsString(), before.SerializeAsString());
  EXPECT_EQ(station.slave.calls().size(), 2U) << "there and back";
}

TEST(Client, ScaleStepsStayInTheRange) {
  const FakeStation station;  // at 0.5
  expect_contains(run(station.arguments({"scale", "up"})).out, "0.55");
  expect_contains(run(station.arguments({"scale", "down"})).out, "0.5\n");
  EXPECT_EQ(run(station.arguments({"scale", "1"})).status, 0);
  expect_contains(run(station.arguments({"scale", "up"})).out, "scale set to 1\n");
}

TEST(Client, ModeAndEngageAreAskedOfTheMaster) {
  const FakeStation station;
  EXPECT_EQ(run(station.arguments({"mode", "rate"})).status, 0);
  EXPECT_EQ(run(station.arguments({"engage"})).status, 0);
  EXPECT_EQ(station.master.calls(), (std::vector<std::string>{"mode RATE", "engage"}));
  EXPECT_TRUE(station.slave.calls().empty());
}

TEST(Client, APreconditionIsStatus1AndABadValueStatus2) {
  FakeStation station;
  station.master.refuse(
      Refusal{Refusal::Kind::kPrecondition, "no datagrams arrive from the slave: wait for it"});
  expect_one_sentence(run(station.arguments({"engage"})), 1, "no datagrams arrive from the slave");
  station.master.refuse(Refusal{Refusal::Kind::kUnavailable, "the loop did not answer"});
  const Ended unavailable = run(station.arguments({"engage"}));
  expect_one_sentence(unavailable, 1, "the loop did not answer");
  EXPECT_EQ(unavailable.err.find("longreach-master"), std::string::npos) << "it runs: " << unavailable.err;
  station.master.refuse(Refusal{Refusal::Kind::kInvalid, "no such thing"});
  expect_one_sentence(run(station.arguments({"engage"})), 2, "no such thing");
}

TEST(Client, StopAsksBothSidesAndIsDoneWithOne) {
  FakeStation station;
  EXPECT_EQ(run(station.arguments({"stop"})).status, 0);
  EXPECT_EQ(station.master.calls(), std::vector<std::string>{"stop"});
  EXPECT_EQ(station.slave.calls(), std::vector<std::string>{"stop"});
  station.master_server->stop();
  const Ended half = run(station.arguments({"stop"}));
  EXPECT_EQ(half.status, 0) << half.err;
  expect_contains(half.out, "stopped at the slave");
  expect_contains(half.out, station.master_address);
  station.slave_server->stop();
  expect_one_sentence(run(station.arguments({"stop"})), 1, "neither side was stopped");
}

TEST(Client, WatchWritesALineAnUpdateAndEndsAfterItsCount) {
  const FakeStation station;
  const Ended ended = run(station.arguments({"watch", "--hz", "20", "--count", "3"}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 3) << ended.out;
  EXPECT_EQ(ended.out.find('\x1b'), std::string::npos) << "no control codes into a pipe";
  expect_contains(ended.out, "master Engaged");
  const Ended json = run(station.arguments({"watch", "--hz", "20", "--count", "2", "--json"}));
  EXPECT_EQ(std::count(json.out.begin(), json.out.end(), '\n'), 2) << json.out;
}

TEST(Client, WatchEndsWithStatus0OnCtrlC) {
  const FakeStation station;
  ClientRun client(station.arguments({"watch"}));
  client.read("master Engaged");
  client.signal(SIGINT);
  client.read();
  EXPECT_EQ(client.status(), 0) << client.out() << client.err();
}

TEST(Client, WatchSeesASideComeBack) {
  FakeStation station;
  station.slave_server->stop();
  ClientRun client(station.arguments({"watch", "--hz", "20"}));
  client.read("slave does not respond");
  station.slave_server =
      std::make_unique<RpcServer>(station.slave_address, station.slave, "slave", test_site(RpcRole::kSlave));
  client.read("slave Engaged");
  expect_contains(client.out(), "slave Engaged");
  client.signal(SIGINT);
  client.read();
  EXPECT_EQ(client.status(), 0);
}

TEST(Client, WatchRedrawsInPlaceOnATerminalAndBringsTheCursorBack) {
  const FakeStation station;
  ClientRun client(station.arguments({"watch", "--hz", "20", "--count", "3"}), true);
  client.read();
  EXPECT_EQ(client.status(), 0) << client.out() << client.err();
  const std::string& out = client.out();
  EXPECT_EQ(out.find("\x1b[2J"), std::string::npos) << "clearing the screen flickers";
  EXPECT_LT(out.find("\x1b[?25l"), out.find("\x1b[?25h"));
  EXPECT_TRUE(out.ends_with("\x1b[?25h")) << out;
}

TEST(Client, WatchOnATerminalSaysThatAFirstAnswerIsOnItsWay) {
  FakeStation station;
  proto::Impairment link;
  link.set_rpc_delay_s(2.5);
  station.slave.put_link(link);
  ClientRun client(station.arguments({"watch", "--hz", "20"}), true);
  client.read("waiting for the first answer of the slave: 4 of 10 s");
  EXPECT_NE(client.out().find("not yet"), std::string::npos) << client.out();
  client.signal(SIGTERM);
  client.read();
  EXPECT_EQ(client.out().find("slave does not respond"), std::string::npos) << client.out();
}

}  // namespace
}  // namespace longreach::client_test
