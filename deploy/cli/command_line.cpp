#include "deploy/cli/command_line.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <string_view>

#include "common/config/config.hpp"
#include "common/program/option_checks.hpp"
#include "common/program/program_text.hpp"
#include "common/rpc/rpc_server.hpp"
#include "deploy/cli/adapter/adapter_words.hpp"
#include "deploy/cli/argument_checks.hpp"
#include "deploy/cli/demo/demo_words.hpp"
#include "deploy/cli/help_text.hpp"
#include "deploy/cli/record/record_words.hpp"
#include "deploy/cli/robot/robot_words.hpp"
#include "deploy/cli/task/task_words.hpp"

namespace longreach {
namespace {

/// The arguments as typed, before they are validated.
struct Words {
  std::string master{kMasterRpcAddress}, slave{kSlaveRpcAddress}, timeout{};
  std::string hz = "4", count{};
  std::string side{}, path{};
  std::vector<std::string> assignments{};
  std::string profile{}, direction = "both", duration{};
  std::string mode{}, scale{}, kv{};
  std::string token{}, token_file{};
  std::vector<std::string> names{};
  std::string seconds = "2";
  std::string listen = ViewCommand{}.listen;
  bool origin = false;
};

/// Returns the command for a number, or for a step up or down.
template <class GainCommand>
GainCommand gain(const char* name, const std::string& word, double low, double high) {
  if (word == "up") return {{}, 1};
  if (word == "down") return {{}, -1};
  return {bounded(name, word, parse_number(word), low, high, ", up or down")};
}

/// The grammar of the command line. It is declared once and then queried for the parsed options.
class Grammar {
 public:
  Grammar();
  std::variant<Invocation, Printout> parse(int argc, const char* const* argv);

 private:
  void declare_views();
  void declare_fields();
  void declare_link();
  void declare_motion();
  void declare_site();
  CLI::App* declare(CLI::App& parent, const char* name, const std::string& help, const char* more);
  CLI::Option* declare_direction(CLI::App& command);

  [[nodiscard]] Options options() const;
  [[nodiscard]] Command command() const;
  [[nodiscard]] SetCommand set_command() const;
  [[nodiscard]] PairCommand pair_command() const;
  [[nodiscard]] LinkSetCommand link_command() const;
  [[nodiscard]] Side side() const { return words_.side == "slave" ? Side::kSlave : Side::kMaster; }
  [[nodiscard]] bool parsed(const char* name) const { return app_.get_subcommand(name)->parsed(); }

