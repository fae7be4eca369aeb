#pragma once
// Pairing: another host joins the site by a token that the slave prints and a person carries over.
//
//   request = its name, certificate requests (PKCS #10) for master and client
//   answer  = the authority's certificate and those two certificates
//   tag_q   = HMAC(token; "request" | request)
//   tag_a   = HMAC(token; "answer" | tag_q | answer)
//
// Only the token is secret, and it never crosses the link: private keys are made where they stay, and
// requests and certificates may be read by anybody. So the connection needs no encryption. Without the token
// nobody, in the middle or not, can make a request that is signed or an answer that is believed, and nobody
// can find it from what he overhears: 2^99 guesses. A tag covers every byte that is read; that of the answer
// covers the request, so no other answer fits. Guessing here: five tries, ten minutes, then the token is
// void, as after its one use. Names and uses in the certificates are the site's choice: master and client,
// never slave; the authority's key never leaves. Clocks do not matter: certificates are valid from 1970 to
// 9999.
//
// Who was paired is written down before the answer leaves (common/site/revocations), so that it can be revoked.
//
// Does not handle: somebody who spends the five tries to be a nuisance (ask for another token).

#include <functional>
#include <stdexcept>
#include <string>
#include <variant>

#include "common/core/time.hpp"
#include "common/crypto/pairing_token.hpp"
#include "common/site/site.hpp"
#include "proto/pairing.pb.h"

namespace longreach {

/// One sentence for the person who pairs.
class PairingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// At the slave: one token, and what it is still good for.
class PairingOffer {
 public:
  static constexpr int kTries = 5;
  static constexpr Duration kLife = std::chrono::minutes(10);
  enum class State { kOpen, kUsed, kExpired, kSpent };

  /// Writes down whom it was given to: host, certificates of its master and its client. May throw; nobody is
  /// paired then.
  using Record = std::function<void(const std::string& host, const std::string& master_pem,
                                    const std::string& client_pem)>;

  PairingOffer(const PairingToken& token, Certificate authority, Time now, Record record = {});

  /// The answer, or one sentence why not.
  std::variant<proto::PairingMessage, std::string> answer(const proto::PairingMessage& request, Time now);

  [[nodiscard]] State state(Time now) const;
  [[nodiscard]] int tries_left() const { return tries_left_; }
  /// Who was paired, for the log: name, and fingerprints of its certificates. Empty: nobody.
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

/// At the host that joins: its new keys, and the site when the answer is good.
class PairingRequest {
 public:
  /// `host`: its name, for the slave's log.
  PairingRequest(const PairingToken& token, const std::string& host);
  [[nodiscard]] const proto::PairingMessage& message() const { return message_; }
  /// Throws PairingError when the answer is not from the slave that printed the token.
  [[nodiscard]] SiteFiles accept(const proto::PairingMessage& answer) const;

 private:
  const PairingToken token_;
  CertificateRequest master_, client_;
  proto::PairingMessage message_;
};

}  // namespace longreach
