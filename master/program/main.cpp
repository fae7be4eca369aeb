// longreach-master: the operator's side. Reads the haptic device, commands the slave and renders its
// contacts.

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <sstream>

#include "common/rpc/rpc_server.hpp"
#include "common/rpc/side_program.hpp"
#include "master/console/formatted.hpp"
#include "master/console/summary.hpp"
#include "master/desk/desk.hpp"
#include "master/program/status_loop.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

struct MasterOptions : ProgramOptions {
  std::string operator_kind;
  std::string mode;
  std::string adapter;
  std::string view = "auto";
  bool engage = false;
  bool take = false;
  std::optional<double> wall_n_per_m{};
};

/// Returns the names in the form that users write.
std::vector<std::string> names_of(const google::protobuf::EnumDescriptor& values) {
  std::vector<std::string> names;
  for (int i = 0; i < values.value_count(); ++i) {
    names.push_back(values.value(i)->name());
    for (char& c : names.back()) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return names;
}

/// Converts shorthand options to ordinary settings.
ProgramOptions with_shorthands(const MasterOptions& options) {
  ProgramOptions out = options;
  if (!options.operator_kind.empty()) out.settings.push_back("operator.kind=" + options.operator_kind);
  if (!options.mode.empty()) out.settings.push_back("mapping.mode=" + options.mode);
  if (!options.adapter.empty()) out.settings.push_back("device_adapter.address=" + options.adapter);
  if (options.engage) out.settings.push_back("safety.engage_at_start=true");
  return out;
}

ViewKind view_kind(const std::string& name) {
  if (name == "none") return ViewKind::kNone;
  return name == "plain" ? ViewKind::kPlain : ViewKind::kAuto;
}

/// Returns the newest snapshot, for RPC threads.
ConsoleSnapshot picture(MasterService& service, const MasterConfig& config, double seconds) {
  ConsoleSnapshot out = picture(service.snapshot(), config);
  out.trouble = service.trouble();
  out.shown = service.shown();
  out.seconds = seconds;
  return out;
}

SummaryConfig summary_of(const MasterConfig& config, std::optional<double> wall_n_per_m) {
  return {.ke = config.rendering.ke,
          .contact_expected = scripted(config),
          .wall_n_per_m = wall_n_per_m,
          .store_j = config.rendering.store_j,
          .outages = config.link.impairment.blackout_duration_s > 0.0};
}

/// Returns the exit status. The verdict of a run without a given length does not count if a signal ended it.
int judge(const MasterOptions& options, bool by_signal, const RunSummary& summary, MasterService& service,
          const MasterConfig& config, const std::vector<HandTrouble>& hand) {
  const Summary result = summary.finish(picture(service, config, 0.0), hand);
  if (options.view != "none") put(STDOUT_FILENO, result.text());
  const LoopFigures loop = service.snapshot().side.loop;
  spdlog::info("end ticks={} missed_ticks={} ticks_late_100ms={} lateness_p99_us={:.0f} verdict=\"{}\"",
               loop.ticks, loop.missed_ticks, loop.ticks_late_100ms, 1e6 * loop.lateness_quantile_s(0.99),
               to_string(result.verdict()));
  const bool counts = options.seconds || !by_signal;
  return counts && result.verdict() == RunVerdict::kFault ? kExitFailed : 0;
}

/// The arguments must outlive the service.
std::unique_ptr<DeskService> make_desk(MasterService& service, MasterShell& shell,
                                       const MasterConfig& config) {
  std::function<void(const RemoteAim&)> aim;
  if (config.device_adapter.address.empty())
    aim = [&shell](const RemoteAim& newest) { shell.remote_aim().write(newest); };
  return std::make_unique<DeskService>(
      DeskService::Reach{config.device.delta.workspace_m,
                         config.device.turns ? config.device.spherical.workspace_rad : 0.0},
      [&, began = boottime_now()] { return picture(service, config, to_seconds(boottime_now() - began)); },
      aim);
}

/// Returns what the configuration means for the operator. Each line starts with `before`.
std::string notes_on(const MasterConfig& config, const std::string& before) {
  const double most_n_per_m = MasterNode(config).view().stiffness_max_n_per_m;
  std::string text = before + "device " + config.device.name +
                     formatted(": renders at most %.3g N/mm, ", 1e-3 * most_n_per_m) +
                     formatted("workspace up to %.3g mm", 1e3 * config.device.delta.workspace_m) + "\n";
  if (!config.device.turns)
    text += before +
            "the handle does not turn: the orientation of the robot is constant, and no moment is "
            "rendered\n";
  return text;
}

/// Checks what ranges of single fields cannot: whether the mechanisms can close their loops.
void require_device(const DeviceConfig& device) {
  try {
    SimulatedDevices{device};
  } catch (const GeometryError& e) {
    throw ConfigError(std::string("device: ") + e.what());
  }
}

/// A device file that was not explicitly chosen does not describe a real device.
void log_device(const MasterConfig& config, bool chosen, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) spdlog::warn("configuration note=\"{}\"", warning);
  std::istringstream notes(notes_on(config, ""));
  for (std::string note; std::getline(notes, note);) spdlog::info("device note=\"{}\"", note);
  if (config.device_adapter.address.empty()) return;
  spdlog::info("device adapter={}", config.device_adapter.address);
  if (!chosen)
    spdlog::warn(
        "device file=default because=\"device_file is not set: the rendering uses the damping, mass "
        "and encoders of {}\" do=\"set device_file to the file of your device\"",
        config.device.name);
}

