// longreach-slave: the robot's side. Follows an engaged master, acts alone when it must.

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <thread>

#include "common/program/service_watch.hpp"
#include "common/rpc/pairing_desk.hpp"
#include "common/rpc/pairing_rpc.hpp"
#include "common/rpc/rpc_server.hpp"
#include "common/rpc/side_program.hpp"
#include "slave/command/motion.hpp"
#include "slave/kinematics/inverse.hpp"
#include "slave/program/slave_service.hpp"
#include "slave/sensing/sensor_words.hpp"

namespace longreach {
namespace {

/// Logs what has changed since the last call.
class StateLog {
 public:
  explicit StateLog(std::string adapter) : adapter_(std::move(adapter)) {}

  void write(const SlaveSnapshot& s) {
    const SlaveView& now = s.view;
    if (now.state != last_.view.state) {
      spdlog::info("state from={} to={} cause=\"{}\" engagement={}{}", to_string(last_.view.state),
                   to_string(now.state), to_string(now.cause), now.engagement, because(now.cause));
    }
    if (now.cause == HoldCause::kLinkSilent && now.cause.limit > 0.0 && last_.view.cause.limit == 0.0)
      spdlog::warn("link trouble=\"{}\"", with_remedy(now.cause));
    if (now.touch != last_.view.touch)
      spdlog::info("touch number={} sequence={:.2f}", now.touch, now.touch_sequence);
    if (s.side.session != last_.side.session) spdlog::info("session number={:016x}", s.side.session);
    if (s.side.loop.ticks_late_100ms != last_.side.loop.ticks_late_100ms) {
      spdlog::warn("late ticks_late_100ms={} missed_ticks={}", s.side.loop.ticks_late_100ms,
                   s.side.loop.missed_ticks);
    }
    if (s.watchdog_stopped && !last_.watchdog_stopped) spdlog::warn("robot stopped=\"no setpoint\"");
    if (now.limit_violations > 0 && last_.view.limit_violations == 0)
      spdlog::warn("limit violated first=\"{}\"{}", name_of(now.violations_by_limit.first),
                   now.violations_by_limit.joint == 0
                       ? ""
                       : " joint=" + std::to_string(now.violations_by_limit.joint));
    const std::string trouble = adapter_trouble(s.adapter, "robot", adapter_);
    if (trouble != trouble_ && !trouble.empty()) spdlog::warn("adapter trouble=\"{}\"", trouble);
    if (trouble != trouble_ && trouble.empty()) spdlog::info("adapter address={} answers=true", adapter_);
    if (now.ended != 0 && now.ended != last_.view.ended) write_refusal(now.ended, now.ended_because);
    if (now.refused != 0 && now.refused != now.ended && now.refusal != last_.view.refusal)
      write_refusal(now.refused, now.refusal);
    if (now.reduced != last_.view.reduced)
      for (const std::string& sentence : reduced_in_words(now.reduced))
        spdlog::warn("reduced protection=\"{}\"", sentence);
    write_zero(now.sensor_zero);
    trouble_ = trouble;
    last_ = s;
  }

 private:
  static void write_refusal(std::uint32_t engagement, const Reason& why) {
    spdlog::warn("engagement refused={} cause=\"{}\" because=\"{}\"", engagement, to_string(why),
                 with_remedy(why));
  }
  /// Each zero with its size; what is wrong with the sensor, when that changes.
  void write_zero(const SensorZero& zero) {
    if (zero.derived && zero.count != last_.view.sensor_zero.count)
      spdlog::info("force sensor zero={} bias_n={:.3f} touch_n={:.3f}", zero.count, zero.bias_n,
                   zero.touch_n);
    // Figures in it change each tick; it is logged when it begins, and when another one begins.
    const std::string warning = sensor_warning(zero);
    const std::string kind = warning.substr(0, warning.find_first_of("0123456789"));
    if (kind != sensor_warning_ && !kind.empty()) spdlog::warn("force sensor warning=\"{}\"", warning);
    sensor_warning_ = kind;
  }

