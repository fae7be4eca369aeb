#pragma once
// A parsed command line, validated as far as possible without connecting to a side.

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/site/rpc_security.hpp"
#include "proto/control.pb.h"

namespace longreach {

enum class Side { kMaster, kSlave };
constexpr std::string_view name_of(Side side) { return side == Side::kMaster ? "master" : "slave"; }

enum class ExitStatus : int {
  kDone = 0,
  kFailed = 1,  // the request was refused, or a side did not respond
  kUsage = 2,   // invalid usage or value
};

/// Thrown for an invalid command line or an invalid value. The message is one sentence for the user.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A direction of the link: "up" is from master to slave and is configured at the slave; "down" is from slave
/// to master and is configured at the master.
enum class Direction { kUp, kDown, kBoth };

struct StatusCommand {
  bool all = false;  // every value of both sides
};
struct WatchCommand {
  double rate_hz = 4.0;
  std::optional<std::uint64_t> count{};  // number of updates; std::nullopt: until Ctrl-C
  bool plain = false;                    // one line per update, even on a terminal
};
/// Serves the page until Ctrl-C.
struct ViewCommand {
  std::string listen = "127.0.0.1:0";
};
struct GetCommand {
  Side side = Side::kMaster;
  std::string path;  // empty: everything
  bool origin = false;
};
struct SetCommand {
  Side side = Side::kMaster;
  std::vector<std::pair<std::string, std::string>> assignments;  // path, value
};
struct LinkShowCommand {};
/// Also used by `link blackout`, which changes some fields, and by `link clear`, which resets all of them.
struct LinkSetCommand {
  Direction direction = Direction::kBoth;
  std::optional<std::string> profile{};  // replaces all fields of the direction before `fields` are applied
  bool clear = false;                    // resets all fields before `fields` are applied
  proto::Impairment fields;              // applied to each affected direction
};
/// An action that one side carries out; its answer is printed.
struct ActionCommand {
  Side side = Side::kMaster;
  proto::Action action;
};
struct ScaleCommand {
  std::optional<double> value{};
  int steps = 0;  // number of steps of 0.05, used if no value is given
};
/// Speed per deflection in rate mode.
struct KvCommand {
  std::optional<double> value{};
  int steps = 0;  // number of factors of 1.25, used if no value is given
};
struct EngageCommand {};
struct StopCommand {};
/// Adds this host to the site of the slave that issued the token.
struct PairCommand {
  std::string token_file;  // "-": standard input; empty: prompt on the terminal
  bool replace = false;    // rename an existing site folder first
  bool list = false;       // only list the paired hosts
};
/// Revokes the certificates of paired hosts.
struct UnpairCommand {
  std::vector<std::string> names;  // host names or fingerprints
};

/// Checks this host and both sides. `seconds` is the duration of the measurement.
struct DoctorCommand {
  double seconds = 2.0;
};

struct RecordCommand {
  enum class What { kStart, kStop, kList, kExport };
  What what = What::kStart;
  std::string name;                  // for kStart: name of the recording; empty: the current time
  double max_mb = 4096.0;            // for kStart: maximum size of the recording
  std::vector<std::string> files{};  // for kExport: recordings to export
  std::string folder;                // folder to list or to export to; empty: the default folder
};
/// Checks the adapter of a device or a robot.
struct AdapterCheckCommand {
  bool robot = false;
  std::string address;
  double force_n = 0.5;       // maximum commanded force of a device
  std::string device_file{};  // workspace of the device; empty: not compared
  double move = 0.0;          // motion of a robot's first joint, rad or m
  bool push = false;          // instead, check the reported forces while the user pushes the tool
  std::string robot_file{};
  double push_timeout_s = 30.0;  // time limit for each push
};

/// Shows a robot file, or converts it between Denavit-Hartenberg rows and URDF.
struct RobotCommand {
  enum class What { kShow, kDenavitHartenberg, kUrdf };
  What what = What::kShow;
  std::string file;
  std::string base_link{}, tip_link{};  // first and last link of the arm in a URDF
  std::string picture{};                // SVG file to write; empty: none
};

/// Runs both sides on this machine.
struct DemoCommand {
  std::vector<std::string> arguments{};  // arguments of the script, which checks them
  std::string logs{};                    // folder; empty: the default folder
};

/// Judges a task that a person does by hand, or draws the order of the trials of a study.
struct TaskCommand {
  enum class What { kPath, kDock, kOrder };
  What what = What::kPath;
  std::string participant{};
  std::optional<int> trial{};  // none: the next one in the file
  std::string csv{};           // empty: no file
  double limit_s = 600.0;
  std::vector<std::string> modes{}, links{};  // for kOrder
  int trials = 1;                             // for kOrder, of each mode and link
};

using Command = std::variant<StatusCommand, WatchCommand, ViewCommand, GetCommand, SetCommand,
                             LinkShowCommand, LinkSetCommand, ActionCommand, ScaleCommand, KvCommand,
                             EngageCommand, StopCommand, PairCommand, UnpairCommand, DoctorCommand,
                             RecordCommand, AdapterCheckCommand, RobotCommand, DemoCommand, TaskCommand>;

class RpcConnections;

struct Options {
  std::string master_address;  // host:port of its RPC server
  std::string slave_address;
  // Timeout for each call, including connecting; none: it follows the link (common/rpc/rpc_connection.hpp).
  std::optional<double> timeout_s{};
  bool json = false;
  std::string site{};     // folder with the certificates; empty: the default folder
  bool insecure = false;  // no encryption; only for sides on this machine
  // Connections that all clients with these options share; null: each client has its own.
  std::shared_ptr<RpcConnections> connections{};
};

struct Invocation {
  Options options;
  Command command;
};

}  // namespace longreach
