#include "common/site/revocations.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/site/pairing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::revocations_test {
namespace {

struct Site {
  Site() : authority(site_authority(folder)) {}

  std::string paired(const std::string& host) const {
    const std::string master = issue(authority, {.name = "master.longreach"}).certificate_pem;
    record_pairing(folder, host, master, issue(authority, {.name = "client.longreach"}).certificate_pem);
    return fingerprint(master);
  }

  TemporaryFolder temporary;
  std::filesystem::path folder = temporary.path() / "site";
  Certificate authority;
};

TEST(Revocations, ListNamesHostRoleTimeAndWhetherItCounts) {
  const Site site;
  EXPECT_TRUE(paired_certificates(site.folder).empty());
  const std::string master = site.paired("moon-base");
  (void)site.paired("mars");
  (void)revoke(site.folder, {"moon-base"});
  const auto list = paired_certificates(site.folder);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].host, "moon-base");
  EXPECT_EQ(list[0].role, "master");
  EXPECT_EQ(list[1].role, "client");
  EXPECT_EQ(list[0].fingerprint, master);
  EXPECT_EQ(list[0].expires, "9999-12-31");
  EXPECT_EQ(list[0].since.size(), 20u);
  EXPECT_TRUE(list[0].revoked && list[1].revoked);
  EXPECT_FALSE(list[2].revoked || list[3].revoked);
}

TEST(Revocations, AreSeenByAProgramThatRuns) {
  const Site site;
  const std::string one = site.paired("one"), other = site.paired("other");
  refuse_revoked(site.folder);
  EXPECT_FALSE(is_revoked(one));
  EXPECT_EQ(revoke(site.folder, {"one"}).size(), 2u);
  EXPECT_TRUE(is_revoked(one));
  EXPECT_FALSE(is_revoked(other));
  EXPECT_EQ(revoke(site.folder, {other}), std::vector<std::string>{other});  // by its fingerprint
  EXPECT_TRUE(is_revoked(other));
}

TEST(Revocations, StayWhenTheListGoesOrIsDamaged) {
  const Site site;
  const std::string one = site.paired("one");
  refuse_revoked(site.folder);
  (void)revoke(site.folder, {"one"});
  ASSERT_TRUE(is_revoked(one));
  std::ofstream(site.folder / "revoked", std::ios::app) << "rubbish\n";
  EXPECT_TRUE(is_revoked(one));
  EXPECT_THROW(refuse_revoked(site.folder), SiteError) << "a program does not start with it";
  std::filesystem::remove(site.folder / "revoked");
  EXPECT_TRUE(is_revoked(one));
}

TEST(Revocations, UnknownNameRevokesNothing) {
  const Site site;
  (void)site.paired("one");
  EXPECT_THROW((void)revoke(site.folder, {"one", "two"}), SiteError);
  EXPECT_FALSE(paired_certificates(site.folder)[0].revoked);
}

// Two hosts may have the same name: neither is revoked by mistake.
TEST(Revocations, AmbiguousNameAsksForTheFingerprint) {
  const Site site;
  const std::string one = site.paired("vm"), other = site.paired("vm");
  try {
    (void)revoke(site.folder, {"vm"});
    FAIL() << "both were revoked";
  } catch (const SiteError& error) {
    const std::string said = error.what();
    EXPECT_EQ(
        said.find("2 pairings have the name vm; give the fingerprints of the certificates to revoke instead; "
                  "paired since "),
        0u)
        << said;
    EXPECT_NE(said.find(one), std::string::npos) << said;
    EXPECT_NE(said.find(other), std::string::npos) << said;
  }
  EXPECT_FALSE(paired_certificates(site.folder)[0].revoked);
  std::vector<std::string> of_one;
  for (const PairedCertificate& certificate : paired_certificates(site.folder))
    if (of_one.size() < 2) of_one.push_back(certificate.fingerprint);
  EXPECT_EQ(revoke(site.folder, of_one).size(), 2u);
  EXPECT_EQ(revoke(site.folder, {"vm"}).size(), 4u) << "only one pairing is left, so the name is clear";
  EXPECT_TRUE(paired_certificates(site.folder)[3].revoked);
}

TEST(Revocations, WhoCannotBeWrittenDownIsNotPaired) {
  const Site site;
  const PairingToken token = PairingToken::draw();
  PairingOffer offer(token, site.authority, Time{},
                     [](const auto&...) { throw SiteError("the disk is full"); });
  const auto answer = offer.answer(PairingRequest(token, "one").message(), Time{});
  const auto* refusal = std::get_if<std::string>(&answer);
  ASSERT_NE(refusal, nullptr);
  EXPECT_NE(refusal->find("the disk is full"), std::string::npos) << *refusal;
  EXPECT_EQ(offer.state(Time{}), PairingOffer::State::kOpen);
}

}  // namespace
}  // namespace longreach::revocations_test
