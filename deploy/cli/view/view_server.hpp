#pragma once
// Serves the page and, over WebSockets, its data, in its own thread. For a slow viewer the oldest frames are
// dropped; a viewer that sends too much is disconnected. Only one viewer at a time has control, that is, may
// move the hand and change settings; every viewer may stop the robot. When all connections are in use, a new
// connection replaces the oldest one that has not presented the token.

#include <functional>
#include <memory>
#include <string>

#include "deploy/cli/view/page_command.hpp"

namespace longreach {

inline constexpr int kViewersMax = 16;
inline constexpr int kConnectionsMax = 64;

/// Callbacks for the requests of viewers. They are called in the server's thread and must not block.
struct PageBackend {
  std::function<void(const PageCommand&)> act;     // engage, stop, mode, scale, link
  std::function<void(const proto::HandAim&)> aim;  // from the viewer in control
  std::function<void(bool lost)> let_go;           // control has ended; lost: the viewer did not release it
};

class ViewServer {
 public:
  /// Listens at `listen` (ADDRESS:PORT); port 0 selects any free port. Throws a std::runtime_error with a
  /// one-sentence message if that fails.
  explicit ViewServer(const std::string& listen);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Starts serving. Call this once.
  void serve(PageBackend backend);
  /// Stops serving. The backend is not called afterwards.
  void stop();

  /// URL of the page, including the token.
  [[nodiscard]] const std::string& address() const;

  // These functions may be called from any thread. All strings are JSON.
  /// Sends a frame to all viewers. A frame that has not been sent when the next one arrives is skipped.
  void show(std::string frame);
  /// Publishes persistent data: every viewer receives the newest text of each topic, even if it connects
  /// later.
  void tell(const std::string& topic, std::string text);
  /// Sends a message to the viewers that are connected now.
  void say(std::string text);
  /// Withdraws control from the viewer that has it.
  void revoke(const std::string& why);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
