#include "tests/process/delayed_tcp.hpp"

#include <asio/read.hpp>
#include <asio/steady_timer.hpp>
#include <asio/write.hpp>
#include <functional>
#include <map>

#include "common/net/address.hpp"

namespace longreach {

using asio::ip::tcp;

/// One connection through the proxy.
struct DelayedTcp::Link {
  explicit Link(asio::io_context& context, tcp::socket client_socket, int connection_number)
      : client(std::move(client_socket)), server(context), number(connection_number) {}
  tcp::socket client, server;
  const int number;
  std::array<std::array<char, 65536>, 2> buffers{};
};

DelayedTcp::DelayedTcp(const std::string& server, const Options& options)
    : options_(options), acceptor_(context_, {asio::ip::address_v4::loopback(), 0}) {
  const auto there = parse_udp_address(server);
  server_ = {there.address(), there.port()};
  accept();
  thread_ = std::thread([this] { context_.run(); });
}

DelayedTcp::~DelayedTcp() {
  context_.stop();
  thread_.join();
}

std::string DelayedTcp::address() const {
  return "127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port());
}

void DelayedTcp::after_delay(const std::function<void()>& act) {
  const auto delay = std::chrono::duration_cast<std::chrono::steady_clock::duration>(options_.delay);
  const auto timer = std::make_shared<asio::steady_timer>(context_, delay);
  timer->async_wait([timer, act](const asio::error_code&) { act(); });
}

void DelayedTcp::accept() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket client) {
    if (error) return;
    client.set_option(tcp::no_delay(true));
    const auto link = std::make_shared<Link>(context_, std::move(client), accepted_++);
    after_delay([this, link] {
      asio::error_code refused;
      link->server.connect(server_, refused);
      if (refused) return link->client.close();
      link->server.set_option(tcp::no_delay(true));
      pump(link, false);
    });
    pump(link, true);
    accept();
  });
}

void DelayedTcp::pump(const std::shared_ptr<Link>& link, bool to_server) {
  auto& from = to_server ? link->client : link->server;
  auto& buffer = link->buffers[to_server ? 0 : 1];
  from.async_read_some(asio::buffer(buffer),
                       [=, this, &buffer](const asio::error_code& error, std::size_t n) {
                         const std::string bytes(buffer.data(), n);
                         if (!error) {
                           const std::lock_guard lock(mutex_);
                           entries_.push_back({link->number, to_server, n});
                         }
                         if (!to_server && link->number < options_.broken) {
                           asio::error_code ignored;
                           if (options_.reset)
                             link->client.set_option(asio::socket_base::linger(true, 0), ignored);
                           link->client.close(ignored);
                           link->server.close(ignored);
                           return;
                         }
                         after_delay([=, this] { pass(link, to_server, bytes); });
                         if (!error) pump(link, to_server);
                       });
}

/// Empty bytes mean that the connection has ended.
void DelayedTcp::pass(const std::shared_ptr<Link>& link, bool to_server, const std::string& bytes) {
  auto& to = to_server ? link->server : link->client;
  asio::error_code gone;
  if (bytes.empty()) {
    to.shutdown(tcp::socket::shutdown_send, gone);
    return;
  }
  asio::write(to, asio::buffer(bytes), gone);
  const std::lock_guard lock(mutex_);
  if (!to_server) delivered_ += bytes.size();
}

// A server may acknowledge a PING or SETTINGS frame of HTTP/2 after its response; no call waits for that.
std::vector<int> DelayedTcp::round_trips() const {
  constexpr std::size_t kAcknowledgement = 60;  // bytes, with those of TLS; a response has more
  const std::lock_guard lock(mutex_);
  std::map<int, std::pair<int, bool>> found;  // round trips, and whether the last bytes were the client's
  for (const Entry& entry : entries_) {
    auto& [trips, asked] = found.try_emplace(entry.connection, 1, false).first->second;
    if (!entry.to_server && entry.bytes <= kAcknowledgement) continue;
    if (!entry.to_server && asked) ++trips;
    asked = entry.to_server;
  }
  std::vector<int> out;
  for (const auto& [connection, state] : found) out.push_back(state.first);
  return out;
}

std::size_t DelayedTcp::delivered() const {
  const std::lock_guard lock(mutex_);
  return delivered_;
}

std::string DelayedTcp::log() const {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (const Entry& entry : entries_)
    text += "connection " + std::to_string(entry.connection) + (entry.to_server ? " client: " : " server: ") +
            std::to_string(entry.bytes) + " bytes\n";
  return text;
}

}  // namespace longreach
