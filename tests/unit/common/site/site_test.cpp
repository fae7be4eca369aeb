// The site folder: made whole, private, the same for whoever comes at the same time, and refused when it is
// not.
#include "common/site/site.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace longreach::site_test {
namespace {

namespace fs = std::filesystem;

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777U;
}

std::string refusal_of(const fs::path& site) {
  try {
    (void)site_credentials(site, RpcRole::kMaster);
  } catch (const SiteError& e) {
    return e.what();
  }
  return "";
}

TEST(Site, IsMadeAtTheFirstStartAndOpenToItsOwnerAlone) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "a" / "longreach";
  const RpcCredentials slave = site_credentials(site, RpcRole::kSlave);
  EXPECT_NE(slave.authority.find("BEGIN CERTIFICATE"), std::string::npos);
  EXPECT_NE(slave.certificate.find("BEGIN CERTIFICATE"), std::string::npos);
  EXPECT_NE(slave.key.find("PRIVATE KEY"), std::string::npos);
  EXPECT_EQ(mode_of(site), 0700U);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(site)) {
    EXPECT_EQ(mode_of(entry.path()), 0600U) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 8);
  for (const auto& entry : fs::directory_iterator(site.parent_path()))
    EXPECT_EQ(entry.path(), site) << "drafts are gone";
}

TEST(Site, IsNotMadeBelowARelativeXdgConfigHome) {
  const std::string config = std::getenv("XDG_CONFIG_HOME") ? std::getenv("XDG_CONFIG_HOME") : "";
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  ::setenv("XDG_CONFIG_HOME", "etc", 1);
  ::setenv("HOME", "/somewhere", 1);
  EXPECT_EQ(default_site(), "/somewhere/.config/longreach");
  ::setenv("XDG_CONFIG_HOME", "/etc/xdg", 1);
  EXPECT_EQ(default_site(), "/etc/xdg/longreach");
  config.empty() ? ::unsetenv("XDG_CONFIG_HOME") : ::setenv("XDG_CONFIG_HOME", config.c_str(), 1);
  home.empty() ? ::unsetenv("HOME") : ::setenv("HOME", home.c_str(), 1);
}

TEST(Site, SaysWhyAFolderCannotBeMade) {
  // Nobody makes folders there, root included; what is below it does not exist.
  const std::string refusal = refusal_of("/sys/nowhere/longreach");
  EXPECT_TRUE(refusal.starts_with("cannot create /sys/nowhere: ")) << refusal;
  EXPECT_EQ(refusal.find("No such file"), std::string::npos) << refusal;
}

TEST(Site, StaysAsItIsAndTellsRolesApart) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  const RpcCredentials slave = site_credentials(site, RpcRole::kSlave);
  const RpcCredentials again = site_credentials(site.string() + "/", RpcRole::kSlave);
  const RpcCredentials master = site_credentials(site, RpcRole::kMaster);
  EXPECT_EQ(again.key, slave.key);
  EXPECT_EQ(master.authority, slave.authority);
  EXPECT_NE(master.certificate, slave.certificate);
  EXPECT_NE(master.key, slave.key);
}

TEST(Site, ProgramsThatStartAtOnceMakeOne) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  std::vector<std::string> authorities(8);
  std::vector<std::thread> programs;
  for (auto& authority : authorities)
    programs.emplace_back([&] { authority = site_credentials(site, RpcRole::kClient).authority; });
  for (auto& program : programs) program.join();
  for (const auto& authority : authorities) EXPECT_EQ(authority, authorities.front());
}

TEST(Site, AnEmptyFolderOfOnesOwnIsFilled) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of(folder.path()), "");
  EXPECT_TRUE(fs::exists(folder.path() / "authority.crt"));
}

TEST(Site, OneThatOthersMayOpenIsRefusedWithWhatToDo) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  ASSERT_EQ(refusal_of(site), "");
  ::chmod((site / "master.key").c_str(), 0640);
  EXPECT_NE(refusal_of(site).find("master.key is accessible to other users; restrict it with chmod"),
            std::string::npos)
      << refusal_of(site);
  ::chmod((site / "master.key").c_str(), 0600);
  ::chmod(site.c_str(), 0755);
  EXPECT_NE(refusal_of(site).find("longreach is accessible to other users"), std::string::npos)
      << refusal_of(site);
}

TEST(Site, WhatIsMissingIsNamedAndNothingIsMadeInItsPlace) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  ASSERT_EQ(refusal_of(site), "");
  fs::remove(site / "master.crt");
  EXPECT_NE(refusal_of(site).find("master.crt"), std::string::npos) << refusal_of(site);
  EXPECT_FALSE(fs::exists(site / "master.crt"));
  std::ofstream(site / "master.crt").close();
  ::chmod((site / "master.crt").c_str(), 0600);
  EXPECT_NE(refusal_of(site).find("master.crt"), std::string::npos) << "an empty file";
}

TEST(Site, WhatIsDamagedIsNamedWhicheverPartItIs) {
  const TemporaryFolder folder;
  const fs::path site = folder.path() / "longreach";
  ASSERT_EQ(refusal_of(site), "");
  const auto expect = [&](const std::string& name, const std::string& text, const std::string& why) {
    const std::string before = read_site_file(site / name);
    std::ofstream(site / name) << text;
    EXPECT_NE(refusal_of(site).find(name + why), std::string::npos) << refusal_of(site);
    std::ofstream(site / name) << before;
    EXPECT_EQ(refusal_of(site), "");
  };
  expect("authority.crt", "junk", " is damaged: it contains no certificate");
  expect("master.crt", "junk", " is damaged: it contains no certificate");
  expect("master.key", "junk", " is damaged: it contains no private key");
  expect("master.key", read_site_file(site / "master.key").substr(0, 100), " is damaged");
  expect("master.key", read_site_file(site / "client.key"), " does not match master.crt");
}

TEST(Site, RejectsForeignFilesAndFolders) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "letter.txt") << "dear";
  const auto expect = [](const fs::path& path, const std::string& why) {
    try {
      (void)site_credentials(path, RpcRole::kMaster);
      FAIL() << path;
    } catch (const NoSiteError& e) {
      EXPECT_NE(std::string(e.what()).find(path.string() + why), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find("chmod"), std::string::npos) << e.what();
    }
  };
  expect(folder.path() / "letter.txt", " is not a folder");
  expect(folder.path(), " is not a site");
  ::chmod(folder.path().c_str(), 0755);
  expect(folder.path(), " is not a site");
}

TEST(Site, APlaceThatCannotBeWrittenIsNamed) {
  EXPECT_NE(refusal_of("/proc/longreach").find("/proc/longreach"), std::string::npos)
      << refusal_of("/proc/longreach");
}

}  // namespace
}  // namespace longreach::site_test
