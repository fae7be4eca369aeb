// Who joins a site by a token, and who does not, whatever stands between.
#include "common/site/pairing.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/loop/real_time_loop.hpp"
#include "common/rpc/pairing_rpc.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::pairing_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::minutes;
using std::chrono::seconds;

/// A slave that has printed a token, at a time of the test's choice.
struct Desk {
  PairingToken token = PairingToken::draw();
  Certificate authority = make_authority("one site");
  Time began{std::chrono::hours(5)};
  PairingOffer offer{token, authority, began};

  std::string refusal(const proto::PairingMessage& message, Duration after = seconds(1)) {
    const auto result = offer.answer(message, began + after);
    return std::holds_alternative<std::string>(result) ? std::get<std::string>(result) : "";
  }
  proto::PairingMessage answer(const PairingRequest& request) {
    return std::get<proto::PairingMessage>(offer.answer(request.message(), began + seconds(1)));
  }
};

std::string flipped(std::string text, std::size_t bit) {
  text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
  return text;
}

bool accepted(const PairingRequest& request, const proto::PairingMessage& answer) {
  try {
    (void)request.accept(answer);
    return true;
  } catch (const PairingError&) {
    return false;
  }
}

TEST(Pairing, AHostWithTheTokenBecomesMasterAndClientAndNothingElse) {
  Desk desk;
  const PairingRequest request(desk.token, "operator-1\nforged line");
  const SiteFiles files = request.accept(desk.answer(request));
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(files.at("authority.crt"), desk.authority.certificate_pem);
  for (const std::string role : {"master", "client"}) {
    const std::string& certificate = files.at(role + ".crt");
    EXPECT_EQ(certificate_trouble(desk.authority.certificate_pem, certificate, files.at(role + ".key"),
                                  role + ".longreach"),
              "");
    EXPECT_NE(certificate_trouble(desk.authority.certificate_pem, certificate, "", "slave.longreach"), "");
  }
  EXPECT_EQ(desk.offer.state(desk.began), PairingOffer::State::kUsed);
  EXPECT_NE(desk.offer.paired().find("host=operator-1?forged?line master=SHA256:"), std::string::npos)
      << desk.offer.paired();
}

TEST(Pairing, AWrongTokenCostsATryAndFiveMakeItVoid) {
  Desk desk;
  for (const std::string left : {"4 attempts are left", "3 attempts are left", "2 attempts are left",
                                 "1 attempt is left", "no attempts are left: the token is invalid"}) {
    const PairingRequest guess(PairingToken::draw(), "guesser");
    EXPECT_EQ(desk.refusal(guess.message()), "the token is wrong; " + left);
  }
  EXPECT_EQ(desk.offer.state(desk.began), PairingOffer::State::kSpent);
  const PairingRequest right(desk.token, "operator");
  EXPECT_NE(desk.refusal(right.message()).find("no attempts are left"), std::string::npos);
  EXPECT_EQ(desk.offer.paired(), "");
}

TEST(Pairing, TheRightTokenIsGoodAtTheFifthTryAndInTheLastSecond) {
  Desk desk;
  for (int i = 0; i < 4; ++i)
    EXPECT_NE(desk.refusal(PairingRequest(PairingToken::draw(), "x").message()), "");
  EXPECT_EQ(desk.refusal(PairingRequest(desk.token, "x").message(), minutes(10) - seconds(1)), "");
}

TEST(Pairing, AnExpiredTokenIsRefusedWithWhatToDo) {
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  EXPECT_EQ(desk.refusal(request.message(), minutes(10)),
            "the token expired: it was valid for 10 minutes; get another token with longreach-slave --pair");
  EXPECT_EQ(desk.offer.state(desk.began + minutes(10)), PairingOffer::State::kExpired);
  EXPECT_EQ(desk.offer.state(desk.began + minutes(10) - seconds(1)), PairingOffer::State::kOpen);
}