  CLI::App app_{kIntroduction, "longreach"};
  CLI::App* link_ = nullptr;
  RecordWords record_{};
  RobotWords robot_{};
  DemoWords demo_{};
  AdapterWords adapter_{};
  TaskWords task_{};
  Words words_{};
  std::vector<std::string> field_words_ = std::vector<std::string>(std::size(kFieldOptions));
  bool json_ = false;
  std::string site_;
  bool insecure_ = false, replace_ = false, plain_ = false, all_ = false, list_ = false;
};

Grammar::Grammar() {
  app_.require_subcommand(0, 1);
  app_.set_version_flag("--version", "longreach " LONGREACH_VERSION);
  add_manual_options(app_, "longreach " LONGREACH_VERSION);
  app_.footer(kExits);
  app_.get_formatter()->column_width(32);
  app_.add_option("--master", words_.master, "address of the master's RPC server [" + words_.master + "]")
      ->type_name("HOST:PORT");
  app_.add_option("--slave", words_.slave, "address of the slave's RPC server [" + words_.slave + "]")
      ->type_name("HOST:PORT");
  app_.add_option("--timeout", words_.timeout,
                  "timeout for a response, including the time to connect [follows the link]")
      ->type_name("S");
  app_.add_option("--site", site_, "certificate folder [$XDG_CONFIG_HOME/longreach]")->type_name("DIR");
  app_.add_flag("--insecure", insecure_, "connect to sides that were started with --insecure");
  app_.add_flag("--json", json_, "print results and errors as JSON");
  declare_views();
  declare_fields();
  declare_link();
  declare_motion();
  record_.declare(app_);
  robot_.declare(app_);
  demo_.declare(app_);
  task_.declare(app_);
  declare_site();
  adapter_.declare(app_);
  refuse_empty_values(app_);
}

CLI::App* Grammar::declare(CLI::App& parent, const char* name, const std::string& help, const char* more) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->footer(more);
  command->fallthrough();  // accepts --json and --timeout after the command, too
  return command;
}

void Grammar::declare_views() {
  declare(app_, "status", "show the state of both sides once", kStatusMore)
      ->add_flag("--all", all_, "also print every value of both sides, by its name in proto/state_*.proto");
  CLI::App* watch = declare(app_, "watch", "show the state of both sides live", kWatchMore);
  watch->add_flag("--plain", plain_, "print one line per update without colour, even on a terminal");
  watch->add_option("--hz", words_.hz, "updates per second, 0.1 to 60 [4]")->type_name("HZ");
  watch->add_option("--count", words_.count, "exit after this number of updates")->type_name("N");
  declare(app_, "view", "serve a browser page that shows and controls the robot", kViewMore)
      ->add_option("--listen", words_.listen,
                   "address of the page; port 0: any free port [" + words_.listen + "]")
      ->type_name("HOST:PORT");
}

void Grammar::declare_fields() {
  const auto sides = CLI::IsMember({"master", "slave"}, CLI::ignore_case);
  CLI::App* get = declare(app_, "get", "print all or part of a side's configuration",
                          "proto/config_*.proto list fields, units and ranges.\n"
                          "Example: longreach get slave estimator.forgetting");
  get->add_option("SIDE", words_.side, "master or slave")->required()->transform(sides);
  get->add_option("PATH", words_.path, "field or group; default: all");
  get->add_flag("--origin", words_.origin,
                "show where each value comes from: default, preset, a file, command line or client");
  CLI::App* set = declare(
      app_, "set", "change configuration fields of a side; if one is refused, none is changed", kSetMore);
  set->add_option("SIDE", words_.side, "master or slave")->required()->transform(sides);
  set->add_option("PATH VALUE", words_.assignments, "field and its new value; repeatable")->required();
}

CLI::Option* Grammar::declare_direction(CLI::App& command) {
  return command
      .add_option("--direction", words_.direction,
                  "up (master to slave), down (slave to master) or both [both]")
      ->transform(CLI::IsMember({"up", "down", "both"}, CLI::ignore_case))
      ->type_name("DIRECTION");
}

void Grammar::declare_link() {
  link_ = declare(app_, "link", "show or change the artificial impairment of the link",
                  "Up is from master to slave and is impaired at the slave; down is from slave to master and "
                  "is\nimpaired at the master.\n"
                  "Example: longreach link set --profile moon");
  link_->require_subcommand(0, 1);
  declare(*link_, "show", "print the impairment of both directions", "Example: longreach link show");
  CLI::App* set = declare(*link_, "set", "change the impairment", kLinkSetMore);
  set->add_option("--profile", words_.profile, "link profile to apply, a name in deploy/links")
      ->type_name("NAME");
  for (std::size_t i = 0; i < std::size(kFieldOptions); ++i)
    set->add_option(kFieldOptions[i].name, field_words_[i], kFieldOptions[i].help)
        ->type_name(kFieldOptions[i].value);
  declare_direction(*set);
  CLI::App* blackout = declare(*link_, "blackout", "drop all datagrams for a given time, starting now",
                               "Example: longreach link blackout 2s --direction down");
  blackout->add_option("DURATION", words_.duration, "duration: 500ms, 2s or plain seconds (0 to 1e6 s)")
      ->required();
  declare_direction(*blackout);
  declare_direction(
      *declare(*link_, "clear", "remove all artificial impairment", "Example: longreach link clear"));
}

void Grammar::declare_motion() {
  declare(app_, "mode", "set the motion mode",
          "rate: the deflection of the handle sets the speed of the robot, for long distances; position: "
          "the robot moves\n"
          "by the scaled displacement of the handle, for fine work.\n"
          "Example: longreach mode position")
      ->add_option("MODE", words_.mode, "rate or position")
      ->required()
      ->transform(CLI::IsMember({"rate", "position"}, CLI::ignore_case));
  declare(app_, "scale", "set the motion scale (robot displacement / hand displacement), 0.05 to 1",
          "Example: longreach scale 0.5")
      ->add_option("VALUE", words_.scale, "0.05 to 1; up or down changes it by 0.05")
      ->required();
  declare(app_, "kv", "set the speed per deflection in rate mode, 0.001 to 1000 1/s",
          "That of rotation changes by the same factor. The speed of the robot follows by a ramp.\n"
          "Example: longreach kv 2.5")
      ->add_option("VALUE", words_.kv, "0.001 to 1000; up or down changes it by a factor of 1.25")
      ->required();
  declare(app_, "engage", "make the robot follow the hand",
          "The first goal is the robot's current pose, so the robot does not jump. The request is sent to "
          "the master.\n"
          "Example: longreach engage");
  declare(app_, "stop", "stop the robot until it is engaged again",
          "The request is sent to both sides; the command succeeds if one of them confirms it.\nExample: "
          "longreach stop");
}

void Grammar::declare_site() {
  CLI::App* pair = declare(app_, "pair", "join the site of a slave on another host", kPairMore);
  pair->add_option("TOKEN", words_.token)->group("");  // to be refused
  pair->add_option("--token-file", words_.token_file,
                   "file with the token, readable only by you; -: standard input [prompt on the terminal]")
      ->type_name("FILE");
  pair->add_flag("--list", list_, "list the hosts paired with this host's site");
  declare(app_, "unpair", "revoke the certificates of a paired host", kUnpairMore)
      ->add_option("NAME", words_.names, "name of the host as printed by pair --list, or a fingerprint")
      ->required()
      ->expected(-1);
  CLI::App* doctor = declare(app_, "doctor", "find problems and print remedies", kDoctorMore);
  doctor->add_option("--seconds", words_.seconds, "measurement duration, 0.2 to 60 s [2]")->type_name("N");
  pair->add_flag("--replace", replace_, "move an existing site folder aside first");
}

std::variant<Invocation, Printout> Grammar::parse(int argc, const char* const* argv) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return Printout{std::string(version.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    return Printout{app_.help()};
  } catch (const CLI::ExtrasError& error) {
    if (app_.get_subcommands().empty() && !app_.remaining().empty())
      throw UsageError(app_.remaining().front() + " is not a command; see longreach --help");
    throw UsageError(std::string(error.what()) + "; see longreach --help");
  } catch (const CLI::ParseError& error) {
    throw UsageError(std::string(error.what()) + "; see longreach --help");
  }
  if (json_ && (app_.get_subcommands().empty() || (link_->parsed() && link_->get_subcommands().empty())))
    throw UsageError("a command is missing; see longreach --help");
  if (app_.get_subcommands().empty()) return Printout{app_.help(), ExitStatus::kUsage};
  if (link_->parsed() && link_->get_subcommands().empty())
    return Printout{link_->help("longreach"), ExitStatus::kUsage};
  return Invocation{options(), command()};
}

Options Grammar::options() const {
  check_address("--master", words_.master);
  check_address("--slave", words_.slave);
  std::optional<double> timeout_s;
  if (!words_.timeout.empty())
    timeout_s = bounded("--timeout", words_.timeout, parse_seconds(words_.timeout), 0.05, 600.0, " s");
  return {words_.master, words_.slave, timeout_s, json_, site_, insecure_, {}};
}

Command Grammar::command() const {
  if (parsed("status")) return StatusCommand{all_};
  if (parsed("watch")) {
    WatchCommand watch{
        bounded("--hz", words_.hz, parse_number(words_.hz), kWatchHzMin, kWatchHzMax, " Hz"), {}, plain_};
    if (words_.count.empty()) return watch;
    watch.count = parse_integer<std::uint64_t>(words_.count);
    if (watch.count.value_or(0) == 0)
      throw UsageError("--count = " + words_.count + " is not a positive whole number");
    return watch;
  }
  if (parsed("view")) {
    if (!host_and_port(words_.listen)) throw UsageError("--listen = " + words_.listen + kNoAddress);
    return ViewCommand{words_.listen};
  }
  if (parsed("get")) return GetCommand{side(), words_.path, words_.origin};
  if (parsed("set")) return set_command();
  if (parsed("link")) {
    if (link_->get_subcommand("show")->parsed()) return LinkShowCommand{};
    return link_command();
  }
  ActionCommand asked;
  if (parsed("mode")) asked.action.set_mode(words_.mode == "rate" ? proto::RATE : proto::POSITION);
  if (asked.action.action_case() != proto::Action::ACTION_NOT_SET) return asked;
  if (parsed("scale")) return gain<ScaleCommand>("scale", words_.scale, 0.05, 1.0);
  if (parsed("kv")) return gain<KvCommand>("kv", words_.kv, 0.001, 1000.0);
  if (parsed("record")) return record_.command();
  if (parsed("robot")) return robot_.command();
  if (parsed("demo")) return demo_.command();
  if (parsed("task")) return task_.command();
  if (parsed("engage")) return EngageCommand{};
  if (parsed("pair")) return pair_command();
  if (parsed("unpair")) return UnpairCommand{words_.names};
  if (parsed("adapter")) return adapter_.command();
  if (parsed("doctor"))
    return DoctorCommand{
        bounded("--seconds", words_.seconds, parse_seconds(words_.seconds), 0.2, 60.0, " s")};
  return StopCommand{};
}

PairCommand Grammar::pair_command() const {
  if (!words_.token.empty())
    throw UsageError(
        "pair does not accept a token as an argument, because other users of this machine can see "
        "arguments: enter the token at the prompt, or use --token-file FILE");
  if (list_) return {.token_file = {}, .list = true};
  if (app_.count("--slave") == 0)
    throw UsageError("pair needs --slave HOST:PORT, the address that longreach-slave --pair printed");
  return {.token_file = words_.token_file, .replace = replace_};
}

SetCommand Grammar::set_command() const {
  SetCommand set{side(), {}};
  for (std::size_t i = 0; i < words_.assignments.size(); i += 2) {
    if (i + 1 == words_.assignments.size())
      throw UsageError(words_.assignments[i] + " has no value: give PATH VALUE pairs");
    set.assignments.emplace_back(words_.assignments[i], words_.assignments[i + 1]);
  }
  return set;
}

LinkSetCommand Grammar::link_command() const {
  LinkSetCommand set;
  if (words_.direction != "both")
    set.direction = words_.direction == "up" ? Direction::kUp : Direction::kDown;
  if (link_->get_subcommand("clear")->parsed()) {
    set.clear = true;
    return set;
  }
  if (link_->get_subcommand("blackout")->parsed()) {
    set_field(set.fields, "blackout_duration_s", words_.duration);
    set.fields.set_blackout_start_s(0.0);
    set.fields.set_blackout_period_s(0.0);
    return set;
  }
  const auto given = [&](const char* option) { return link_->get_subcommand("set")->count(option) > 0; };
  bool any = given("--profile");
  if (any) set.profile = words_.profile;
  for (std::size_t i = 0; i < std::size(kFieldOptions); ++i) {
    if (!given(kFieldOptions[i].name)) continue;
    set_field(set.fields, kFieldOptions[i].field, field_words_[i]);
    any = true;
  }
  if (!any) throw UsageError("link set needs --profile or at least one field; see link set --help");
  return set;
}

}  // namespace

std::variant<Invocation, Printout> parse_command_line(int argc, const char* const* argv) {
  return Grammar().parse(argc, argv);
}

}  // namespace longreach
