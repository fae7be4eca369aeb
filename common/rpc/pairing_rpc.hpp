#pragma once
// Transport of the pairing messages: a separate server, which is open while the token is valid, and the call
// that the joining host makes. The connection is not encrypted; common/site/pairing explains why this is
// secure.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/site/pairing.hpp"

namespace longreach {

inline constexpr std::string_view kPairingAddress = "0.0.0.0:47021";

class PairingServer {
 public:
  /// Called for each attempt with the address of the host and the reason for the refusal, which is empty if
  /// the host is paired. Called in the server's threads, one call at a time.
  using Tried = std::function<void(const std::string& from, const std::string& refusal)>;

  /// `listen` is address:port; port 0 stands for any free port. Throws std::runtime_error with a one-sentence
  /// message.
  PairingServer(const std::string& listen, PairingOffer& offer, Tried tried);
  /// Completes a response that is in progress.
  ~PairingServer();
  PairingServer(const PairingServer&) = delete;
  PairingServer& operator=(const PairingServer&) = delete;

  [[nodiscard]] const std::string& address() const { return address_; }
  /// Returns the current state of the offer.
  [[nodiscard]] PairingOffer::State state() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string address_;
};

/// Sends `request` to the pairing server at `address` and returns its response. Throws PairingError if the
/// request is refused, if there is no response within `timeout_s` (none: the timeout follows the link), or if
/// the program there is not a slave in pairing mode.
proto::PairingMessage ask_to_join(const std::string& address, const PairingRequest& request,
                                  std::optional<double> timeout_s);

}  // namespace longreach
