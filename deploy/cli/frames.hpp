#pragma once
// The frames that the master sends for displays.

#include <atomic>
#include <functional>
#include <string>

#include "common/spatial/spatial.hpp"
#include "deploy/cli/side_client.hpp"

namespace longreach {

/// Calls `frame` with each frame, `rate_hz` times per second, until it returns false or the stream ends. Returns the reason
/// why the stream ended, as one sentence; empty if `frame` ended it. `opened` is called with the context of the call, to
/// cancel it from another thread, before the first frame, and with null after the last; it returns false to give up. `ended`
/// ends the wait for a connection.
std::string follow_frames(const Options& options, double rate_hz, const std::atomic<bool>& ended,
                          const std::function<bool(grpc::ClientContext*)>& opened,
                          const std::function<bool(const proto::Frame&)>& frame);

/// Position of the tool in W as last received, m.
inline Vector3 tool_m(const proto::Frame& frame) {
  const recording::Vector& p = frame.view().far().tool().position_m();
  return {p.x(), p.y(), p.z()};
}

}  // namespace longreach
