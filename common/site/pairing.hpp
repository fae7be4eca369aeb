#pragma once
// Pairing: another host joins the site with a token that the slave prints and a person transfers.
//
//   request = its name, certificate requests (PKCS #10) for master and client
//   answer  = the authority's certificate and those two certificates
//   tag_q   = HMAC(token; "request" | request)
//   tag_a   = HMAC(token; "answer" | tag_q | answer)
//
// The connection does not need encryption, because the token is the only secret and never crosses the link:
// private keys stay on their host, and requests and certificates are not secret. Without the token, an
// attacker (including a man in the middle) can neither create a valid request or answer nor derive the token
// from the messages, which would take 2^99 guesses. A tag covers every byte of its message. The tag of the
// answer also covers the request, so that an answer is valid only for its own request. Online guessing is
// limited to five attempts in ten minutes; after that, or after its first use, the token is invalid. The
// slave's site determines the names and roles in the certificates: master and client, but never slave. The
// key of the authority is not transferred. Wrong clocks do no harm, because certificates are valid from 1970
// to 9999.
//
// The pairing is recorded before the answer is sent (common/site/revocations), so that it can be revoked.
//
// An attacker can deny service by using up the five attempts; the remedy is to print another token.

#include <functional>
#include <stdexcept>
#include <string>
#include <variant>

#include "common/core/time.hpp"
#include "common/crypto/pairing_token.hpp"
#include "common/site/site.hpp"
#include "proto/pairing.pb.h"

namespace longreach {

/// Error for the user who pairs a host; the message is one sentence.
class PairingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The slave's part: a token and its remaining validity.
class PairingOffer {
 public:
  static constexpr int kTries = 5;
  static constexpr Duration kLife = std::chrono::minutes(10);
  enum class State { kOpen, kUsed, kExpired, kSpent };

  /// Records the certificates that were issued to the master and the client of `host`. If it throws, the
  /// pairing fails.
  using Record = std::function<void(const std::string& host, const std::string& master_pem,
                                    const std::string& client_pem)>;

  PairingOffer(const PairingToken& token, Certificate authority, Time now, Record record = {});

  /// Returns the answer, or one sentence with the reason for the refusal.
  std::variant<proto::PairingMessage, std::string> answer(const proto::PairingMessage& request, Time now);

  [[nodiscard]] State state(Time now) const;
  [[nodiscard]] int tries_left() const { return tries_left_; }
  /// Returns the paired host for the log, with its name and the fingerprints of its certificates. Returns an
  /// empty string if no host was paired.
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

/// The joining host's part: its new keys, and the site if the answer is valid.
class PairingRequest {
 public:
  /// `host` is the name of this host for the slave's log.
  PairingRequest(const PairingToken& token, const std::string& host);
  [[nodiscard]] const proto::PairingMessage& message() const { return message_; }
  /// Returns the files of the site. Throws PairingError if the answer is not from the slave that printed the
  /// token.
  [[nodiscard]] SiteFiles accept(const proto::PairingMessage& answer) const;

 private:
  const PairingToken token_;
  CertificateRequest master_, client_;
  proto::PairingMessage message_;
};

}  // namespace longreach
