#pragma once
// A parsed command line, validated as far as possible here.

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
  kUsage = 2,   // invalid usage or value
};

/// Invalid usage or value: one sentence for the user.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A direction of the link: up is master to slave and is set at the slave, down is slave to master and is set
/// at the master.
enum class Direction { kUp, kDown, kBoth };

struct StatusCommand {};
struct WatchCommand {
  double rate_hz = 4.0;
  std::optional<std::uint64_t> count{};  // none: until Ctrl-C
  bool plain = false;                    // a line per update, also on a terminal
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
/// Also used by blackout and clear, which change some fields and all fields.
struct LinkSetCommand {
  Direction direction = Direction::kBoth;
  std::optional<std::string> profile{};  // replaces the direction before `fields` are applied
  bool clear = false;                    // likewise, with an unimpaired link
  proto::Impairment fields;              // for each affected direction
};
struct ModeCommand {
  proto::Mapping::Mode mode = proto::Mapping::POSITION;
};
struct ScaleCommand {
  std::optional<double> value{};
  int steps = 0;  // of 0.05, if there is no value
};
struct EngageCommand {};
struct StopCommand {};
/// This host joins the site of the slave that issued the token.
struct PairCommand {
  std::string token_file;  // -: standard input; empty: prompt on the terminal
  bool replace = false;    // an existing site is moved away
  bool list = false;       // only list the paired hosts
};
/// Revokes the certificates of paired hosts.
struct UnpairCommand {
  std::vector<std::string> names;  // of hosts, or fingerprints
};

/// `seconds`: duration of the measurement.
struct DoctorCommand {
  double seconds = 2.0;
};

struct RecordCommand {
  enum class What { kStart, kStop, kList, kExport };
  What what = What::kStart;
  std::string name;                  // for start; empty: the time
  double max_mb = 4096.0;            // likewise
  std::vector<std::string> files{};  // to export
  std::string folder;                // to list or export to; empty: the default folder
};
/// Tests an adapter of a device or a robot.
struct AdapterCheckCommand {
  bool robot = false;
  std::string address;
  double force_n = 0.5;  // for a device
  double move = 0.0;     // for a robot's first joint, rad or m
  bool push = false;     // instead: the user pushes the tool of a robot
  std::string robot_file{};
  double push_timeout_s = 30.0;  // for each push
};

/// A robot's file is shown, or written in the other form.
struct RobotCommand {
  enum class What { kShow, kDenavitHartenberg, kUrdf };
  What what = What::kShow;
  std::string file;
  std::string base_link{}, tip_link{};  // of a URDF
  std::string picture{};                // file for an SVG; empty: none
};

using Command =
    std::variant<StatusCommand, WatchCommand, ViewCommand, GetCommand, SetCommand, LinkShowCommand,
                 LinkSetCommand, ModeCommand, ScaleCommand, EngageCommand, StopCommand, PairCommand,
                 UnpairCommand, DoctorCommand, RecordCommand, AdapterCheckCommand, RobotCommand>;

struct Options {
  std::string master_address;  // host:port of its RPC server
  std::string slave_address;
  double timeout_s = 3.0;  // for each call, including the connection
  bool json = false;
  std::string site{};     // folder of the certificates; empty: the default folder
  bool insecure = false;  // unencrypted, on this machine
};

struct Invocation {
  Options options;
  Command command;
};

}  // namespace longreach