  std::string adapter_;  // its address
  SlaveSnapshot last_{};
  std::string trouble_, sensor_warning_;
};

/// A real robot begins where it is.
void warn_of_singular_start(const SlaveConfig& config) {
  if (!config.robot_adapter.address.empty()) return;
  const Inverse inverse(config.robot);
  JointVector start_rad;
  for (std::size_t i = 0; i < config.robot.joint.size(); ++i)
    start_rad[static_cast<int>(i)] = config.robot.joint[i].start_rad;
  const InverseResult at = inverse.solve(inverse.kinematics().forward(start_rad), start_rad, {});
  if (at.conditioning >= kSingularBand) return;
  spdlog::warn(
      "start pose=singular conditioning={:.3f} below={} because=\"from this pose the tool cannot move in "
      "some directions; choose another robot.joint.start_rad\"",
      at.conditioning, kSingularBand);
}

/// What is real, and what of the scene is not there then.
void log_adapter(const proto::SlaveConfig& config, const std::vector<FileRead>& files) {
  const std::string& address = config.robot_adapter().address();
  if (address.empty()) return;
  spdlog::info(
      "robot adapter={} scene={} scene_left_out=\"the whole scene, with robot_file and tool_radius_m: the robot "
      "is real\"",
      address, config.scene().name());
  const bool from_file = std::ranges::find(files, "robot_file", &FileRead::field) != files.end();
  if (from_file && !config.has_robot_file())
    spdlog::warn(
        "robot file=default because=\"robot_file is not set: joints, limits and kinematics are those of {}\" "
        "do=\"set robot_file to the file of your robot\"",
        config.robot().name());
}

/// Returns the value of a limit of the joints, once if it is the same for all, and where it comes from.
std::string limit_words(const proto::Robot& robot, const Origins& origins, const std::string& field) {
  std::string values, from;
  for (int i = 0; i < robot.joint_size(); ++i) {
    const std::string path = "joint." + std::to_string(i) + "." + field;
    const std::string value = get_field(robot, path), origin = origins.of("robot." + path);
    if (i == 0) values = value, from = origin;
    if (value != values) values = "of each joint";
    if (origin != from) from = "several";
  }
  return "\"" + values + " (" + from + ")\"";
}

// What a URDF often does not say, and what is in force.
void log_description(const proto::Robot& robot, const Origins& origins) {
  if (robot.base_link().empty()) return;
  std::string start;
  for (const proto::Joint& joint : robot.joint())
    start += (start.empty() ? "" : " ") + format_number(joint.start_rad());
  spdlog::info(
      "robot description base_link={} tip_link={} acceleration_max_rad_per_s2={} jerk_max_rad_per_s3={} "
      "servo_hz={} start_rad=\"{}\" because=\"a URDF does not contain the last two, and often not the limits: set "
      "them in robot\"",
      robot.base_link(), robot.tip_link(), limit_words(robot, origins, "acceleration_max_rad_per_s2"),
      limit_words(robot, origins, "jerk_max_rad_per_s3"), robot.servo_hz(), start);
}

void log_start(const Effective<proto::SlaveConfig>& effective, const SlaveShell& shell,
               const RpcServer& rpc) {
  const proto::SlaveConfig& config = effective.config;
  const std::vector<FileRead>& files = effective.files;
  spdlog::info("start link={} rpc={} rate_hz={} robot={} scene={} surfaces={}{}", shell.address(),
               rpc.address(), config.loop().rate_hz(), config.robot().name(), config.scene().name(),
               config.scene().surface_size(), files_text(files, " ", ""));
  spdlog::info("robot name={} inverse=\"{}\"", config.robot().name(),
               Inverse(to_struct(config).robot).words());
  log_description(config.robot(), effective.origins);
  for (const std::string& warning : effective.warnings) spdlog::warn("configuration note=\"{}\"", warning);
  log_adapter(config, files);
  if (config.scene().has_needs())
    spdlog::warn(
        "scene={} needs=ignored because=\"the sensing settings decide what is measured and guarded\" "
        "do=\"remove needs from the scene file; for a robot without a force sensor set sensing.force: false\"",
        config.scene().name());
  warn_of_singular_start(to_struct(config));
}

struct SlaveOptions : ProgramOptions {
  bool pair = false;
  std::string pair_listen{kPairingAddress};
  std::string adapter;
};

/// The log goes to a file in the site folder unless told otherwise: it stays, and the person reads the rest.
int pair(const SlaveOptions& options) {
  const auto& stop = stop_requested();
  const std::filesystem::path site = site_of(options);
  (void)site_authority(site);
  ::umask(077);
  set_up_log("slave", options.log.empty() ? (site / "pairing.log").string() : options.log);
  return run_pairing_desk(site, options.pair_listen, stop) ? 0 : kExitFailed;
}

ProgramOptions with_shorthands(const SlaveOptions& options) {
  ProgramOptions out = options;
  if (!options.adapter.empty()) out.settings.push_back("robot_adapter.address=" + options.adapter);
  return out;
}

int serve(const SlaveOptions& options) {
  if (options.pair) return pair(options);
  const auto effective = effective_config<proto::SlaveConfig>(asked(with_shorthands(options)));
  if (options.check) return print_check(effective, "");
  SideProgram<SlaveService> side(options, effective);
  RpcServer rpc(side.config.rpc.listen, side.service, "slave", side.security);
  log_start(effective, side.shell, rpc);
  StateLog state_log(side.config.robot_adapter.address);
  const auto watch_loop = [&](const std::atomic<bool>& stop) {
    ServiceWatch watch;
    const Time began = boottime_now();
    while (!stop && !(options.seconds && to_seconds(boottime_now() - began) >= *options.seconds)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      const SlaveSnapshot now = side.service.snapshot();
      state_log.write(now);
      watch.update(now.side.loop.ticks);
    }
  };
  side.run([](Time) {}, watch_loop);
  rpc.stop();
  const SlaveSnapshot last = side.service.snapshot();
  spdlog::info("end ticks={} missed_ticks={} ticks_late_100ms={} lateness_p99_us={:.0f} limit_violations={}",
               last.side.loop.ticks, last.side.loop.missed_ticks, last.side.loop.ticks_late_100ms,
               1e6 * last.side.loop.lateness_quantile_s(0.99), last.view.limit_violations);
  return 0;
}

}  // namespace
}  // namespace longreach

int main(int argc, char** argv) {
  CLI::App app{
      "The robot's side of longreach: follows the master while engaged, limits motion and force, and "
      "measures contacts.",
      "longreach-slave"};
  longreach::SlaveOptions options;
  longreach::add_program_options(app, options, "longreach-slave " LONGREACH_VERSION);
  app.add_flag(
      "--pair", options.pair,
      "Do not move the robot; instead print a token with which another host can join this site as master "
      "and client, and wait for that host (log: pairing.log in the site folder)");
  app.add_option("--adapter", options.adapter,
                 "Address of the adapter for a real robot (robot_adapter.address); default: a "
                 "simulated robot")
      ->type_name("unix:/PATH");
  app.add_option("--pair-listen", options.pair_listen, "Address at which to wait for the joining host")
      ->type_name("ADDRESS:PORT")
      ->check(longreach::address_by_its_form())
      ->capture_default_str();
  return longreach::guarded_main(app, argc, argv, [&options] { return longreach::serve(options); });
}
