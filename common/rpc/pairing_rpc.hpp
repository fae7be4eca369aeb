#pragma once
// Transport of pairing: a separate server that is open while the token is valid, and the call of the joining
// host. Not encrypted; common/site/pairing explains why that is sufficient.

#include <functional>
#include <memory>
#include <string>

#include "common/site/pairing.hpp"

namespace longreach {

inline constexpr std::string_view kPairingAddress = "0.0.0.0:47021";

class PairingServer {
 public:
  /// Called for each attempt with the address and the reason for refusal; empty: the host is paired. Called
  /// in the server's threads, one call at a time.
  using Tried = std::function<void(const std::string& from, const std::string& refusal)>;

  /// `listen`: address:port; port 0: any free one. Throws std::runtime_error, one sentence.
  PairingServer(const std::string& listen, PairingOffer& offer, Tried tried);
  /// Completes an answer in progress.
  ~PairingServer();
  PairingServer(const PairingServer&) = delete;
  PairingServer& operator=(const PairingServer&) = delete;

  [[nodiscard]] const std::string& address() const { return address_; }
  /// State of the offer while it is served.
  [[nodiscard]] PairingOffer::State state() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string address_;
};

/// Sends `request` to the pairing server at `address`. Throws PairingError: refused, no answer within
/// `timeout_s`, or the program there is not a pairing slave.
proto::PairingMessage ask_to_join(const std::string& address, const PairingRequest& request,
                                  double timeout_s);

}  // namespace longreach
