#include "common/site/pairing.hpp"

#include <algorithm>
#include <cctype>

#include "common/text/utf8.hpp"

namespace longreach {
namespace {

constexpr std::string_view kRequest = "longreach pairing request";
constexpr std::string_view kAnswer = "longreach pairing answer";

CertificateTerms terms_of(RpcRole role) {
  return {.name = std::string(name_of(role)),
          .use = role == RpcRole::kMaster ? CertificateUse::kBoth : CertificateUse::kClient};
}

/// Returns the name as far as it may stand in a line of words KEY=VALUE: the name comes from elsewhere. Letters of any
/// script are kept.
std::string plain(const std::string& name) {
  constexpr std::size_t kLengthMax = 64;
  std::string out;
  std::string_view left = name;
  while (!left.empty() && out.size() < kLengthMax) {
    const std::size_t length = std::max<std::size_t>(utf8_length(left), 1);
    const std::string_view letter = left.substr(0, length);
    const bool word = std::isalnum(static_cast<unsigned char>(letter[0])) != 0 || letter == "." ||
                      letter == "-" || letter == "_" || (length > 1 && printable(letter) == letter);
    out += word ? letter : "?";
    left.remove_prefix(length);
  }
  return out.empty() ? "?" : out;
}

std::string tries_in_words(int tries) {
  if (tries == 0) return "no attempts are left: the token is invalid";
  return tries == 1 ? "1 attempt is left" : std::to_string(tries) + " attempts are left";
}

constexpr std::string_view kAnother = "; get another token with longreach-slave --pair";

}  // namespace

PairingOffer::PairingOffer(const PairingToken& token, Certificate authority, Time now, Record record)
    : token_(token), authority_(std::move(authority)), until_(now + kLife), record_(std::move(record)) {}

PairingOffer::State PairingOffer::state(Time now) const {
  if (used_) return State::kUsed;
  if (tries_left_ == 0) return State::kSpent;
  return now >= until_ ? State::kExpired : State::kOpen;
}

std::variant<proto::PairingMessage, std::string> PairingOffer::answer(const proto::PairingMessage& message,
                                                                      Time now) {
  switch (state(now)) {
    case State::kOpen:
      break;
    case State::kUsed:
      return "the token was already used" + std::string(kAnother);
    case State::kExpired:
      return "the token expired: it was valid for 10 minutes" + std::string(kAnother);
    case State::kSpent:
      return "no attempts are left: the token is invalid" + std::string(kAnother);
  }
  --tries_left_;
  if (!token_.verifies(message.tag(), kRequest, message.body()))
    return "the token is wrong; " + tries_in_words(tries_left_);
  proto::PairingRequest request;
  proto::PairingAnswer answer;
  try {
    if (!request.ParseFromString(message.body()))
      return "the request is invalid; run the same version of all programs";
    answer.set_master(certify(authority_, request.master_request(), terms_of(RpcRole::kMaster)));
    answer.set_client(certify(authority_, request.client_request(), terms_of(RpcRole::kClient)));
  } catch (const std::runtime_error&) {
    return "the request is not for certificates of this site; run the same version of all programs";
  }
  try {
    if (record_) record_(plain(request.host()), answer.master(), answer.client());
  } catch (const std::runtime_error& error) {
    return std::string("the list of paired hosts could not be written, so the host was not paired: ") +
           error.what();
  }
  used_ = true;
  answer.set_authority(authority_.certificate_pem);
  paired_ = "host=" + plain(request.host()) + " master=" + fingerprint(answer.master()) +
            " client=" + fingerprint(answer.client());
  proto::PairingMessage out;
  out.set_body(answer.SerializeAsString());
  out.set_tag(token_.tag(kAnswer, message.tag() + out.body()));
  return out;
}

PairingRequest::PairingRequest(const PairingToken& token, const std::string& host)
    : token_(token), master_(make_request()), client_(make_request()) {
  proto::PairingRequest request;
  request.set_host(host);
  request.set_master_request(master_.request_pem);
  request.set_client_request(client_.request_pem);
  message_.set_body(request.SerializeAsString());
  message_.set_tag(token_.tag(kRequest, message_.body()));
}

SiteFiles PairingRequest::accept(const proto::PairingMessage& message) const {
  if (!token_.verifies(message.tag(), kAnswer, message_.tag() + message.body()))
    throw PairingError(
        "the response is not from the slave that printed the token: it is from another slave, or from an "
        "attacker between the hosts; no certificate was stored");
  proto::PairingAnswer answer;
  const bool good = answer.ParseFromString(message.body()) &&
                    certificate_trouble(answer.authority(), answer.master(), master_.key_pem,
                                        terms_of(RpcRole::kMaster).name)
                        .empty() &&
                    certificate_trouble(answer.authority(), answer.client(), client_.key_pem,
                                        terms_of(RpcRole::kClient).name)
                        .empty();
  if (!good) throw PairingError("the slave's response is invalid; run the same version of all programs");
  const std::string master = file_stem(RpcRole::kMaster), client = file_stem(RpcRole::kClient);
  return {{"authority.crt", answer.authority()},
          {master + ".crt", answer.master()},
          {master + ".key", master_.key_pem},
          {client + ".crt", answer.client()},
          {client + ".key", client_.key_pem}};
}

}  // namespace longreach
