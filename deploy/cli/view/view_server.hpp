#pragma once
// Serves the page and, by WebSocket, its data, in one thread of its own. A slow viewer misses frames, oldest
// first; a viewer that sends too much is disconnected. One viewer at a time has the hand and may move and
// change things; every viewer may stop. When all connections are in use, a new one replaces the oldest that
// has not shown the token.

#include <functional>
#include <memory>
#include <string>

#include "deploy/cli/view/page_command.hpp"

namespace longreach {

inline constexpr int kViewersMax = 16;
inline constexpr int kConnectionsMax = 64;

/// Requests of viewers; called in the thread of the server, must not block.
struct PageBackend {
  std::function<void(const PageCommand&)> act;     // engage, stop, mode, scale, link
  std::function<void(const proto::HandAim&)> aim;  // of the viewer that has the hand
  std::function<void(bool lost)> let_go;           // it no longer has the hand; lost: without a release
};

class ViewServer {
 public:
  /// `listen`: address:port; port 0: any free one. Throws std::runtime_error, one sentence, if it cannot
  /// listen.
  explicit ViewServer(const std::string& listen);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Starts serving; call it once.
  void serve(PageBackend backend);
  /// No function of the backend is called after it.
  void stop();

  /// Address for a browser, including the token.
  [[nodiscard]] const std::string& address() const;

  // Callable from any thread. All texts are JSON.
  /// Sends a frame; a frame that was not sent when the next one arrives is skipped.
  void show(std::string frame);
  /// Sends persistent data: every viewer receives the newest text of each topic, also later ones.
  void tell(const std::string& topic, std::string text);
  /// Sends a message to the present viewers.
  void say(std::string text);
  /// Takes the hand away from its viewer.
  void revoke(const std::string& why);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
