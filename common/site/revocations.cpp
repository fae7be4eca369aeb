#include "common/site/revocations.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>

#include "common/site/site.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kKind = "SHA256:";
constexpr std::size_t kFingerprint = kKind.size() + 64;

std::string now_text() {
  const std::time_t now = std::time(nullptr);
  std::tm time{};
  ::gmtime_r(&now, &time);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &time)};
}

bool is_fingerprint(const std::string& word) {
  return word.size() == kFingerprint && word.starts_with(kKind) &&
         word.find_first_not_of("0123456789abcdef", kKind.size()) == std::string::npos;
}

/// All of it is on the disk, or an exception says that it is not.
void append(const fs::path& file, const std::string& lines) {
  const int at = ::open(file.c_str(), O_CREAT | O_APPEND | O_WRONLY | O_CLOEXEC, 0600);
  const bool done = at >= 0 &&
                    ::write(at, lines.data(), lines.size()) == static_cast<ssize_t>(lines.size()) &&
                    ::fsync(at) == 0;
  const int error = errno;
  if (at >= 0) ::close(at);
  if (!done)
    throw SiteError("cannot write " + file.string() + ": " + std::strerror(error) +
                    "; free space on the disk, or make the folder writable, and try again");
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> out;
  std::error_code error;
  if (!fs::exists(file) || fs::file_size(file, error) == 0) return out;
  std::istringstream in(read_site_file(file));
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) out.push_back(line);
  return out;
}

/// The value of key=value in a line; empty: there is none.
std::string value_of(const std::string& line, const std::string& key) {
  std::istringstream words(line);
  for (std::string word; words >> word;)
    if (word.starts_with(key + "=")) return word.substr(key.size() + 1);
  return "";
}

std::set<std::string> revoked_in(const fs::path& site) {
  std::set<std::string> out;
  for (const std::string& line : lines_of(site / "revoked")) {
    const std::string word = line.substr(0, line.find(' '));
    if (!is_fingerprint(word))
      throw SiteError(
          (site / "revoked").string() +
          " is damaged: a line does not begin with a fingerprint; remove this line, and revoke the "
          "affected certificate again with longreach unpair");
    out.insert(word);
  }
  return out;
}

/// The program's list, read again when the file has changed.
class Revoked {
 public:
  void watch(const fs::path& site) {
    const std::lock_guard lock(mutex_);
    list_ = revoked_in(site);
    site_ = site;
    seen_ = stamp();
  }
  bool has(const std::string& fingerprint) {
    const std::lock_guard lock(mutex_);
    if (!site_) return false;
    if (const Stamp now = stamp(); now != seen_) read(now);
    return list_.contains(fingerprint);
  }

 private:
  struct Stamp {
    std::int64_t size = -1, s = 0, ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] Stamp stamp() const {
    struct stat status {};
    if (::stat((*site_ / "revoked").c_str(), &status) != 0) return {};
    return {status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
  }
  void read(const Stamp& now) {
    try {
      list_.merge(revoked_in(*site_));  // who was revoked while this program runs stays so
      seen_ = now;
    } catch (const std::exception&) {
      // It is read again at the next call; what was revoked before stays revoked.
    }
  }

  std::mutex mutex_;
  std::optional<fs::path> site_;
  std::set<std::string> list_;
  Stamp seen_{};
};

Revoked& revoked() {
  static Revoked one;
  return one;
}

}  // namespace

namespace {

/// Two hosts may have the same name; a host that was paired twice has two pairings, too.
void refuse_ambiguous(const std::vector<PairedCertificate>& paired, const std::string& name) {
  std::string pairings;
  int count = 0;
  for (const PairedCertificate& one : paired) {
    if (one.host != name || one.revoked) continue;
    // A pairing issues the certificate of the master first.
    if (one.role == "master") ++count, pairings += "; paired since " + one.since + ":";
    pairings += " " + one.fingerprint;
  }
  if (count > 1)
    throw SiteError(std::to_string(count) + " pairings have the name " + name +
                    "; give the fingerprints of the certificates to revoke instead" + pairings);
}

}  // namespace

void record_pairing(const fs::path& site, const std::string& host, const std::string& master_pem,
                    const std::string& client_pem) {
  const auto line = [&](const char* role, const std::string& pem) {
    return "host=" + host + " role=" + role + " since=" + now_text() + " expires=" + valid_until(pem) +
           " fingerprint=" + fingerprint(pem) + "\n";
  };
  append(site / "paired", line("master", master_pem) + line("client", client_pem));
}

std::vector<PairedCertificate> paired_certificates(const fs::path& site) {
  const std::set<std::string> no_more = revoked_in(site);
  std::vector<PairedCertificate> out;
  for (const std::string& line : lines_of(site / "paired")) {
    PairedCertificate one{value_of(line, "host"),    value_of(line, "role"),        value_of(line, "since"),
                          value_of(line, "expires"), value_of(line, "fingerprint"), false};
    one.revoked = no_more.contains(one.fingerprint);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<std::string> revoke(const fs::path& site, const std::vector<std::string>& names) {
  const std::vector<PairedCertificate> paired = paired_certificates(site);
  std::vector<std::string> out;
  for (const std::string& name : names) {
    const std::size_t before = out.size();
    if (is_fingerprint(name)) out.push_back(name);
    refuse_ambiguous(paired, name);
    for (const PairedCertificate& one : paired)
      if (one.host == name) out.push_back(one.fingerprint);
    if (out.size() == before)
      throw SiteError("no host " + name + " was paired with " + site.string() +
                      "; longreach pair --list lists the paired hosts");
  }
  std::string lines;
  for (const std::string& one : out) lines += one + " since=" + now_text() + "\n";
  append(site / "revoked", lines);
  return out;
}

void refuse_revoked(const fs::path& site) { revoked().watch(site); }

bool is_revoked(const std::string& fingerprint) { return revoked().has(fingerprint); }

}  // namespace longreach