int operate(const MasterOptions& options) {
  const auto effective = effective_config<proto::MasterConfig>(asked(with_shorthands(options)));
  require_device(to_struct(effective.config).device);
  if (options.check) return print_check(effective, notes_on(to_struct(effective.config), "# "));
  SideProgram<MasterService> side(options, effective);
  const MasterConfig& config = side.config;
  MasterService& service = side.service;
  const auto desk = make_desk(service, side.shell, config);
  RpcServer rpc(config.rpc.listen, service, "master", side.security, {desk.get()});
  spdlog::info("start link={} slave={} rpc={} rate_hz={} send_hz={}{}", side.shell.address(),
               config.link.slave, rpc.address(), config.loop.rate_hz, config.link.send_hz,
               files_text(effective.files, " ", ""));
  log_device(config, effective.config.has_device_file(), effective.warnings);
  StatusLoop status_loop({view_kind(options.view), options.seconds}, config, side.shell, service);
  // The live view controls the terminal, and displays what the log would contain.
  if (status_loop.live() && isatty(STDERR_FILENO) == 1) hush_log();

  RunSummary summary(summary_of(config, options.wall_n_per_m));
  const auto add_to_summary = [&](Time now) {
    const MasterSnapshot& last = side.shell.last();
    summary.add(to_seconds(now - status_loop.began()), last.view, last.side.link.rtt_s);
  };
  std::optional<SessionClient> session_client;  // ends after the loop
  const auto connect = [&](const std::atomic<bool>& stop) {
    session_client.emplace(
        slave_rpc_address(config.link.slave, config.link.slave_rpc), side.security, options.take,
        sent_hz(config.link),
        [&]() -> SessionClient::Present {
          const SideFigures figures = service.snapshot().side;
          // Both directions have the same impairment, or that of the slave is not known here.
          const ImpairmentConfig& down = config.link.impairment;
          return {figures.session, figures.link.silence_s, config.link.slave, figures.unknown_peers,
                  2.0 * (down.delay_s + down.jitter_s) + down.blackout_duration_s};
        },
        [&service](const Session& session) { return service.adopt(session); });
    status_loop.run(stop, *session_client);
  };
  side.run(add_to_summary, connect);
  session_client.reset();
  rpc.stop();
  return judge(options, stop_requested(), summary, service, config, status_loop.hand_troubles());
}

}  // namespace
}  // namespace longreach

int main(int argc, char** argv) {
  CLI::App app{"The operator's side of longreach: reads the handle, commands the slave and renders contacts.",
               "longreach-master"};
  longreach::MasterOptions options;
  longreach::add_program_options(app, options, "longreach-master " LONGREACH_VERSION);
  app.add_option(
         "--operator", options.operator_kind,
         "Operator of the simulated handle: script, keyboard, gamepad (or joystick), spacemouse or none "
         "(operator.kind)")
      ->type_name("KIND")
      ->check(CLI::IsMember(longreach::names_of(*longreach::proto::Operator::Kind_descriptor()),
                            CLI::ignore_case));
  app.add_option("--adapter", options.adapter,
                 "Address of the adapter for a real haptic device (device_adapter.address); default: "
                 "a simulated device")
      ->type_name("unix:/PATH");
  app.add_option("--mode", options.mode, "Mode at start: rate or position (mapping.mode)")
      ->type_name("MODE")
      ->check(CLI::IsMember({"rate", "position"}, CLI::ignore_case));
  app.add_flag("--engage", options.engage,
               "Engage when the first datagram from the slave arrives (safety.engage_at_start)");
  app.add_flag("--take", options.take,
               "Take control of the robot from another master; the robot holds until this master engages");
  app.add_option("--view", options.view,
                 "auto: live on a terminal, otherwise plain; plain: one line per second; none: no output")
      ->transform(CLI::IsMember({"auto", "plain", "none"}, CLI::ignore_case))
      ->capture_default_str();
  app.add_option("--wall", options.wall_n_per_m,
                 "True stiffness of the touched object, if known, for comparison in the summary")
      ->type_name("N_PER_M")
      ->check(longreach::number_above_zero());
  return longreach::guarded_main(app, argc, argv, [&options] { return longreach::operate(options); });
}
