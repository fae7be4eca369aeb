// longreach task: judges how a person does a task by hand, from the frames of the master, and draws the order of the trials
// of a participant.

#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "common/core/random.hpp"
#include "common/loop/stop_signal.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/frames.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/task/task_trial.hpp"

namespace longreach {
namespace {

constexpr double kTaskFrameHz = 60.0;
constexpr const char* kFirstColumns = "participant,task,trial,";

/// The file of a study. Throws UsageError if it cannot be continued.
class StudyFile {
 public:
  /// `begins`: first cells of the rows of a participant with one task.
  StudyFile(const std::string& name, const std::string& header, const std::string& begins) : name_(name) {
    if (name.empty()) return;
    std::ifstream in(name);
    std::string line;
    bool first = true;
    for (; std::getline(in, line); first = false) {
      if (first && line != header)
        throw UsageError("--csv = " + name + " has other columns in line 1; name a new file");
      if (line.starts_with(begins)) ++trials_;
    }
    out_.open(name, std::ios::app);
    if (first) out_ << header << "\n";
    if (!out_.flush()) throw UsageError("--csv = " + name + " cannot be written");
  }
  [[nodiscard]] int next_trial() const { return trials_ + 1; }
  void add(const std::string& row) {
    if (name_.empty()) return;
    out_ << row + "\n";
    if (!out_.flush()) throw SideError(SideError::Kind::kRefused, name_ + " cannot be written: " + row);
  }

 private:
  std::string name_;
  int trials_ = 0;
  std::ofstream out_{};
};

std::unique_ptr<TaskTrial> trial_of(const Options& options, const TaskCommand& command) {
  SideClient slave(Side::kSlave, options);
  try {
    return command.what == TaskCommand::What::kDock ? dock_trial(options, command, slave)
                                                    : path_trial(options, command, slave);
  } catch (const std::invalid_argument& error) {
    throw SideError(SideError::Kind::kRefused, "the slave's scene is invalid: " + std::string(error.what()));
  }
}

ExitStatus judge(const Options& options, const TaskCommand& command) {
  const bool docks = command.what == TaskCommand::What::kDock;
  const std::string header = std::string(kFirstColumns) + (docks ? kDockColumns : kPathColumns);
  const std::string begins = command.participant + (docks ? ",dock," : ",path,");
  StudyFile file(command.csv, header, begins);
  const std::unique_ptr<TaskTrial> trial = trial_of(options, command);
  const auto& stop = stop_requested();
  const std::string why = follow_frames(
      options, kTaskFrameHz, stop, [&](grpc::ClientContext*) { return !stop; },
      [&](const proto::Frame& frame) { return !stop && trial->step(frame); });
  if (!trial->begun()) {
    if (!why.empty()) throw SideError(SideError::Kind::kDown, why);
    print_done(options, "the trial was not begun");
    return ExitStatus::kFailed;
  }
  const std::string row =
      begins + std::to_string(command.trial.value_or(file.next_trial())) + "," + trial->cells();
  if (options.json) {
    std::cout << "{\"columns\":" << json_string(header) << ",\"row\":" << json_string(row) << "}"
              << std::endl;
  } else {
    std::cout << trial->sentence() << std::endl;
  }
  file.add(row);
  if (!why.empty()) throw SideError(SideError::Kind::kDown, why);
  return trial->finished() ? ExitStatus::kDone : ExitStatus::kFailed;
}

ExitStatus draw_order(const Options& options, const TaskCommand& command) {
  std::vector<std::string> trials;
  for (const std::string& mode : command.modes)
    for (const std::string& link : command.links)
      for (int n = 0; n < command.trials; ++n) trials.push_back(mode + "," + link);
  Random random = Random(0).child(command.participant);
  for (std::size_t i = trials.size(); i > 1; --i) std::swap(trials[i - 1], trials[random.next() % i]);
  std::string text = options.json ? "" : "trial,mode,link\n";
  for (std::size_t i = 0; i < trials.size(); ++i)
    text += options.json ? (i > 0 ? "," : "") + json_string(trials[i])
                         : std::to_string(i + 1) + "," + trials[i] + "\n";
  std::cout << (options.json ? "{\"order\":[" + text + "]}\n" : text) << std::flush;
  return ExitStatus::kDone;
}

}  // namespace

ExitStatus run_task(const Options& options, const TaskCommand& command) {
  return command.what == TaskCommand::What::kOrder ? draw_order(options, command) : judge(options, command);
}

}  // namespace longreach
