#pragma once
// The longer help texts of the command line, and the options of `link set` with the fields that they set.

#include <array>

namespace longreach {

inline constexpr const char* kIntroduction =
    R"(longreach shows and changes a running teleoperation system: the master at the operator, and the slave at the
robot. It connects to longreach-master and longreach-slave, which must be running.)";
inline constexpr const char* kExits =
    R"(Exit status: 0 done; 1 refused, or a side does not answer; 2 invalid usage or value (nothing changed).
With --json every answer is one JSON object on one line, with the field names of proto/control.proto:
  status, watch  {"master": {...}, "slave": {...}}; null for a side that is down, and then "error"
  get            {"text": "..."}
  link show      {"up": {...}, "down": {...}}
  record list    {"recordings": [{...}]}
  other commands {"done": "..."}
  every failure  {"error": "..."}
Example: longreach status)";

inline constexpr const char* kLinkSetMore =
    R"(A profile replaces all fields of a direction; options change single fields, also of a profile in the same command.
Either both directions change, or none. TIME is 650ms, 1.3s, 20us or plain seconds; FRACTION is 2% or 0.02.
--delay is the one-way delay of each affected direction: 650ms in both directions give a round trip of 1.3 s.
Example: longreach link set --delay 650ms --loss 2%)";

inline constexpr const char* kStatusMore =
    R"(Shows the state of both sides, the link between them (round trip; jitter and loss as each side receives),
motion, contact, force and all non-zero counters. Exit status 1 if a side does not answer.
Example: longreach status --json)";

inline constexpr const char* kWatchMore =
    R"(Redraws the status in colour on a terminal, without colour if NO_COLOR is set; prints one line per update elsewhere.
Ctrl-C ends the command with status 0.
Example: longreach watch --hz 10)";

inline constexpr const char* kPairMore =
    R"(Creates the site folder of this host: the keys of a master and its client, certified by the site of the slave.
longreach-slave --pair prints the token and this command at the slave. Enter the token at the prompt; an argument would
be readable by other users. --list shows the hosts that were paired with the site of this host.
Example: longreach pair --slave 192.0.2.7:47021)";

inline constexpr const char* kUnpairMore =
    R"(From now on the certificates of the host are refused, for new calls and for calls in progress; if its master has control
of the robot, the robot holds. This affects the programs that use this site folder, on this host. Other hosts of the site
are not notified: if a master runs on another host, run the command there with the printed fingerprints.
Example: longreach unpair station-2)";

inline constexpr const char* kDoctorMore =
    R"(Checks the site folder and certificates of this host, both sides (ports, version, loop, link, round trips) and
this machine (clock, real-time permissions, a bare loop). Changes nothing.
Exit status 1 if a check failed; warnings are not failures.
Example: longreach doctor --slave 192.0.2.7:47020)";

inline constexpr const char* kAdapterCheckMore =
    R"(Sends valid and invalid datagrams to the adapter for ten seconds: rate, sequence, watchdog, garbage, restarts.
longreach must not be connected to the adapter meanwhile. THE DEVICE PUSHES with --force along z: hold it or keep clear;
it must report its force in force_n. A robot is commanded to stay in place; with --move THE ROBOT MOVES its first joint.
--push instead prompts you to push the tool of the robot along x, y, z of its base and to turn it about them, and reports
errors of the force sensor: sign, axes, frame of the base instead of the tool, weight, a dead channel, joints in degrees.
Exit status 1 if a rule is violated; each line then gives a remedy. The rules: common/link/adapter_datagram.hpp.
Example: longreach adapter check --robot unix:/run/user/1000/robot --move 0.01)";

inline constexpr const char* kSetMore =
    R"(proto/config.proto lists fields, units and ranges. Some fields cannot be changed while engaged, some only at start.
The limits at the start of a side are upper bounds: they can only be tightened.
`longreach get` marks the fields that may be set; a refusal gives the reason.
Example: longreach set slave estimator.forgetting 0.995 estimator.deadband 5%)";

inline constexpr const char* kViewMore =
    R"(Prints the address of the page and serves it until Ctrl-C: arm and scene as reported by the slave, the commanded
pose, forces, plots, controls. One page at a time has the hand and may act; all pages may observe and stop.
The address contains a token that changes with every start. A user with the address can act, so keep it secret. The
page is not encrypted: across an untrusted network (--listen 0.0.0.0:8080) use ssh -L instead.
Example: longreach view)";

/// An option of `link set` and the field of proto::Impairment that it sets.
struct FieldOption {
  const char* name;
  const char* field;
  const char* value;
  const char* help;
};
inline constexpr auto kFieldOptions = std::to_array<FieldOption>({
    {"--delay", "delay_s", "TIME", "one-way delay (0 to 100 s)"},
    {"--jitter", "jitter_s", "TIME", "standard deviation of the one-way delay (0 to 10 s)"},
    {"--loss", "loss", "FRACTION", "mean fraction of datagrams lost (0 to 1)"},
    {"--loss-burst", "loss_burst", "N",
     "mean length of a loss burst, datagrams; 1: independent losses (1 to 1000)"},
    {"--duplicate", "duplicate", "FRACTION", "fraction sent twice (0 to 1)"},
    {"--reorder", "reorder", "FRACTION", "fraction let past its predecessors (0 to 1)"},
    {"--corrupt", "corrupt", "FRACTION", "fraction with one bit flipped (0 to 1)"},
    {"--rate", "rate_bit_per_s", "BITS", "rate limit, bit/s; 0: unlimited (0 to 1e12)"},
});

}  // namespace longreach
