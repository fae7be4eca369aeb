#include "deploy/cli/doctor/doctor_probe.hpp"

#include <netinet/in.h>

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <chrono>
#include <thread>

#include "common/net/address.hpp"
#include "common/net/tcp_probe.hpp"

namespace longreach {

bool takes_connections(const std::string& address) {
  return TcpProbe(address).run_for(std::chrono::seconds(15)) == TcpProbe::State::kAccepted;
}

bool udp_port_taken(const std::string& address) {
  asio::io_context context;
  const auto endpoint = parse_udp_address(address);
  asio::ip::udp::socket socket(context);
  asio::error_code error;
  socket.open(endpoint.protocol(), error);
  if (!error) socket.bind(endpoint, error);
  return error == asio::error::address_in_use;
}

Probe send_probe(const std::string& address) {
  constexpr int kCount = 5;
  constexpr std::size_t kBytes = 508;
  Probe out;
  asio::io_context context;
  const auto endpoint = parse_udp_address(address);
  asio::ip::udp::socket socket(context);
  asio::error_code error;
  socket.connect(endpoint, error);
  const bool v6 = endpoint.address().is_v6();
  const int whole = v6 ? IPV6_PMTUDISC_DO : IP_PMTUDISC_DO;
  (void)::setsockopt(socket.native_handle(), v6 ? IPPROTO_IPV6 : IPPROTO_IP,
                     v6 ? IPV6_MTU_DISCOVER : IP_MTU_DISCOVER, &whole, sizeof whole);
  const std::array<unsigned char, kBytes> datagram{};  // version 0
  for (int i = 0; i < kCount; ++i) {
    asio::error_code refused;
    socket.send(asio::buffer(datagram), 0, refused);
    if (refused) out.error = refused.message();
    ++out.sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  socklen_t size = sizeof out.mtu;
  if (::getsockopt(socket.native_handle(), v6 ? IPPROTO_IPV6 : IPPROTO_IP, v6 ? IPV6_MTU : IP_MTU, &out.mtu,
                   &size) != 0)
    out.mtu = 0;
  return out;
}

}  // namespace longreach
