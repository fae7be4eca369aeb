#include "deploy/cli/adapter/adapter_words.hpp"

#include "common/config/adapter_address.hpp"
#include "deploy/cli/argument_checks.hpp"

namespace longreach {
namespace {

constexpr const char* kAdapterCheckMore =
    R"(Sends valid and invalid datagrams to the adapter for ten seconds, and checks its rate, sequence numbers and
watchdog, and its reaction to invalid datagrams and restarts. Disconnect all other programs from the adapter first.
THE DEVICE PUSHES with --force along z: hold it or keep clear; it must report its force in force_n. A robot is
commanded to stay in place; with --move THE ROBOT MOVES its first joint. --push instead prompts you to push the tool
along x, y and z of the robot's base and to turn it about these axes. The check then reports setup errors: wrong sign
or axes, forces given in the base frame instead of the tool frame, uncompensated tool weight, a dead channel, or joint
angles in degrees. The exit status is 1 if a rule is violated; each reported violation includes a remedy. The rules are
in common/link/adapter_datagram.hpp.
Example: longreach adapter check --robot unix:/run/user/1000/robot --move 0.01)";

}  // namespace

void AdapterWords::declare(CLI::App& app) {
  CLI::App* adapter = app.add_subcommand("adapter", "test the adapter of a real device or robot");
  adapter->footer("Example: longreach adapter check --device unix:/run/user/1000/device");
  adapter->fallthrough();  // accepts --json and --timeout after the command, too
  adapter->require_subcommand(1);
  CLI::App* check = adapter->add_subcommand("check", "check that the adapter follows the protocol rules");
  check->footer(kAdapterCheckMore);
  check->fallthrough();
  check->add_option("--device", device_, "adapter of a haptic device")->type_name("unix:/PATH");
  check->add_option("--robot", robot_, "adapter of a robot")->type_name("unix:/PATH");
  check->add_option("--force", force_, "commanded force of the device, 0.01 to 10 N [0.5]")->type_name("N");
  check
      ->add_option("--device-file", device_file_,
                   "device file: compare the positions of the handle with the workspace")
      ->type_name("FILE");
  check
      ->add_option("--move", move_,
                   "commanded displacement of the robot's first joint, -0.5 to 0.5 rad or m [0]")
      ->type_name("RAD");
  check->add_flag(
      "--push", push_,
      "instead of the other checks, prompt you to push and turn the tool, and check the sign, axes "
      "and zero offset of the force sensor");
  check->add_option("--robot-file", robot_file_, "robot file, for --push")->type_name("FILE");
  check->add_option("--patience", push_timeout_, "time limit for each push, 1 to 600 s [30]")->type_name("N");
}

AdapterCheckCommand AdapterWords::command() const {
  if (device_.empty() == robot_.empty())
    throw UsageError("adapter check needs --device unix:/PATH or --robot unix:/PATH, the adapter's socket");
  AdapterCheckCommand check;
  check.robot = !robot_.empty();
  check.address = check.robot ? robot_ : device_;
  if (const std::string why = adapter_address_trouble(check.address); !why.empty())
    throw UsageError((check.robot ? "--robot = " : "--device = ") + check.address + why);
  check.force_n = bounded("--force", force_, parse_number(force_), 0.01, 10.0, " N");
  check.move = bounded("--move", move_, parse_number(move_), -0.5, 0.5, " rad or m");
  check.device_file = device_file_;
  if (check.robot && !check.device_file.empty())
    throw UsageError("adapter check --device-file needs --device unix:/PATH, the adapter of a haptic device");
  check.push = push_;
  check.robot_file = robot_file_;
  check.push_timeout_s = bounded("--patience", push_timeout_, parse_number(push_timeout_), 1.0, 600.0, " s");
  if (check.push && (!check.robot || check.robot_file.empty()))
    throw UsageError(
        "adapter check --push needs --robot unix:/PATH and --robot-file FILE, the robot file of "
        "longreach-slave");
  return check;
}

}  // namespace longreach