TEST(Pairing, AUsedTokenIsRefusedAlsoToTheSameRequest) {
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  (void)desk.answer(request);
  EXPECT_NE(desk.refusal(request.message()).find("already used"), std::string::npos);
  EXPECT_NE(desk.refusal(PairingRequest(desk.token, "another").message()).find("already used"),
            std::string::npos);
  // Nor does what was overheard help with the next token.
  Desk later;
  EXPECT_NE(later.refusal(request.message()).find("the token is wrong"), std::string::npos);
}

TEST(Pairing, EveryFlippedBitOfTheRequestIsRefused) {
  const PairingToken token = PairingToken::draw();
  const Certificate authority = make_authority("one site");
  const PairingRequest request(token, "operator");
  const auto refused = [&](const proto::PairingMessage& message) {
    PairingOffer fresh(token, authority, Time{});
    return std::holds_alternative<std::string>(fresh.answer(message, Time{}));
  };
  ASSERT_FALSE(refused(request.message()));
  for (std::size_t bit = 0; bit < 8 * request.message().body().size(); ++bit) {
    proto::PairingMessage message = request.message();
    message.set_body(flipped(message.body(), bit));
    ASSERT_TRUE(refused(message)) << bit;
  }
  for (std::size_t bit = 0; bit < 256; ++bit) {
    proto::PairingMessage message = request.message();
    message.set_tag(flipped(message.tag(), bit));
    ASSERT_TRUE(refused(message)) << bit;
  }
}

TEST(Pairing, EveryFlippedBitOfTheAnswerIsRefused) {
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  const proto::PairingMessage answer = desk.answer(request);
  for (std::size_t bit = 0; bit < 8 * answer.body().size(); ++bit) {
    proto::PairingMessage message = answer;
    message.set_body(flipped(message.body(), bit));
    ASSERT_FALSE(accepted(request, message)) << bit;
  }
  for (std::size_t bit = 0; bit < 256; ++bit) {
    proto::PairingMessage message = answer;
    message.set_tag(flipped(message.tag(), bit));
    ASSERT_FALSE(accepted(request, message)) << bit;
  }
  EXPECT_TRUE(accepted(request, answer));
}

TEST(Pairing, AManInTheMiddleGainsNothing) {
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  // To the host that joins he plays the slave, with an authority of his own.
  Desk his;
  PairingOffer his_offer(his.token, his.authority, desk.began);
  EXPECT_TRUE(std::holds_alternative<std::string>(his_offer.answer(request.message(), desk.began)));
  const PairingRequest own(his.token, "operator");
  EXPECT_FALSE(accepted(request, his.answer(own)));
  // To the slave he plays the host, with keys of his own under the tag that he overheard.
  proto::PairingMessage swapped = own.message();
  swapped.set_tag(request.message().tag());
  EXPECT_NE(desk.refusal(swapped).find("the token is wrong"), std::string::npos);
  // He returns what he was sent.
  EXPECT_FALSE(accepted(request, request.message()));
  // He answers with the slave's answer to another request of the same token.
  Desk twin{desk.token, desk.authority};
  const PairingRequest other(desk.token, "operator");
  EXPECT_FALSE(accepted(request, twin.answer(other)));
  EXPECT_TRUE(accepted(request, desk.answer(request)));
}

TEST(Pairing, WhatCrossesTheLinkContainsNeitherTokenNorPrivateKey) {
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  const proto::PairingMessage answer = desk.answer(request);
  const SiteFiles files = request.accept(answer);
  const std::string eavesdropped = request.message().SerializeAsString() + answer.SerializeAsString();
  std::string bare;
  for (const char c : desk.token.text())
    if (c != '-') bare += c;
  std::vector<std::string> secrets{desk.token.text(), bare, bare.substr(0, 8), desk.authority.key_pem};
  for (const std::string name : {"master.key", "client.key"}) {
    const std::string& key = files.at(name);
    // The base64 lines: the first third of the text is the private number, the rest the public one.
    secrets.push_back(key.substr(key.find('\n') + 1, 64));
    EXPECT_NE(key.find("PRIVATE KEY"), std::string::npos);
  }
  for (const std::string& secret : secrets) EXPECT_EQ(eavesdropped.find(secret), std::string::npos) << secret;
  EXPECT_EQ(eavesdropped.find("PRIVATE KEY"), std::string::npos);
  EXPECT_NE(eavesdropped.find("BEGIN CERTIFICATE"), std::string::npos)
      << "what is public is there: the search works";
}

