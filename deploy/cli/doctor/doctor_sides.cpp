#include <algorithm>
#include <asio/connect.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <cmath>
#include <thread>

#include "common/site/rpc_security.hpp"
#include "common/site/site.hpp"
#include "common/text/number_text.hpp"
#include "deploy/cli/doctor/doctor_checks.hpp"
#include "deploy/cli/doctor/doctor_probe.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kSamplePeriod = std::chrono::milliseconds(100);
constexpr double kSilence_s = 1.0;  // after which a master may lose the robot
constexpr double kLoss = 0.1;
constexpr std::string_view kOtherSenders = "strangers";  // the counter of such datagrams

std::string host_of(const std::string& address) { return address.substr(0, address.rfind(':')); }
std::string port_of(const std::string& address) { return address.substr(address.rfind(':') + 1); }

std::uint64_t counter(const proto::Status& status, std::string_view name) {
  for (const auto& one : status.counters())
    if (one.name() == name) return one.count();
  return 0;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// What was measured of a side during the measurement.
struct Watched {
  proto::Status first, last;
  double between_s = 0.0;    // from the first to the last
  double connected_s = 0.0;  // time for connecting and the first response
  std::vector<double> rpc_s{}, udp_s{};
};

Watched watch(SideClient& client, double seconds) {
  Watched out;
  const auto opened = Clock::now();
  out.first = out.last = client.status();  // connects
  const auto began = Clock::now();
  out.connected_s = std::chrono::duration<double>(began - opened).count();
  do {
    const auto asked = Clock::now();
    out.last = client.status();
    out.rpc_s.push_back(std::chrono::duration<double>(Clock::now() - asked).count());
    if (out.last.link().rtt_known()) out.udp_s.push_back(out.last.link().rtt_s());
    std::this_thread::sleep_until(asked + kSamplePeriod);
  } while (std::chrono::duration<double>(Clock::now() - began).count() < seconds);
  out.between_s = out.last.uptime_s() - out.first.uptime_s();
  return out;
}

Finding not_running(Side side, const std::string& address) {
  const std::string program = "longreach-" + std::string(name_of(side));
  if (is_loopback(address))
    return {FindingVerdict::kWarning, "RPC", "no program is listening at " + address + " on this machine",
            "start " + program + ", or give its address with --" + std::string(name_of(side)) + " HOST:PORT"};
  return {FindingVerdict::kFailure, "RPC", "no response from " + address,
          "start " + program +
              " there, with rpc.listen set to an address that this host can reach (not 127.0.0.1), and "
              "allow TCP port " +
              port_of(address) + " through the firewalls"};
}

/// Reports why a side could not be queried.
Finding unanswered(Side side, const std::string& address, const SideError& error) {
  if (error.kind() == SideError::Kind::kAbsent) return not_running(side, address);
  return {FindingVerdict::kFailure, "RPC", error.what(),
          "if longreach-" + std::string(name_of(side)) +
              " is not running there, find the program that uses the port with ss -ltnp 'sport = :" +
              port_of(address) + "'"};
}

Finding rpc_finding(const Watched& seen, bool insecure) {
  const double response_s = median(seen.rpc_s);
  return {FindingVerdict::kOk, "RPC",
          std::string(insecure ? "responds, without encryption"
                               : "responds, with a certificate of the same site") +
              "; the first call took " + with_unit(seen.connected_s, "s") +
              " with its connection, each further call takes " + with_unit(response_s, "s") + " (median)",
          "", histogram_of(seen.rpc_s)};
}

Finding version_finding(const proto::Status& status) {
  if (status.version() == LONGREACH_VERSION)
    return {FindingVerdict::kOk, "version", status.version() + ", the same as this program"};
  return {FindingVerdict::kFailure, "version",
          "this side has version " + status.version() + ", this program has version " LONGREACH_VERSION,
          "install the same version on all hosts"};
}

Finding state_finding(const proto::Status& status) {
  std::string text = status.state() + (status.cause().empty() ? "" : " (" + status.cause() + ")");
  if (!status.trouble().empty()) return {FindingVerdict::kFailure, "session", text + "; " + status.trouble()};
  if (!status.refusal().empty())
    return {FindingVerdict::kFailure, "engagement", text + "; " + status.refusal()};
  if (status.side() == "slave")
    text += status.lease().empty() ? "; no master has control of the robot"
                                   : "; the robot is controlled by the master at " + status.lease();
  if (status.state() == "Fault")
    return {FindingVerdict::kFailure, "state", text, "find the reason in this side's log, then engage"};
  return {FindingVerdict::kOk, "state", text};
}

/// For a slave that derives its touch threshold.
Finding sensor_finding(const proto::Status& status) {
  const std::string& warning = status.sensor_warning();
  if (warning.empty()) return {FindingVerdict::kOk, "force sensor", status.sensor()};
  const auto advice = warning.rfind("; ");
  return {FindingVerdict::kWarning, "force sensor", warning.substr(0, advice), warning.substr(advice + 2)};
}

Finding reduced_finding(const std::string& sentence) {
  return {FindingVerdict::kWarning, "reduced protection", sentence,
          "change the setting, unless the hardware requires it; operating.md lists all cases"};
}

Finding loop_finding(const Watched& seen, double wanted_hz) {
  const proto::Status& status = seen.last;
  const auto ticks = static_cast<double>(counter(status, "ticks") - counter(seen.first, "ticks"));
  const double achieved_hz = seen.between_s > 0.0 ? ticks / seen.between_s : 0.0;
  const double missed = static_cast<double>(counter(status, "missed_ticks"));
  const double all = missed + static_cast<double>(counter(status, "ticks"));
  const double p99_s = 1e-6 * static_cast<double>(counter(status, "lateness_p99_us"));
  const std::uint64_t very_late = counter(status, "ticks_late_100ms");
  Finding out{FindingVerdict::kOk, "loop",
              format_number(std::round(achieved_hz)) + " of " + format_number(wanted_hz) +
                  " Hz; 99 % of ticks late by at most " + with_unit(p99_s, "s") + ", worst " +
                  with_unit(1e-6 * static_cast<double>(counter(status, "lateness_max_us")), "s") + ", " +
                  format_number(missed) + " missed, " + std::to_string(very_late) + " late by over 100 ms"};
  for (int i = 0; i < status.lateness_size(); ++i) {
    if (out.histogram.bars.empty() && status.lateness(i) == 0) continue;
    out.histogram.bars.push_back({1e-6 * std::exp2(i), status.lateness(i)});
  }
  constexpr const char* kAdvice =
      "compare with the bare loop below: if its ticks are late too, the machine is busy or real-time "
      "priority is not permitted; otherwise lower loop.rate_hz";
  if (achieved_hz < 0.9 * wanted_hz) {
    out.verdict = FindingVerdict::kFailure;
    out.advice = kAdvice;
  } else if (very_late > 0 || missed > 0.01 * all || p99_s > 1.0 / wanted_hz) {
    out.verdict = FindingVerdict::kWarning;
    out.advice = kAdvice;
  }
  return out;
}

Finding link_finding(const Watched& seen, Side side) {
  const proto::Figures& link = seen.last.link();
  const std::string other = side == Side::kMaster ? "the slave" : "a master";
  if (link.silence_s() < 0.0)
    return {side == Side::kMaster ? FindingVerdict::kFailure : FindingVerdict::kOk, "link",
            "no datagram received from " + other + " yet"};
  if (side == Side::kSlave && seen.last.lease().empty())
    return {FindingVerdict::kOk, "link", "idle: no master is connected"};
  if (link.silence_s() > kSilence_s)
    return {FindingVerdict::kFailure, "link",
            "no datagram received from " + other + " for " + with_unit(link.silence_s(), "s"),
            "check that it is running and that its UDP datagrams can reach this side"};
  std::string text =
      "round trip " + (link.rtt_known() ? with_unit(link.rtt_s(), "s") : std::string("not yet known"));
  text += ", jitter " + with_unit(link.jitter_s(), "s") + ", loss " +
          format_number(std::round(1e3 * link.loss()) / 10) + " %, " +
          format_number(std::round(link.rate_hz())) + " datagrams/s";
  if (const std::string artificial = in_words(seen.last.impairment()); artificial != "none")
    text += "; artificial: " + artificial;
  Finding out{FindingVerdict::kOk, "link", text, "", histogram_of(seen.udp_s)};
  if (link.loss() > kLoss) {
    out.verdict = FindingVerdict::kWarning;
    out.advice = "lost datagrams delay the motion: if the link has too little bandwidth, lower link.send_hz";
  }
  return out;
}

/// Datagrams from other addresses while the side is measured; its own probe comes later.
Finding other_senders_finding(const Watched& seen) {
  const std::uint64_t others = counter(seen.last, kOtherSenders) - counter(seen.first, kOtherSenders);
  return {
      FindingVerdict::kWarning, "other senders",
      std::to_string(others) + " datagrams arrived from addresses other than link.slave; they had no effect",
      "if they come from the slave, set link.slave to the address from which it sends, or remove the address "
      "translation on the path"};
}

Finding refusals_finding(const proto::Status& status) {
  const std::uint64_t rpc = counter(status, "rpc_refused"),
                      forged = counter(status, "rejected_authentication");
  if (rpc + forged == 0) return {FindingVerdict::kOk, "intruders", "none"};
  return {FindingVerdict::kWarning, "intruders",
          std::to_string(rpc) + " connections or calls were refused and " + std::to_string(forged) +
              " forged or corrupted datagrams were rejected; they had no effect",
          "this side's log lists the times and reasons (rpc refused=...)"};
}

std::string unquoted(std::string text) {
  std::erase_if(text, [](char c) { return c == '"' || c == '\n'; });
  return text;
}

/// Returns the address at which the side receives datagrams, as seen from this host. Empty if it is unknown
/// or any free port.
std::string link_address(SideClient& client, const std::string& rpc) {
  const std::string listen = unquoted(client.get("link.listen"));
  const std::string host = host_of(listen);
  if (port_of(listen) == "0" || host.empty()) return "";
  return (host == "0.0.0.0" || host == "[::]" ? host_of(rpc) : host) + ":" + port_of(listen);
}

Finding datagram_finding(Side side, SideClient& client, const std::string& address, const std::string& rpc) {
  if (is_loopback(address) && !is_loopback(rpc))
    return {FindingVerdict::kFailure, "datagrams",
            "it accepts datagrams only from its own machine, at " + address,
            "start it with --set link.listen=0.0.0.0:" + port_of(address)};
  // The slave rejects the probe datagrams because of their version, the master because they do not come from
  // the slave. Each case has its own counter.
  const std::string name = side == Side::kSlave ? "rejected_version" : std::string(kOtherSenders);
  const proto::Status before = client.status();
  const double wait_s = 2.0 + before.impairment().delay_s();
  const Probe probe = send_probe(address);
  std::uint64_t arrived = 0;
  for (const auto until = Clock::now() + std::chrono::duration<double>(wait_s);
       Clock::now() < until && arrived < probe.sent;) {
    arrived = std::min(counter(client.status(), name) - counter(before, name), probe.sent);
    if (arrived < probe.sent) std::this_thread::sleep_for(kSamplePeriod);
  }
  const std::string mtu = probe.mtu > 0 ? "; path MTU " + std::to_string(probe.mtu) : "";
  if (arrived > 0)
    return {FindingVerdict::kOk, "datagrams",
            std::to_string(arrived) + " of " + std::to_string(probe.sent) +
                " datagrams of 508 bytes arrived at " + address + mtu};
  return {FindingVerdict::kFailure, "datagrams",
          "none of " + std::to_string(probe.sent) + " datagrams of 508 bytes arrived at " + address + mtu +
              (probe.error.empty() ? "" : " (" + probe.error + ")"),
          "allow UDP port " + port_of(address) +
              " through the firewalls; the path needs an MTU of at least 536, because datagrams are not "
              "fragmented"};
}

void examine_running(Section& out, Side side, SideClient& client, const std::string& rpc, bool insecure,
                     double seconds) {
  const Watched seen = watch(client, seconds);
  const double wanted_hz = parse_number(unquoted(client.get("loop.rate_hz"))).value_or(0.0);
  out.findings.push_back(rpc_finding(seen, insecure));
  out.findings.push_back(version_finding(seen.last));
  out.findings.push_back(state_finding(seen.last));
  if (seen.last.has_sensor() && !seen.last.sensor().empty())
    out.findings.push_back(sensor_finding(seen.last));
  for (const std::string& sentence : seen.last.reduced_protection())
    out.findings.push_back(reduced_finding(sentence));
  if (seen.last.has_approach_m_per_s())
    out.findings.push_back({FindingVerdict::kOk, "approach",
                            "limited to " + format_number(std::round(1e3 * seen.last.approach_m_per_s())) +
                                " mm/s: unknown space"});
  out.findings.push_back(loop_finding(seen, wanted_hz));
  out.findings.push_back(link_finding(seen, side));
  if (const std::string address = link_address(client, rpc); !address.empty())
    out.findings.push_back(datagram_finding(side, client, address, rpc));
  if (counter(seen.last, kOtherSenders) > counter(seen.first, kOtherSenders))
    out.findings.push_back(other_senders_finding(seen));
  out.findings.push_back(refusals_finding(seen.last));
}

/// Checks the default port of the slave's datagrams if the slave is not running.
void examine_free_port(Section& out) {
  constexpr const char* kLink = "127.0.0.1:47001";
  if (!udp_port_taken(kLink)) return;
  out.findings.push_back(
      {FindingVerdict::kFailure, "datagrams",
       std::string("another program is using the UDP port of ") + kLink,
       "find that program with ss -ulnp 'sport = :47001' and stop it, or choose another port with "
       "link.listen"});
}

}  // namespace

