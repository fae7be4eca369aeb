#pragma once
// A tap between master and slave on loopback. It forwards and records every datagram, and can inject
// datagrams to either side from the address of the other. It can hold the datagrams to the slave back and pass
// them in bursts, as Wi-Fi does with power saving, and pass those to the master from another address than that to which
// the master sends.

#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/loop/real_time_loop.hpp"

namespace longreach {

enum class Toward { kSlave, kMaster };

class DatagramTap {
 public:
  using Datagram = std::vector<unsigned char>;

  explicit DatagramTap(int slave_port, std::chrono::milliseconds burst_period = {})
      : burst_period_(burst_period),
        slave_(asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(slave_port)) {
    thread_ = std::thread([this] { run(); });
  }
  ~DatagramTap() {
    ended_ = true;
    thread_.join();
  }
  DatagramTap(const DatagramTap&) = delete;
  DatagramTap& operator=(const DatagramTap&) = delete;

  /// Address to which the master must send.
  [[nodiscard]] std::string address() const {
    return "127.0.0.1:" + std::to_string(near_.local_endpoint().port());
  }

  /// Returns the recorded datagrams, without the injected ones.
  [[nodiscard]] std::vector<Datagram> recorded(Toward way) const {
    const std::lock_guard lock(mutex_);
    return way == Toward::kSlave ? up_ : down_;
  }

  /// Passes the datagrams to the master from another address from now on.
  void answer_from_elsewhere() { elsewhere_ = true; }

  void play(Toward way, const Datagram& datagram) {
    const std::lock_guard lock(mutex_);
    pass(way, datagram);
  }

 private:
  void pass(Toward way, const Datagram& datagram) {
    asio::error_code ignored;
    if (way == Toward::kSlave) {
      far_.send_to(asio::buffer(datagram), slave_, 0, ignored);
    } else {
      (elsewhere_ ? far_ : near_).send_to(asio::buffer(datagram), master_, 0, ignored);
    }
  }

  void take(asio::ip::udp::socket& from, Toward way) {
    Datagram datagram(2048);
    asio::ip::udp::endpoint sender;
    asio::error_code error;
    const std::lock_guard lock(mutex_);
    datagram.resize(from.receive_from(asio::buffer(datagram), sender, 0, error));
    if (error) return;
    if (way == Toward::kSlave) master_ = sender;
    (way == Toward::kSlave ? up_ : down_).push_back(datagram);
    if (way == Toward::kMaster || burst_period_.count() == 0) pass(way, datagram);
  }

  void run() {
    (void)ask_for_real_time(
        LoopConfig{});  // as the loops beside it: datagrams that are late here cause holds
    near_.non_blocking(true);
    far_.non_blocking(true);
    while (!ended_) {
      bool idle = true;
      for (auto [socket, way] : {std::pair(&near_, Toward::kSlave), std::pair(&far_, Toward::kMaster)}) {
        if (socket->available() == 0) continue;
        take(*socket, way);
        idle = false;
      }
      pass_burst();
      if (idle) std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  void pass_burst() {
    const auto now = std::chrono::steady_clock::now();
    if (burst_period_.count() == 0 || now < next_burst_) return;
    next_burst_ = now + burst_period_;
    const std::lock_guard lock(mutex_);
    for (; passed_ < up_.size(); ++passed_) pass(Toward::kSlave, up_[passed_]);
  }

  const std::chrono::milliseconds burst_period_;
  std::chrono::steady_clock::time_point next_burst_{};
  std::size_t passed_ = 0;  // datagrams to the slave that have been passed in bursts
  asio::io_context context_;
  /// Sends to the master and receives from it.
  asio::ip::udp::socket near_{context_, {asio::ip::address_v4::loopback(), 0}};
  asio::ip::udp::socket far_{context_, {asio::ip::address_v4::loopback(), 0}};  // same for the slave
  const asio::ip::udp::endpoint slave_;
  asio::ip::udp::endpoint master_;
  mutable std::mutex mutex_;
  std::vector<Datagram> up_, down_;
  std::atomic<bool> ended_ = false, elsewhere_ = false;
  std::thread thread_;
};

}  // namespace longreach