TEST(Pairing, ARequestThatIsSignedByTheTokenButNoRequestIsRefused) {
  Desk desk;
  const auto sealed = [&](const proto::PairingRequest& request) {
    proto::PairingMessage message;
    message.set_body(request.SerializeAsString());
    message.set_tag(desk.token.tag("longreach pairing request", message.body()));
    return message;
  };
  proto::PairingRequest request;
  EXPECT_NE(desk.refusal(sealed(request)).find("run the same version of all programs"), std::string::npos);
  // The key of somebody else, who has not signed: the signature stands at the end.
  const std::string good = make_request().request_pem;
  std::string forged = good;
  char& signature = forged[forged.find("\n-----END") - 6];
  signature = signature == 'A' ? 'B' : 'A';
  request.set_master_request(good);
  request.set_client_request(forged);
  EXPECT_NE(desk.refusal(sealed(request)), "");
  EXPECT_EQ(desk.offer.paired(), "");
}

TEST(Pairing, GoesOverASocketAndSaysWhatIsWrong) {
  PairingToken token = PairingToken::draw();
  PairingOffer offer(token, make_authority("one site"), boottime_now());
  std::vector<std::string> tried;
  PairingServer server("127.0.0.1:0", offer,
                       [&](const std::string&, const std::string& refusal) { tried.push_back(refusal); });
  const auto join = [&](const PairingToken& with) -> std::string {
    try {
      const PairingRequest request(with, "operator");
      (void)request.accept(ask_to_join(server.address(), request, 30.0));
      return "";
    } catch (const PairingError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(join(PairingToken::draw()),
            "the slave at " + server.address() + " refused: the token is wrong; 4 attempts are left");
  EXPECT_EQ(server.state(), PairingOffer::State::kOpen);
  EXPECT_EQ(join(token), "");
  EXPECT_NE(join(token).find("already used"), std::string::npos);
  EXPECT_EQ(server.state(), PairingOffer::State::kUsed);
  EXPECT_EQ(tried.size(), 3U);
}

TEST(PairedSite, IsWrittenForItsOwnerAloneAndPutsAsideWhatWasThere) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "a" / "longreach";
  EXPECT_FALSE(site_exists(site));
  const std::string before = site_credentials(site, RpcRole::kMaster).authority;
  EXPECT_TRUE(site_exists(site));
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  const fs::path aside = write_site(site, request.accept(desk.answer(request)));
  EXPECT_EQ(site_credentials(aside, RpcRole::kMaster).authority, before);
  EXPECT_EQ(site_credentials(site, RpcRole::kMaster).authority, desk.authority.certificate_pem);
  EXPECT_EQ(site_credentials(site, RpcRole::kClient).authority, desk.authority.certificate_pem);
  struct stat status {};
  for (const auto& entry : fs::directory_iterator(site)) {
    ASSERT_EQ(::stat(entry.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777U, 0600U) << entry.path();
  }
  ASSERT_EQ(::stat(site.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0700U);
}

TEST(PairedSite, HasNoSlaveAndPairsNobody) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  Desk desk;
  const PairingRequest request(desk.token, "operator");
  EXPECT_EQ(write_site(site, request.accept(desk.answer(request))), "");
  for (const auto& page_command : {+[](const fs::path& at) { (void)site_credentials(at, RpcRole::kSlave); },
                                   +[](const fs::path& at) { (void)site_authority(at); }}) {
    try {
      page_command(site);
      ADD_FAILURE() << "not refused";
    } catch (const SiteError& e) {
      EXPECT_NE(std::string(e.what()).find("was created by pairing"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace longreach::pairing_test
