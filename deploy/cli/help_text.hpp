#pragma once
// The longer texts of the command line's help, and the options of `link set` with the fields that they set.

#include <array>

namespace longreach {

inline constexpr const char* kIntroduction =
    R"(longreach shows and changes a running teleoperation: the master, where the hand is, and the slave, where
the robot is. It talks to longreach-master and longreach-slave, which have to be started first.)";
inline constexpr const char* kExits =
    R"(Exit status: 0 done; 1 refused, or a side does not answer; 2 bad usage or a bad value (nothing changed).
With --json every answer is one JSON object on one line, with the field names of proto/control.proto:
  status, watch  {"master": {...}, "slave": {...}}; null for a side that is down, and then "error"
  get            {"text": "..."}
  link show      {"up": {...}, "down": {...}}; likewise
  record list    {"recordings": [{...}]}
  other commands {"done": "..."}
  every failure  {"error": "..."}
Example: longreach status)";

inline constexpr const char* kLinkSetMore =
    R"(A profile replaces the whole direction, options change single fields (also of a profile named with them).
Both directions change, or none. TIME is 650ms, 1.3s, 20us or plain seconds; FRACTION is 2% or 0.02.
--delay is the one-way delay of each direction that it is applied to: 650ms in both make a round trip of 1.3 s.
Example: longreach link set --delay 650ms --loss 2%)";

inline constexpr const char* kStatusMore =
    R"(Shows the state of both sides, the link between them (round trip; jitter and loss as each side receives),
motion, contact, force and all counts that are not zero. Exit status 1 if a side does not answer.
Example: longreach status --json)";

inline constexpr const char* kWatchMore =
    R"(Redraws in colour on a terminal, without colour where NO_COLOR is set; writes one line an update elsewhere.
Ctrl-C ends it, with status 0.
Example: longreach watch --hz 10)";

inline constexpr const char* kPairMore =
    R"(Makes this host's site folder: the keys of a master and its client, which that slave's site certifies.
longreach-slave --pair prints the token there, and the command; the token is typed when it is asked for, never given in
the arguments, which other users can read. With --list: who was paired with the site of this host.
Example: longreach pair --slave 192.0.2.7:47021)";

inline constexpr const char* kUnpairMore =
    R"(What the host has got here is refused from now on, for new calls and for those that are under way; if its master has the
robot, the robot holds. It acts on the programs that use this site folder, on this host. Other hosts of the site
do not hear of it: where a master runs on one, give it the fingerprints that are printed.
Example: longreach unpair station-2)";

inline constexpr const char* kDoctorMore =
    R"(Looks at this host's site folder and certificates, at both sides (ports, version, loop, link, round trips) and
at this machine (clock, real-time rights, a bare loop). Changes nothing, whether something runs or not.
Exit status 1 when something failed; warnings are no failures.
Example: longreach doctor --slave 192.0.2.7:47020)";

inline constexpr const char* kAdapterCheckMore =
    R"(Talks to the adapter as longreach does, and as it does not: rate, sequence, watchdog, garbage, restarts; ten seconds.
Only where no longreach talks to it meanwhile. THE DEVICE PUSHES by --force along z: hold it or keep clear; it has to
tell in force_n what it does. A robot is asked to stay where it is, or with --move THE ROBOT MOVES its first joint.
--push instead asks you to push the robot's tool along x, y, z of its base and to turn it about them, and says what is wrong
with what the force sensor tells: sign, axes, base instead of tool, weight, a dead channel, joints in degrees.
Exit status 1 when a rule is not kept; each line then says what to do. The rules: common/link/adapter_datagram.hpp.
Example: longreach adapter check --robot unix:/run/user/1000/robot --move 0.01)";

inline constexpr const char* kSetMore =
    R"(Fields, units and ranges: proto/config.proto. Some may not change while engaged, some only
at start. What a side was started with is the ceiling of its limits: they can only be tightened.
`longreach get` notes what may be set; a refusal says why not.
Example: longreach set slave estimator.forgetting 0.995 estimator.deadband 5%)";

inline constexpr const char* kViewMore =
    R"(Prints the page's address and serves it until Ctrl-C: arm and scene as the slave reports them, the pose that is
commanded now, forces, plots, controls. One page at a time has the hand and may act; all may look, and stop.
The address holds a token, new with every start; whoever has the address may act, so keep it to yourself. The page
is not encrypted: beyond this machine (--listen 0.0.0.0:8080), across a network that you do not trust, go through
ssh -L instead.
Example: longreach view)";

/// Options of `link set` with the fields that they set.
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
