#include "common/net/tcp_probe.hpp"

#include "common/net/address.hpp"

namespace longreach {

TcpProbe::TcpProbe(const std::string& address) try {
  const auto there = parse_udp_address(address);
  socket_.async_connect({there.address(), there.port()}, [this](const asio::error_code& error) {
    failed_ = bool(error);
    if (failed_) return;
    handshake_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    asio::error_code ignored;
    socket_.close(ignored);
  });
} catch (const AddressError&) {
  failed_ = true;
}

TcpProbe::State TcpProbe::run_for(std::chrono::milliseconds time) {
  if (!failed_ && !handshake_s_) context_.run_for(time);
  if (handshake_s_) return State::kAccepted;
  return failed_ ? State::kFailed : State::kPending;
}

}  // namespace longreach
