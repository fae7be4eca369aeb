#include "common/site/site.hpp"

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

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr std::array kRoles = {RpcRole::kSlave, RpcRole::kMaster, RpcRole::kClient};

constexpr const char* kRestore =
    "; restore it, or move the site folder away: a new site will then be created, and all hosts must "
    "be paired again";

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

SiteFiles new_site() {
  const Certificate authority = make_authority("longreach site");
  SiteFiles out{{"authority.crt", authority.certificate_pem}, {"authority.key", authority.key_pem}};
  for (const RpcRole role : kRoles) {
    const Certificate one = issue(authority, {.name = std::string(name_of(role)), .use = use_of(role)});
    out[file_stem(role) + ".crt"] = one.certificate_pem;
    out[file_stem(role) + ".key"] = one.key_pem;
  }
  return out;
}

/// A complete folder beside `site` that is to become it.
fs::path draft(const fs::path& site, const SiteFiles& files) {
  std::error_code error;
  fs::create_directories(site.parent_path(), error);
  if (error)
    throw SiteError("cannot create " + site.parent_path().string() + ": " + error.message() +
                    "; choose another folder with --site DIR");
  std::string folder = site.string() + ".XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr)
    throw SiteError("cannot create " + site.string() + ": " + std::strerror(errno) +
                    "; choose another folder with --site DIR");
  try {
    for (const auto& [name, text] : files) write(fs::path(folder) / name, text);
  } catch (...) {
    fs::remove_all(folder, error);
    throw;
  }
  return folder;
}

/// Under another name first: the folder appears as a whole or not at all.
void make(const fs::path& site) {
  const fs::path whole = draft(site, new_site());
  std::error_code error;
  fs::rename(whole, site, error);
  // Somebody else was faster: theirs counts.
  if (error) fs::remove_all(whole, error);
}

/// DIR/ is DIR.
fs::path plain(const fs::path& site) {
  const fs::path folder = fs::absolute(site).lexically_normal();
  return folder.has_filename() ? folder : folder.parent_path();
}

/// Others must not be able to read, change or replace anything.
void require_private(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw SiteError("cannot read " + path.string() + ": " + std::strerror(errno) + kRestore);
  if (status.st_uid != ::geteuid())
    throw SiteError(path.string() + " belongs to another user; choose your own folder with --site DIR");
  if ((status.st_mode & 077U) != 0)
    throw SiteError(path.string() + " is accessible to other users; restrict it with chmod -R go= " +
                    (fs::is_directory(path) ? path : path.parent_path()).string());
}

/// Before anything is said about who may open it: a wrong path must not lead to advice about somebody's
/// other files.
void require_site(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw NoSiteError(folder.string() + " is not a folder; choose one with --site DIR");
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".crt" || entry.path().extension() == ".key") return;
  throw NoSiteError(folder.string() +
                    (error ? " cannot be read (" + error.message() + ")"
                           : std::string(" is not a site: it contains neither certificates nor keys")) +
                    "; with --site DIR, choose another folder or one that does not exist yet");
}

fs::path made(const fs::path& site) {
  const fs::path folder = plain(site);
  if (!site_exists(folder)) {
    if (fs::exists(folder)) require_private(folder);
    make(folder);
  }
  require_site(folder);
  require_private(folder);
  return folder;
}

// gRPC says of a damaged file that the port is taken, or that the other side is to blame.

std::string read_certificate_of(const fs::path& folder, const std::string& stem) {
  const fs::path file = folder / (stem + ".crt");
  std::string text = read_site_file(file);
  if (!is_certificate(text))
    throw SiteError(file.string() + " is damaged: it contains no certificate" + kRestore);
  return text;
}

Certificate read_pair(const fs::path& folder, const std::string& stem) {
  const fs::path file = folder / (stem + ".key");
  Certificate out{read_certificate_of(folder, stem), read_site_file(file)};
  if (!is_key(out.key_pem))
    throw SiteError(file.string() + " is damaged: it contains no private key" + kRestore);
  if (!belong_together(out)) throw SiteError(file.string() + " does not match " + stem + ".crt" + kRestore);
  return out;
}

/// A host that was paired has what belongs to an operator, and nothing else.
void require_origin(const fs::path& folder) {
  if (fs::exists(folder / "authority.key") || !fs::exists(folder / "master.key")) return;
  throw SiteError(
      folder.string() +
      " was created by pairing, so it has certificates only for a master and its client, and no slave can use "
      "it; choose another folder with --site DIR");
}

}  // namespace

fs::path default_site() {
  const auto given = [](const char* name) {
    const char* value = std::getenv(name);
    // A relative one is ignored, as the XDG specification asks; it would mean another folder everywhere.
    return value != nullptr && *value == '/' ? std::string(value) : std::string();
  };
  if (const std::string config = given("XDG_CONFIG_HOME"); !config.empty())
    return fs::path(config) / "longreach";
  std::string home = given("HOME");
  if (const passwd* user = ::getpwuid(::geteuid()); home.empty() && user != nullptr) home = user->pw_dir;
  if (!home.empty()) return fs::path(home) / ".config" / "longreach";
  throw SiteError(
      "neither XDG_CONFIG_HOME nor HOME is an absolute path; give the certificate folder with --site DIR");
}

std::string file_stem(RpcRole role) {
  const std::string_view name = name_of(role);
  return std::string(name.substr(0, name.find('.')));
}

std::string read_site_file(const fs::path& file) {
  require_private(file);
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().empty()) throw SiteError("cannot read " + file.string() + kRestore);
  return text.str();
}

RpcCredentials site_credentials(const fs::path& site, RpcRole role) {
  const fs::path folder = made(site);
  if (role == RpcRole::kSlave) require_origin(folder);
  const std::string stem = file_stem(role);
  const Certificate own = read_pair(folder, stem);
  return {read_certificate_of(folder, "authority"), own.certificate_pem, own.key_pem};
}

Certificate site_authority(const fs::path& site) {
  const fs::path folder = made(site);
  require_origin(folder);
  return read_pair(folder, "authority");
}

bool site_exists(const fs::path& site) {
  std::error_code error;
  const fs::path folder = plain(site);
  return fs::exists(fs::symlink_status(folder, error)) &&
         !(fs::is_directory(folder, error) && fs::is_empty(folder, error));
}

fs::path write_site(const fs::path& site, const SiteFiles& files) {
  const fs::path folder = plain(site);
  const fs::path whole = draft(folder, files);
  std::error_code error;
  fs::path aside;
  if (site_exists(folder)) {
    for (int i = 1; aside.empty() || fs::exists(aside); ++i)
      aside = folder.string() + ".before-" + std::to_string(i);
    fs::rename(folder, aside, error);
  }
  if (!error) fs::rename(whole, folder, error);
  if (!error) return aside;
  const std::string why = error.message();
  fs::remove_all(whole, error);
  throw SiteError("cannot create " + folder.string() + ": " + why +
                  "; choose another folder with --site DIR");
}

}  // namespace longreach
