#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <vector>

#include "common/site/site.hpp"
#include "deploy/cli/doctor/doctor_checks.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAnew =
    "restore it, or move the folder away: the next start will then create a new site, and all hosts "
    "must be paired again";

/// The folder and every file in it that contains a key or a certificate.
Finding examine_modes(const fs::path& site) {
  std::vector<fs::path> paths{site};
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(site, error)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".key" || extension == ".crt") paths.push_back(entry.path());
  }
  for (const fs::path& path : paths) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || status.st_uid != ::geteuid())
      return {FindingVerdict::kFailure, "folder", path.string() + " belongs to another user",
              "run longreach as the owner of the folder, or choose another folder with --site DIR"};
    if ((status.st_mode & 077U) != 0)
      return {FindingVerdict::kFailure, "folder",
              path.string() + " is accessible to other users: a user who can read it can control the robot",
              "run chmod -R go= " + site.string() + "; if another user may have read it, create a new site"};
  }
  return {FindingVerdict::kOk, "folder", "accessible only to its owner"};
}

/// Returns an empty result if the file cannot be read.
std::string text_of(const fs::path& file) {
  try {
    return read_site_file(file);
  } catch (const SiteError&) {
    return "";
  }
}

Finding examine_authority(const fs::path& site, const std::string& authority) {
  if (authority.empty())
    return {FindingVerdict::kFailure, "authority",
            (site / "authority.crt").string() + " is missing or cannot be read", std::string(kAnew)};
  const std::string found = fingerprint(authority).substr(0, 23) + "...";
  if (!fs::exists(site / "authority.key"))
    return {FindingVerdict::kOk, "authority",
            found + ", created on another host: this host was paired, so no slave can run here"};
  if (const std::string trouble =
          certificate_trouble(authority, authority, text_of(site / "authority.key"), "");
      !trouble.empty())
    return {FindingVerdict::kFailure, "authority", "authority.crt: " + trouble, std::string(kAnew)};
  return {FindingVerdict::kOk, "authority", found + ", created on this host, which can pair other hosts"};
}

Finding examine_role(const fs::path& site, RpcRole role, const std::string& authority) {
  const std::string stem = file_stem(role);
  for (const std::string end : {".crt", ".key"}) {
    if (text_of(site / (stem + end)).empty())
      return {FindingVerdict::kFailure, stem,
              (site / (stem + end)).string() + " is missing or cannot be read", std::string(kAnew)};
  }
  const std::string certificate = text_of(site / (stem + ".crt"));
  const std::string trouble = certificate_trouble(authority, certificate, text_of(site / (stem + ".key")),
                                                  std::string(name_of(role)));
  if (!trouble.empty())
    return {FindingVerdict::kFailure, stem, stem + ".crt: " + trouble, std::string(kAnew)};
  return {FindingVerdict::kOk, stem, "signed by the authority, valid until " + valid_until(certificate)};
}

}  // namespace

Section examine_site(const Options& options) {
  const fs::path site = options.site.empty() ? default_site() : fs::path(options.site);
  Section out{"Site " + site.string()};
  if (options.insecure) {
    out.findings.push_back({FindingVerdict::kWarning, "folder",
                            "not used: RPC is unencrypted and limited to this machine",
                            "use --insecure for tests only"});
    return out;
  }
  if (!site_exists(site)) {
    out.findings.push_back(
        {FindingVerdict::kWarning, "folder",
         "there is no site yet, because no longreach program has been started here",
         "on the robot's host, start longreach-slave; on any other host, join the slave's site with "
         "longreach pair"});
    return out;
  }
  out.findings.push_back(examine_modes(site));
  if (out.findings.back().verdict != FindingVerdict::kOk) return out;  // no program reads it either
  const std::string authority = text_of(site / "authority.crt");
  out.findings.push_back(examine_authority(site, authority));
  if (authority.empty()) return out;
  std::vector<RpcRole> roles{RpcRole::kMaster, RpcRole::kClient};
  if (fs::exists(site / "authority.key")) roles.insert(roles.begin(), RpcRole::kSlave);
  for (const RpcRole role : roles) out.findings.push_back(examine_role(site, role, authority));
  return out;
}

}  // namespace longreach
