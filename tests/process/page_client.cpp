#include "tests/process/page_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>

namespace longreach {
namespace {

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval read_timeout{10, 0}, write_timeout{1, 0};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &read_timeout, sizeof(read_timeout));
  ::setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &write_timeout, sizeof(write_timeout));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  (void)::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  return fd;
}

bool send_all(int fd, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::send(fd, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

int port_of(const std::string& address) { return std::stoi(address.substr(address.find(':', 5) + 1)); }

std::string path_of(const std::string& address) { return address.substr(address.find('/', 7)); }

std::string http_status(int port, const std::string& request) {
  const int fd = connect_to(port);
  std::string answer;
  if (send_all(fd, request)) {
    std::array<char, 4096> bytes{};
    for (ssize_t n = 1; n > 0 && answer.find("\r\n") == std::string::npos;) {
      n = ::recv(fd, bytes.data(), bytes.size(), 0);
      if (n > 0) answer.append(bytes.data(), static_cast<std::size_t>(n));
    }
  }
  ::close(fd);
  return answer.substr(0, answer.find("\r\n"));
}

OpenConnection::OpenConnection(int port) : socket_(connect_to(port)) {}

OpenConnection::~OpenConnection() { ::close(socket_); }

bool OpenConnection::send(const std::string& bytes) const { return send_all(socket_, bytes); }

bool OpenConnection::ended() const {
  char byte = 0;
  const ssize_t n = ::recv(socket_, &byte, 1, MSG_DONTWAIT);
  return n == 0 || (n < 0 && errno != EAGAIN);
}

PageClient::PageClient(const std::string& address) : socket_(connect_to(port_of(address))) {
  const std::string host = "127.0.0.1:" + std::to_string(port_of(address));
  send_all(socket_, "GET " + path_of(address) + "live HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" +
                        host +
                        "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  std::size_t end = std::string::npos;
  while ((end = received_.find("\r\n\r\n")) == std::string::npos && receive(received_.size() + 1)) {
  }
  ok_ = received_.starts_with("HTTP/1.1 101");
  if (end != std::string::npos) received_.erase(0, end + 4);
}

PageClient::~PageClient() { ::close(socket_); }

bool PageClient::send(const std::string& text) const {
  // One whole text frame with a mask of zeros.
  std::string frame = "\x81";
  if (text.size() < 126) {
    frame += static_cast<char>(0x80 | text.size());
  } else {
    frame +=
        {static_cast<char>(0x80 | 126), static_cast<char>(text.size() >> 8), static_cast<char>(text.size())};
  }
  return send_all(socket_, frame + std::string(4, '\0') + text);
}

/// Until at least so many bytes are there.
bool PageClient::receive(std::size_t bytes) {
  std::array<char, 65536> some{};
  while (received_.size() < bytes) {
    const ssize_t n = ::recv(socket_, some.data(), some.size(), 0);
    if (n <= 0) return false;
    received_.append(some.data(), static_cast<std::size_t>(n));
  }
  return true;
}

std::optional<std::string> PageClient::read() {
  std::string message;  // in one or more fragments
  while (receive(2)) {
    const int kind = received_[0] & 0x0f;
    const bool last = (received_[0] & 0x80) != 0;
    std::size_t length = static_cast<unsigned char>(received_[1]) & 0x7fU;
    std::size_t head = 2;
    if (length >= 126) {
      head = length == 126 ? 4 : 10;
      if (!receive(head)) return std::nullopt;
      length = 0;
      for (std::size_t i = 2; i < head; ++i) length = length << 8U | static_cast<unsigned char>(received_[i]);
    }
    if (!receive(head + length)) return std::nullopt;
    if (kind == 0 || kind == 1) message += received_.substr(head, length);
    received_.erase(0, head + length);
    if ((kind == 0 || kind == 1) && last) return message;
    if (kind == 8) return std::nullopt;
  }
  return std::nullopt;
}

bool PageClient::read_until(const std::string& part) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < deadline) {
    const auto message = read();
    if (!message) return false;
    if (message->find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace longreach
