#include "deploy/cli/task/task_words.hpp"

#include <cstdint>
#include <sstream>

#include "common/text/number_text.hpp"
#include "deploy/cli/argument_checks.hpp"

namespace longreach {
namespace {

constexpr const char* kPathMore =
    R"(The slave needs a scene with a path, for example --set scene_file=scenes/path.txtpb; longreach demo --task path starts
both sides with it. The time begins when the tool leaves the start of the path. A ball at each turn is passed when the tool
passes the middle of the turn. When all balls are passed, the trial ends at the target, the end of the path. Prints the time,
the mean and largest distance from the path, and how often the handle was repositioned, and appends a row to a CSV file. The
page of longreach view shows the same figures.
Example: longreach task path --participant p07 --csv study.csv)";
constexpr const char* kDockMore =
    R"(The slave needs a scene with the goal of a free body, for example --set scene_file=scenes/dock.txtpb; longreach demo
--task dock starts both sides with it. The time begins when the tool moves. The body must be grasped, brought to its goal,
pressed until the force vanishes, because the latch yields, and released; the trial ends when the tool has retreated. Prints the
time, the distance and the angle of the body from its goal, how often the handle was repositioned and the largest forces,
and appends a row to a CSV file.
Example: longreach task dock --participant p07 --csv docking.csv)";
constexpr const char* kOrderMore =
    R"(Each trial is a mode, a link profile and its number. The order is random, and always the same for a participant.
Example: longreach task order --participant p07 --modes rate,position --links lab,moon --trials 3)";

std::vector<std::string> split(const char* option, const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) {
    if (word.empty()) throw UsageError(std::string(option) + " = " + list + " has an empty name");
    words.push_back(word);
  }
  return words;
}

/// Goes into a cell of a CSV file as it is.
const std::string& code(const std::string& participant) {
  if (participant.find_first_of(",\"\r\n") != std::string::npos)
    throw UsageError("--participant = " + participant + " contains a comma, a quote or a line break");
  return participant;
}

int whole(const char* option, const std::string& word) {
  const auto number = parse_integer<std::uint32_t>(word);
  if (!number || *number < 1 || *number > 1000)
    throw UsageError(std::string(option) + " = " + word + " is not a whole number from 1 to 1000");
  return static_cast<int>(*number);
}

}  // namespace

void TaskWords::declare(CLI::App& app) {
  task_ = app.add_subcommand("task", "judge how a person does a task by hand, or draw the order of trials");
  task_->require_subcommand(1);
  task_->fallthrough();
  CLI::App* path = task_->add_subcommand("path", "follow the path of the scene to its target");
  path->footer(kPathMore);
  CLI::App* dock = task_->add_subcommand("dock", "grasp a free body of the scene and dock it at its goal");
  dock->footer(kDockMore);
  for (CLI::App* task : {path, dock}) {
    task->fallthrough();
    task->add_option("--participant", participant_, "code of the person, for the CSV file")
        ->type_name("CODE");
    task->add_option("--trial", trial_,
                     "number of the trial, for the CSV file [the next one of the participant]")
        ->type_name("N");
    task->add_option("--csv", csv_, "file to which the row of figures is appended; created if missing")
        ->type_name("FILE");
    task->add_option("--limit", limit_, "the trial ends after this time, 1 to 36000 s [600]")->type_name("S");
  }
  CLI::App* order = task_->add_subcommand("order", "draw the order of the trials of a participant");
  order->footer(kOrderMore);
  order->add_option("--participant", participant_, "code of the person")->type_name("CODE")->required();
  order->add_option("--modes", modes_, "modes [" + modes_ + "]")->type_name("NAME,...");
  order->add_option("--links", links_, "link profiles [" + links_ + "]")->type_name("NAME,...");
  order->add_option("--trials", trials_, "trials with each mode and link, 1 to 1000 [2]")->type_name("N");
}

TaskCommand TaskWords::command() const {
  TaskCommand command;
  command.participant = code(participant_);
  if (task_->get_subcommand("order")->parsed()) {
    command.what = TaskCommand::What::kOrder;
    command.modes = split("--modes", modes_);
    command.links = split("--links", links_);
    command.trials = whole("--trials", trials_);
    return command;
  }
  if (task_->get_subcommand("dock")->parsed()) command.what = TaskCommand::What::kDock;
  if (!trial_.empty()) command.trial = whole("--trial", trial_);
  command.csv = csv_;
  command.limit_s = bounded("--limit", limit_, parse_seconds(limit_), 1.0, 36000.0, " s");
  return command;
}

}  // namespace longreach
