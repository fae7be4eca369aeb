#include "common/io/site.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/io/certificate.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr std::array kRoles = {RpcRole::kSlave, RpcRole::kMaster, RpcRole::kClient};

/// "slave" of "slave.longreach".
std::string file_stem(RpcRole role) {
  const std::string_view name = name_of(role);
  return std::string(name.substr(0, name.find('.')));
}

CertificateUse use_of(RpcRole role) {
  switch (role) {
    case RpcRole::kSlave:
      return CertificateUse::kServer;
    case RpcRole::kMaster:
      return CertificateUse::kBoth;
    case RpcRole::kClient:
      break;
  }
  return CertificateUse::kClient;
}

void write(const fs::path& file, const std::string& text) {
  const int at = ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  const bool done = at >= 0 && ::write(at, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                    ::fsync(at) == 0;
  const int error = errno;
  if (at >= 0) ::close(at);
  if (!done)
    throw SiteError("cannot write " + file.string() + ": " + std::strerror(error) +
                    "; make its folder writable, or choose another with --site DIR");
}

void fill(const fs::path& folder) {
  const Certificate authority = make_authority("longreach site");
  write(folder / "authority.crt", authority.certificate_pem);
  write(folder / "authority.key", authority.key_pem);
  for (const RpcRole role : kRoles) {
    const Certificate one = issue(authority, {.name = std::string(name_of(role)), .use = use_of(role)});
    write(folder / (file_stem(role) + ".crt"), one.certificate_pem);
    write(folder / (file_stem(role) + ".key"), one.key_pem);
  }
}

/// Under another name first: the folder appears as a whole or not at all.
void make(const fs::path& site) {
  std::error_code error;
  fs::create_directories(site.parent_path(), error);
  std::string draft = site.string() + ".XXXXXX";
  if (::mkdtemp(draft.data()) == nullptr)
    throw SiteError("cannot make " + site.string() + ": " + std::strerror(errno) +
                    "; choose another place with --site DIR");
  try {
    fill(draft);
  } catch (...) {
    fs::remove_all(draft, error);
    throw;
  }
  fs::rename(draft, site, error);
  // Somebody else was faster: theirs counts.
  if (error) fs::remove_all(draft, error);
}

/// Others must not be able to read, change or replace anything.
void require_private(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw SiteError(
        "cannot read " + path.string() + ": " + std::strerror(errno) +
        "; restore it, or remove its folder: a new site is made then, which old ones do not trust");
  if (status.st_uid != ::geteuid())
    throw SiteError(path.string() + " belongs to another user; choose a folder of your own with --site DIR");
  if ((status.st_mode & 077U) != 0)
    throw SiteError(path.string() + " is open to other users; close it with chmod -R go= " +
                    (fs::is_directory(path) ? path : path.parent_path()).string());
}

std::string read(const fs::path& file) {
  require_private(file);
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().empty())
    throw SiteError("cannot read " + file.string() + "; restore it, or remove its folder");
  return text.str();
}

}  // namespace

fs::path default_site() {
  const auto given = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? std::string(value) : std::string();
  };
  if (const std::string config = given("XDG_CONFIG_HOME"); !config.empty())
    return fs::path(config) / "longreach";
  std::string home = given("HOME");
  if (const passwd* user = ::getpwuid(::geteuid()); home.empty() && user != nullptr) home = user->pw_dir;
  if (!home.empty()) return fs::path(home) / ".config" / "longreach";
  throw SiteError(
      "neither XDG_CONFIG_HOME nor HOME is set; say with --site DIR where the certificates are kept");
}

RpcCredentials site_credentials(const fs::path& site, RpcRole role) {
  fs::path folder = fs::absolute(site).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // DIR/ is DIR
  std::error_code error;
  const bool empty = fs::is_directory(folder, error) && fs::is_empty(folder, error);
  if (empty) require_private(folder);
  if (empty || !fs::exists(folder)) make(folder);
  require_private(folder);
  const std::string stem = file_stem(role);
  return {read(folder / "authority.crt"), read(folder / (stem + ".crt")), read(folder / (stem + ".key"))};
}

}  // namespace longreach
