// Who is turned away is counted, and logged without filling the disk.
#include "common/rpc/rpc_refusals.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <sstream>

namespace longreach::rpc_refusals_test {
namespace {

TEST(RpcRefusals, AFloodIsCountedAndOneLineASecondIsLogged) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("slave", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  const std::uint64_t count = rpc_refusals();
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < 10'000; ++i) note_rpc_refusal("192.0.2.9:4711", "no certificate");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  spdlog::set_default_logger(before);
  EXPECT_EQ(rpc_refusals(), count + 10'000);
  const std::string said = text.str();
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 2 + static_cast<long>(took.count()));
  // None when another test's line is less than a second old.
  if (!said.empty()) {
    EXPECT_NE(said.find("rpc refused=192.0.2.9:4711 because=\"no certificate\""), std::string::npos) << said;
  }
}

TEST(RpcRefusals, NameAddressesAsAUserWritesThem) {
  EXPECT_EQ(readable_peer("ipv4:127.0.0.1:53211"), "127.0.0.1:53211");
  EXPECT_EQ(readable_peer("ipv6:%5B::1%5D:53211"), "[::1]:53211");
  EXPECT_EQ(readable_peer("ipv6:%5Bfe80::1%252%5D:53211"), "[fe80::1%2]:53211");
}

}  // namespace
}  // namespace longreach::rpc_refusals_test
