#pragma once
// Serves a MuJoCo world as a robot by the adapter protocol (common/link/adapter_datagram.hpp) in real time.

#include <cstdint>
#include <functional>
#include <string>

#include "deploy/mujoco/world.hpp"

namespace longreach {

struct ServerOptions {
  std::string path;         // of the socket, absolute
  double rate_hz = 1000.0;  // datagrams per second
  double latency_s = 0.0;   // age of what is sent, up to 0.1 s
};

enum class ServerRequest { kNothing, kReset, kEnd };

/// Serves until `asked`, which is called once a period, returns kEnd. At kReset the world returns to its start; the robot is not
/// ok for half a second then and follows no setpoint, so that the slave notices and ends the engagement. Throws std::runtime_error if the
/// socket cannot be used, if the simulation diverges, or if it is slower than real time.
void serve(MujocoWorld& world, const ServerOptions& options, const std::function<ServerRequest()>& asked);

}  // namespace longreach