Section examine_side(Side side, const Options& options, double seconds) {
  const std::string& address = side == Side::kMaster ? options.master_address : options.slave_address;
  Section out{(side == Side::kMaster ? "Master at " : "Slave at ") + address};
  const auto site = options.site.empty() ? default_site() : std::filesystem::path(options.site);
  // A client would create the site folder, so this is checked first.
  if (!options.insecure && !site_exists(site)) {
    out.findings.push_back(takes_connections(address)
                               ? Finding{FindingVerdict::kFailure, "RPC",
                                         "a program is listening there, but this host has no certificates",
                                         "pair this host with the slave: longreach pair"}
                               : not_running(side, address));
    return out;
  }
  try {
    SideClient client(side, options);
    examine_running(out, side, client, address, options.insecure, seconds);
  } catch (const SiteError&) {
    out.findings.push_back(
        {FindingVerdict::kFailure, "RPC", "not queried, because the site folder is unusable (see above)"});
  } catch (const SideError& error) {
    out.findings.push_back(unanswered(side, address, error));
    if (side == Side::kSlave && is_loopback(address) &&
        out.findings.back().verdict == FindingVerdict::kWarning)
      examine_free_port(out);
  } catch (const std::runtime_error& error) {
    out.findings.push_back({FindingVerdict::kFailure, "RPC", error.what()});
  }
  return out;
}

}  // namespace longreach
