#pragma once
// Pairing: another host joins the site by a token that the slave prints and a person transfers.
//
//   request = its name, certificate requests (PKCS #10) for master and client
//   answer  = the authority's certificate and those two certificates
//   tag_q   = HMAC(token; "request" | request)
//   tag_a   = HMAC(token; "answer" | tag_q | answer)
//
// Only the token is secret, and it never crosses the link: private keys never leave their host, and requests
// and certificates are not secret. The connection therefore needs no encryption. Without the token, nobody,
// including a man in the middle, can create a signed request or a valid answer, or derive the token from the
// messages: this takes 2^99 guesses. A tag covers every byte of its message; that of the answer covers the
// request, so no other answer is valid for it. Online guessing is limited to five attempts in ten minutes;
// then the token is invalid, as after its first use. The slave's site determines names and roles in the
// certificates: master and client, never slave; the key of the authority is not transferred. Clocks do not
// matter: certificates are valid from 1970 to 9999.
//
// The pairing is recorded before the answer is sent (common/site/revocations), so that it can be revoked.
//
// Denial of service by using up the five attempts is not prevented (print another token).

#include <functional>
#include <stdexcept>
#include <string>
#include <variant>

#include "common/core/time.hpp"
#include "common/crypto/pairing_token.hpp"
#include "common/site/site.hpp"
#include "proto/pairing.pb.h"

namespace longreach {

/// One sentence for the user who pairs.
class PairingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// At the slave: a token and its remaining validity.
class PairingOffer {
 public:
  static constexpr int kTries = 5;
  static constexpr Duration kLife = std::chrono::minutes(10);
  enum class State { kOpen, kUsed, kExpired, kSpent };

  /// Records the issued certificates: host, certificates of its master and its client. It may throw; the
  /// pairing then fails.
  using Record = std::function<void(const std::string& host, const std::string& master_pem,
                                    const std::string& client_pem)>;

  PairingOffer(const PairingToken& token, Certificate authority, Time now, Record record = {});

  /// Returns the answer, or one sentence with the reason for refusal.
  std::variant<proto::PairingMessage, std::string> answer(const proto::PairingMessage& request, Time now);

  [[nodiscard]] State state(Time now) const;
  [[nodiscard]] int tries_left() const { return tries_left_; }
  /// The paired host, for the log: name, and fingerprints of its certificates. Empty: none.
  [[nodiscard]] const std::string& paired() const { return paired_; }

 private:
  const PairingToken token_;
  const Certificate authority_;
  const Time until_;
  const Record record_;
  int tries_left_ = kTries;
  bool used_ = false;
  std::string paired_;
};

/// At the joining host: its new keys, and the site if the answer is valid.
class PairingRequest {
 public:
  /// `host`: name of this host, for the slave's log.
  PairingRequest(const PairingToken& token, const std::string& host);
  [[nodiscard]] const proto::PairingMessage& message() const { return message_; }
  /// Throws PairingError if the answer is not from the slave that printed the token.
  [[nodiscard]] SiteFiles accept(const proto::PairingMessage& answer) const;

 private:
  const PairingToken token_;
  CertificateRequest master_, client_;
  proto::PairingMessage message_;
};

}  // namespace longreach
