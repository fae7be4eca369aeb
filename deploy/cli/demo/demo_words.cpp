#include "deploy/cli/demo/demo_words.hpp"

#include <utility>

namespace longreach {
namespace {

constexpr const char* kDemoMore =
    R"(Starts longreach-slave in the background and longreach-master with its live view, emulates the delay of a real
link between them, and prints the address of a browser page where you can observe the run or take control of the hand.
The exit status is 0 if every check in the summary holds.
Example: longreach demo --seconds 30)";

}  // namespace

void DemoWords::declare(CLI::App& app) {
  demo_ = app.add_subcommand("demo", "run both sides on this machine with a simulated robot and operator");
  demo_->footer(kDemoMore);
  demo_
      ->add_option("--profile", profile_,
                   "profile of the link between the two sides: a name in links, or a .txtpb file [moon]")
      ->type_name("NAME");
  demo_
      ->add_option("--operator", operator_,
                   "script: a simulated operator; keyboard: you, with the keyboard (? shows the "
                   "keys); none: you, on the page [script]")
      ->check(CLI::IsMember({"script", "keyboard", "none"}))
      ->type_name("KIND");
  demo_->add_option("--robot", robot_, "name of a robot, or a .txtpb or .urdf file [space_arm]")
      ->type_name("NAME");
  demo_
      ->add_option(
          "--seconds", seconds_,
          "duration of the run, s; holds caused by a busy machine prolong it [60; with --task: 1800]")
      ->type_name("N");
  demo_
      ->add_option("--task", task_,
                   "a task for you: follow a path, or grasp and dock a spacecraft; with the keyboard on a "
                   "terminal, else on the page")
      ->check(CLI::IsMember({"path", "dock"}))
      ->type_name("NAME");
  demo_->add_option("--set", settings_, "set a configuration field on one side or both; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  demo_->add_option("--logs", logs_, "folder for the log of the slave [$XDG_STATE_HOME/longreach/demo]")
      ->type_name("DIR");
}

DemoCommand DemoWords::command() const {
  DemoCommand command;
  command.logs = logs_;
  const std::pair<const char*, const std::string&> given[] = {{"--profile", profile_},
                                                              {"--operator", operator_},
                                                              {"--robot", robot_},
                                                              {"--seconds", seconds_},
                                                              {"--task", task_}};
  for (const auto& [option, value] : given) {
    if (demo_->count(option) > 0) command.arguments.insert(command.arguments.end(), {option, value});
  }
  for (const std::string& setting : settings_)
    command.arguments.insert(command.arguments.end(), {"--set", setting});
  return command;
}

}  // namespace longreach
