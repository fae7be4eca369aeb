#include "deploy/cli/robot/robot_words.hpp"

#include "common/config/robot/urdf.hpp"

namespace longreach {
namespace {

constexpr const char* kMore =
    R"(FILE is a .urdf or .txtpb file, or the name of a robot in deploy/robots. Neither side needs to be running.
Example: longreach robot show ur10)";

constexpr const char* kShowMore =
    R"(Prints the joints with their limits, the inverse kinematics method, the reach of the tool, and the singular poses,
in which the tool cannot move in some direction.
Examples:
  longreach robot show ur10
  longreach robot show mine.urdf --tip-link tool0 --picture mine.svg)";

constexpr const char* kConvertMore =
    R"(Prints the robot in the other format. Acceleration limits, jerk limits and the start pose can be
stored only with Denavit-Hartenberg rows, not in a URDF.
Examples:
  longreach robot convert mine.urdf > mine.txtpb
  longreach robot convert puma560 > puma560.urdf)";

CLI::App* declare_below(CLI::App& parent, const char* name, const char* help, const char* more) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->footer(more);
  command->fallthrough();
  return command;
}

}  // namespace

void RobotWords::declare(CLI::App& app) {
  robot_ = declare_below(app, "robot", "show or convert a robot file", kMore);
  robot_->require_subcommand(1);
  CLI::App* show = declare_below(
      *robot_, "show", "show joints, limits, inverse kinematics, reach and singular poses", kShowMore);
  CLI::App* convert = declare_below(
      *robot_, "convert", "convert Denavit-Hartenberg rows to a URDF, or a URDF to rows", kConvertMore);
  for (CLI::App* command : {show, convert}) {
    command->add_option("FILE", file_, "a .urdf or .txtpb file, or the name of a robot")->required();
    command->add_option("--base-link", base_link_, "for a URDF: the base link of the arm [the root link]")
        ->type_name("LINK");
    command
        ->add_option("--tip-link", tip_link_,
                     "for a URDF: the tool link [the only end link with six moving joints before it]")
        ->type_name("LINK");
  }
  show->add_option("--picture", picture_, "write a picture of the arm in its start pose (SVG)")
      ->type_name("FILE");
  convert->add_option("--to", form_, "output format, urdf or rows [the one that FILE does not have]")
      ->transform(CLI::IsMember({"urdf", "rows"}, CLI::ignore_case))
      ->type_name("FORM");
}

RobotCommand RobotWords::command() const {
  using What = RobotCommand::What;
  RobotCommand command{What::kShow, file_, base_link_, tip_link_, picture_};
  if (robot_->got_subcommand("show")) return command;
  const bool to_urdf = form_.empty() ? !is_urdf(file_) : form_ == "urdf";
  command.what = to_urdf ? What::kUrdf : What::kDenavitHartenberg;
  return command;
}

}  // namespace longreach
