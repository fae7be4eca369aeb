// Adds this host to the site of another host, lists the hosts paired with this one's site, and revokes them.

#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "common/rpc/pairing_rpc.hpp"
#include "common/site/revocations.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"

namespace longreach {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::filesystem::path site_of(const Options& options) {
  return options.site.empty() ? default_site() : std::filesystem::path(options.site);
}

/// Switches off the echo of the terminal during its lifetime, if there is a terminal.
class Silence {
 public:
  Silence() : known_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!known_) return;
    termios silent = before_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  ~Silence() {
    if (known_) (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  termios before_{};
  bool known_;
};

std::string first_line(std::istream& in) {
  std::string line;
  std::getline(in, line);
  return line.substr(0, 256);
}

std::string read_token_file(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw UsageError("--token-file " + file + " cannot be read");
  if (S_ISREG(status.st_mode) && (status.st_mode & 077U) != 0)
    throw UsageError("--token-file " + file +
                     " is accessible to other users; restrict it with chmod go= " + file);
  std::ifstream in(file);
  return first_line(in);
}

std::string read_token(const std::string& file) {
  if (!file.empty() && file != "-") return read_token_file(file);
  if (::isatty(STDIN_FILENO) == 0) return first_line(std::cin);
  std::cerr << "Token: " << std::flush;
  const Silence silence;
  const std::string token = first_line(std::cin);
  std::cerr << "\n";
  return token;
}

/// Quotes a text for a shell.
std::string shell_word(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=:@%,";
  if (text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string to_json(const PairedCertificate& one) {
  return "{\"host\":" + json_string(one.host) + ",\"role\":" + json_string(one.role) +
         ",\"since\":" + json_string(one.since) + ",\"expires\":" + json_string(one.expires) +
         ",\"revoked\":" + (one.revoked ? "true" : "false") +
         ",\"fingerprint\":" + json_string(one.fingerprint) + "}";
}

ExitStatus list_paired(const Options& options) {
  const auto paired = paired_certificates(site_of(options));
  if (options.json) {
    std::string all;
    for (const PairedCertificate& one : paired) all += (all.empty() ? "" : ",") + to_json(one);
    std::cout << "{\"paired\":[" << all << "]}\n";
    return ExitStatus::kDone;
  }
  if (paired.empty()) std::cout << "no host is paired with " << site_of(options).string() << "\n";
  for (const PairedCertificate& one : paired)
    std::cout << one.host << "  " << one.role << "  since " << one.since << "  expires " << one.expires
              << "  " << (one.revoked ? "revoked  " : "") << one.fingerprint << "\n";
  return ExitStatus::kDone;
}

}  // namespace

ExitStatus run_unpair(const Options& options, const UnpairCommand& command) {
  const std::vector<std::string> gone = revoke(site_of(options), command.names);
  std::string all;
  for (const std::string& one : gone) all += " " + one;
  print_done(options, "revoked: programs that use the site " + site_of(options).string() +
                          " refuse these certificates from now on; on every other host that runs a master of "
                          "this site, run longreach unpair" +
                          all);
  return ExitStatus::kDone;
}

ExitStatus run_pair(const Options& options, const PairCommand& command) {
  if (command.list) return list_paired(options);
  const std::filesystem::path site = site_of(options);
  // Checked before the token is used up.
  if (site_exists(site) && !command.replace)
    throw PairingError("this host already has a site at " + site.string() +
                       "; move it aside with --replace, or choose another folder with --site DIR");
  const std::string text = read_token(command.token_file);
  if (text.find_first_not_of(" \t\r") == std::string::npos)
    throw UsageError(
        "the token is missing, because the input is empty: enter the token that longreach-slave "
        "--pair printed, or give a file that contains it with --token-file");
  const auto token = PairingToken::parse(text);
  if (!token)
    throw UsageError(
        "the token is invalid: enter the 24 letters and digits that longreach-slave --pair printed");
  const PairingRequest request(*token, host_name());
  if (!options.json) std::cerr << "requesting certificates from " << options.slave_address << " ...\n";
  const auto answer = ask_to_join(options.slave_address, request, options.timeout_s);
  const std::filesystem::path aside = write_site(site, request.accept(answer));
  std::string done =
      "paired: " + site.string() + " now belongs to the site of the slave at " + options.slave_address;
  if (!aside.empty()) done += "; the previous folder was moved to " + aside.string();
  print_done(options, done);
  if (!options.json) {
    const std::string host = options.slave_address.substr(0, options.slave_address.rfind(':'));
    const std::string with = options.site.empty() ? "" : " --site " + shell_word(site.string());
    std::cout << "Next, if the slave uses its default ports:\n"
              << "  longreach --slave " << host << ":47020" << with << " status\n"
              << "  longreach-master --set link.slave=" << host << ":47001" << with << "\n";
  }
  return ExitStatus::kDone;
}

}  // namespace longreach
