#pragma once
// Serves the page and, by WebSocket, what it shows. One thread of its own. A viewer that reads too slowly
// misses frames, oldest first; one that says too much is cut off. One viewer at a time has the hand: it alone
// may move and change things; anybody may stop. When all connections are taken, a new one takes the place of
// the oldest that has not shown the token.

#include <functional>
#include <memory>
#include <string>

#include "deploy/cli/view/page_command.hpp"

namespace longreach {

inline constexpr int kViewersMax = 16;
inline constexpr int kConnectionsMax = 64;

/// What viewers ask of the rest; called in the server's thread, must not wait.
struct PageBackend {
  std::function<void(const PageCommand&)> act;     // engage, stop, mode, scale, link
  std::function<void(const proto::HandAim&)> aim;  // of the viewer that has the hand
  std::function<void(bool lost)> let_go;           // it has not any more; lost: without having said so
};

class ViewServer {
 public:
  /// `listen`: address:port; port 0: any free one. Throws std::runtime_error, one sentence, when it
  /// cannot listen.
  explicit ViewServer(const std::string& listen);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Begins to answer; once.
  void serve(PageBackend backend);
  /// Nothing is asked of anybody after it.
  void stop();

  /// For a browser, token included.
  [[nodiscard]] const std::string& address() const;

  // From any thread. All texts are JSON.
  /// A frame that nobody has fetched when the next one comes is left out.
  void show(std::string frame);
  /// Something that lasts: the newest of each topic reaches every viewer, later ones too.
  void tell(const std::string& topic, std::string text);
  /// Something of the moment, to those who are there.
  void say(std::string text);
  /// Takes the hand from whoever has it.
  void revoke(const std::string& why);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
