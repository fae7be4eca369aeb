// longreach-mujoco: the robot of an MJCF file or a URDF, simulated by MuJoCo, behind the adapter protocol.

#include <google/protobuf/text_format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/robot/robot_file.hpp"
#include "common/program/program_text.hpp"
#include "deploy/mujoco/description.hpp"
#include "deploy/mujoco/server.hpp"
#include "deploy/mujoco/window.hpp"

namespace {

/// An error with the option of this program instead of the field of the configuration.
std::string with_option(std::string text) {
  for (const std::string_view field : {"robot.base_link or robot.tip_link", "robot.tip_link"})
    if (const std::size_t at = text.find(field); at != std::string::npos)
      text.replace(at, field.size(), "--tool");
  return text;
}

volatile std::sig_atomic_t ended = 0, reset = 0;
void end(int) { ended = 1; }
void ask_reset(int) { reset = 1; }

struct Words {
  std::string scene, address, write_robot, robot;
  bool view = false;
  std::vector<double> force_bias{}, moment_bias{};
  longreach::MujocoOptions world{};
  longreach::ServerOptions server{};
};

void declare(CLI::App& app, Words& w) {
  app.add_option("SCENE", w.scene, "MJCF file with the robot and its surroundings, or URDF of an arm")
      ->required()
      ->type_name("SCENE.xml|ARM.urdf");
  app.add_option("ADDRESS", w.address, "address of the socket that longreach-slave --adapter connects to")
      ->type_name("unix:/PATH");
  app.add_option("--site", w.world.site, "site of the tool frame, with a force and a torque sensor")
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--tool", w.world.tool_link,
                 "link of a URDF whose frame is the tool frame; default: the only end link behind six joints")
      ->type_name("LINK");
  app.add_option(
         "--servo-hz", w.world.servo_hz,
         "bandwidth of the joints by computed torque; default: the position actuators of the file, or 10 Hz if a joint "
         "has none")
      ->check(CLI::Range(0.1, 100.0));
  app.add_option("--gripper", w.world.gripper,
                 "actuator of the gripper, which closes at the upper end of its ctrlrange")
      ->type_name("NAME");
  app.add_option("--force-noise", w.world.force_noise_n, "standard deviation of the noise of the force, N")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--moment-noise", w.world.moment_noise_nm, "the same for the moment, N m")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--force-bias", w.force_bias, "constant error of the force along the axes of the site, N")
      ->expected(3)
      ->check(CLI::Range(-1000.0, 1000.0))
      ->type_name("X Y Z");
  app.add_option("--moment-bias", w.moment_bias, "the same for the moment, N m")
      ->expected(3)
      ->check(CLI::Range(-1000.0, 1000.0))
      ->type_name("X Y Z");
  app.add_option("--seed", w.world.seed, "seed of the noise")->capture_default_str();
  app.add_option("--rate", w.server.rate_hz, "datagrams per second")
      ->check(CLI::Range(500.0, 4000.0))
      ->capture_default_str();
  app.add_option("--latency", w.server.latency_s, "age of the data that is sent, s")
      ->check(CLI::Range(0.0, 0.015))
      ->capture_default_str();
  app.add_flag("--view", w.view, "open a window that shows the world; R in it returns to the start");
  app.add_option("--robot", w.robot, "robot file to compare with the arm of SCENE.xml before serving")
      ->type_name("FILE");
  app.add_option("--write-robot", w.write_robot, "write the robot file of the arm for the slave (robot_file)")
      ->type_name("FILE");
  app.footer(
      "Example:\n"
      "  longreach-mujoco arm.xml --write-robot arm.txtpb\n"
      "  longreach-mujoco arm.xml unix:/run/user/1000/robot\n"
      "  longreach-mujoco arm.urdf unix:/run/user/1000/robot --tool flange\n"
      "  longreach-slave --adapter unix:/run/user/1000/robot --set robot_file=$PWD/arm.txtpb\n"
      "The signal USR1 returns the world to its start: the slave ends the engagement then.");
}

void write_robot(const longreach::proto::Robot& robot, const std::string& file) {
  std::string text;
  google::protobuf::TextFormat::PrintToString(robot, &text);
  std::ofstream out(file);
  if (!(out
        << "# What the file does not contain of speeds and accelerations has default values. Set those of your arm.\n"
        << text)
           .flush())
    throw std::runtime_error(file + ": cannot be written");
}

longreach::Vector3 vector_of(const std::vector<double>& given) {
  return given.empty() ? longreach::Vector3::Zero() : longreach::Vector3(given[0], given[1], given[2]);
}

void run(Words& w) {
  constexpr std::string_view kUnix = "unix:";
  if (w.address.empty() && w.write_robot.empty())
    throw std::invalid_argument("nothing to do: give an ADDRESS to serve the robot, or --write-robot FILE");
  if (!w.address.empty() && !(w.address.starts_with("unix:/")))
    throw std::invalid_argument(w.address + ": an address is unix:/PATH");
  if (w.view && w.address.empty()) throw std::invalid_argument("--view: give an ADDRESS to serve the robot");
  w.world.bias = {.moment = vector_of(w.moment_bias), .force = vector_of(w.force_bias)};
  longreach::MujocoWorld world(w.scene, w.world);
  for (const std::string& note : world.notes())
    std::fprintf(stderr, "longreach-mujoco: warning: %s\n", note.c_str());
  const double steps = 1.0 / (w.server.rate_hz * world.time_step_s());
  if (std::abs(steps - std::round(steps)) > 1e-6 || steps < 0.5)
    throw std::invalid_argument(w.scene + ": the time step of " + std::to_string(world.time_step_s()) +
                                " s does not divide the period of " + std::to_string(1.0 / w.server.rate_hz) +
                                " s (--rate)");
  const longreach::proto::Robot robot = longreach::describe(world, w.scene);
  longreach::require_same(robot, "the description", world, w.scene);
  if (!w.robot.empty())
    longreach::require_same(longreach::read_robot_file(w.robot, {}).robot, w.robot, world, w.scene);
  if (!w.write_robot.empty()) write_robot(robot, w.write_robot);
  if (w.address.empty()) return;
  w.server.path = w.address.substr(kUnix.size());
  const auto window = w.view ? std::make_unique<longreach::MujocoWindow>(world) : nullptr;
  longreach::serve(world, w.server, [&] {
    if (window) window->show();
    if (ended != 0 || (window && window->closed())) return longreach::ServerRequest::kEnd;
    const bool signalled = reset != 0;
    reset = 0;
    const bool resets = (window && window->takes_reset()) || signalled;
    return resets ? longreach::ServerRequest::kReset : longreach::ServerRequest::kNothing;
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Serves the robot of an MJCF file or a URDF, simulated by MuJoCo in real time, to longreach-slave.",
      "longreach-mujoco"};
  Words words;
  app.set_version_flag("--version", "longreach-mujoco " LONGREACH_VERSION);
  longreach::add_manual_options(app, "longreach-mujoco " LONGREACH_VERSION);
  declare(app, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const int status = app.exit(problem);
    return status == 0 ? 0 : 2;
  }
  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  action.sa_handler = ask_reset;
  sigaction(SIGUSR1, &action, nullptr);
  try {
    run(words);
  } catch (const longreach::ConfigError& problem) {
    std::fprintf(stderr, "longreach-mujoco: %s\n", problem.what());
    return 2;
  } catch (const std::invalid_argument& problem) {
    std::fprintf(stderr, "longreach-mujoco: %s\n", with_option(problem.what()).c_str());
    return 2;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "longreach-mujoco: %s\n", problem.what());
    return 1;
  }
  return 0;
}
