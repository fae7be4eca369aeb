#pragma once
// The transport of pairing: a server of its own, open for as long as a token is, and the call of the host
// that joins. In clear: common/site/pairing says why that is enough.

#include <functional>
#include <memory>
#include <string>

#include "common/site/pairing.hpp"

namespace longreach {

inline constexpr std::string_view kPairingAddress = "0.0.0.0:47021";

class PairingServer {
 public:
  /// Somebody tried: his address, and why he was refused; empty: he is paired. Called in the server's
  /// threads, one call at a time.
  using Tried = std::function<void(const std::string& from, const std::string& refusal)>;

  /// `listen`: address:port; port 0: any free one. Throws std::runtime_error, one sentence.
  PairingServer(const std::string& listen, PairingOffer& offer, Tried tried);
  /// The answer that is under way still leaves.
  ~PairingServer();
  PairingServer(const PairingServer&) = delete;
  PairingServer& operator=(const PairingServer&) = delete;

  [[nodiscard]] const std::string& address() const { return address_; }
  /// Of the offer, while it is served.
  [[nodiscard]] PairingOffer::State state() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string address_;
};

/// Asks the pairing server at `address` to let `request` in. Throws PairingError: refused, no answer within
/// `timeout_s`, or what answers is no slave that pairs.
proto::PairingMessage ask_to_join(const std::string& address, const PairingRequest& request,
                                  double timeout_s);

}  // namespace longreach
