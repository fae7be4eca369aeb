#pragma once
// What the user asked for: a parsed and, as far as it can be judged here, valid command line.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/site/rpc_security.hpp"
#include "proto/config.pb.h"

namespace longreach {

enum class Side { kMaster, kSlave };
constexpr std::string_view name_of(Side side) { return side == Side::kMaster ? "master" : "slave"; }

enum class ExitStatus : int {
  kDone = 0,
  kFailed = 1,  // refused, or a side does not answer
  kUsage = 2,   // bad usage or bad value
};

/// Bad usage or a bad value: one sentence for the user.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A direction of the link: up is master to slave and is set at the slave, down is set at the master.
enum class Direction { kUp, kDown, kBoth };

struct StatusCommand {};
struct WatchCommand {
  double rate_hz = 4.0;
  std::optional<std::uint64_t> count{};  // none: until Ctrl-C
  bool plain = false;                    // a line an update, on a terminal, too
};
/// Serves the page until Ctrl-C.
struct ViewCommand {
  std::string listen = "127.0.0.1:0";
};
struct GetCommand {
  Side side = Side::kMaster;
  std::string path;  // empty: everything
};
struct SetCommand {
  Side side = Side::kMaster;
  std::vector<std::pair<std::string, std::string>> assignments;  // path, value
};
struct LinkShowCommand {};
/// Also blackout and clear, which are a change of some fields and of all.
struct LinkSetCommand {
  Direction direction = Direction::kBoth;
  std::optional<std::string> profile{};  // replaces the direction before `fields` go over it
  bool clear = false;                    // likewise, with an undisturbed link
  proto::Impairment fields;              // of each direction that it is applied to
};
struct ModeCommand {
  proto::Mapping::Mode mode = proto::Mapping::POSITION;
};
struct ScaleCommand {
  std::optional<double> value{};
  int steps = 0;  // of 0.05, without a value
};
struct EngageCommand {};
struct StopCommand {};
/// This host joins the site of the slave whose token this is.
struct PairCommand {
  std::string token_file;  // -: standard input; empty: asked for on the terminal
  bool replace = false;    // a site that is here already is put aside
  bool list = false;       // nothing but: who was paired here
};
/// What paired hosts got here counts no more.
struct UnpairCommand {
  std::vector<std::string> names;  // of hosts, or fingerprints
};

/// `seconds`: how long sides and loop are watched.
struct DoctorCommand {
  double seconds = 2.0;
};

struct RecordCommand {
  enum class What { kStart, kStop, kList, kExport };
  What what = What::kStart;
  std::string name;                  // of a start; empty: the time
  double max_mb = 4096.0;            // likewise
  std::vector<std::string> files{};  // to be exported
  std::string folder;                // listed or exported to; empty: the usual one
};
/// An adapter of a device or a robot is tried.
struct AdapterCheckCommand {
  bool robot = false;
  std::string address;
  double force_n = 0.5;  // of a device
  double move = 0.0;     // of a robot's first joint, rad or m
  bool push = false;     // instead: a person pushes a robot's tool
  std::string robot_file{};
  double push_timeout_s = 30.0;  // for each push
};

using Command =
    std::variant<StatusCommand, WatchCommand, ViewCommand, GetCommand, SetCommand, LinkShowCommand,
                 LinkSetCommand, ModeCommand, ScaleCommand, EngageCommand, StopCommand, PairCommand,
                 UnpairCommand, DoctorCommand, RecordCommand, AdapterCheckCommand>;

struct Options {
  std::string master_address;  // host:port of its RPC server
  std::string slave_address;
  double timeout_s = 3.0;  // for each call, connecting included
  bool json = false;
  std::string site{};     // folder of the certificates; empty: the usual one
  bool insecure = false;  // in clear, on this machine
};

struct Invocation {
  Options options;
  Command command;
};

}  // namespace longreach
