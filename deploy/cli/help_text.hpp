#pragma once
// The longer help texts of the command line, and the options of `link set` with the fields they set.

#include <array>

namespace longreach {

inline constexpr const char* kIntroduction =
    R"(longreach shows and changes the state of a running teleoperation system, which consists of a master on the
operator's side and a slave on the robot's side. It connects to longreach-master and longreach-slave, which must be
running.)";
inline constexpr const char* kExits =
    R"(Exit status: 0 on success, 1 if a request is refused or a side does not respond, 2 if an option or
value is invalid (nothing is changed).
With --json every result is one JSON object on one line, with the field names of proto/control.proto:
  status, watch  {"master": {...}, "slave": {...}}; null for a side that does not respond, plus "error";
                 "age_s": {"master": 0.001, "slave": 1.3}: how old the values are
  get            {"text": "..."}
  link show      {"up": {...}, "down": {...}}
  record list    {"recordings": [{...}]}
  other commands {"done": "..."}
  every failure  {"error": "..."}
Example: longreach status)";

inline constexpr const char* kLinkSetMore =
    R"(A profile replaces all fields of a direction; options change individual fields, or override fields of
--profile. Either both directions change or neither does. Write TIME as 650ms, 1.3s, 20us or plain seconds, and FRACTION
as 2% or 0.02. --delay is the one-way delay of each affected direction: 650ms in both directions gives a round trip
of 1.3 s. A profile also delays calls to the slave, except those of this command.
Example: longreach link set --delay 650ms --loss 2%)";

inline constexpr const char* kStatusMore =
    R"(Shows the state of both sides, the link between them (round trip, and the jitter and loss that each side
measures), motion, contact, force and all non-zero counters. The exit status is 1 if a side does not respond.
Example: longreach status --json)";

inline constexpr const char* kWatchMore =
    R"(On a terminal, redraws the status in colour, or without colour if NO_COLOR is set. Otherwise prints one
line per update. Ctrl-C ends the command with exit status 0.
Example: longreach watch --hz 10)";

inline constexpr const char* kPairMore =
    R"(Creates the site folder of this host: the keys of a master and its client, certified by the slave's
site. On the slave's host, longreach-slave --pair prints the token and this command. Enter the token at the prompt; an
argument would be readable by other users. --list shows the hosts paired with this host's site.
Example: longreach pair --slave 192.0.2.7:47021)";

inline constexpr const char* kUnpairMore =
    R"(Once the certificates are revoked, new calls that use them are refused and calls in progress end; if the master of
the paired host has control of the robot, the robot holds. The revocation affects only the programs on this host that
use this site folder. Other hosts of the site are not notified: if a master runs on another host, run the command there
too, with the printed fingerprints.
Example: longreach unpair station-2)";

inline constexpr const char* kDoctorMore =
    R"(Checks the site folder and certificates of this host, both sides (ports, version, loop, link, round
trips) and this machine (clock, real-time permissions, timing of an empty loop). It changes nothing. The exit
status is 1 if a check failed; warnings are not failures.
Example: longreach doctor --slave 192.0.2.7:47020)";

inline constexpr const char* kSetMore =
    R"(proto/config_*.proto list fields, units and ranges. Some fields cannot be changed while the robot is engaged;
others can be set only at start. The limits with which a side was started can only be tightened. `longreach get`
marks the fields that may be set; if a change is refused, the reason is printed.
Example: longreach set slave estimator.forgetting 0.995 estimator.deadband 5%)";

inline constexpr const char* kViewMore =
    R"(Prints the address of the page and serves the page until Ctrl-C. The page shows the arm and the scene as
reported by the slave, the commanded pose, the forces and plots, and it has controls for the robot. Only one page at
a time has control and may move the robot; every page may observe and stop it. The address contains a token that
changes with every start. Every user who knows the address can move the robot, so keep it secret. The page is not
encrypted: across an untrusted network use ssh -L, not --listen 0.0.0.0:8080.
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
    {"--duplicate", "duplicate", "FRACTION", "fraction of datagrams duplicated (0 to 1)"},
    {"--reorder", "reorder", "FRACTION", "fraction of datagrams that overtake earlier ones (0 to 1)"},
    {"--corrupt", "corrupt", "FRACTION", "fraction of datagrams with one bit flipped (0 to 1)"},
    {"--rate", "rate_bit_per_s", "BITS", "rate limit, bit/s; 0: unlimited (0 to 1e12)"},
    {"--rpc", "rpc_delay_s", "TIME", "round trip of calls to the slave (0 to 10 s)"},
});

}  // namespace longreach
