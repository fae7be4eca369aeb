// longreach task: judges how a person does a task by hand, from the frames of the master, and draws the order of the trials
// of a participant.

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "common/core/random.hpp"
#include "common/loop/stop_signal.hpp"
#include "common/text/number_text.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/frames.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/task/path_progress.hpp"

namespace longreach {
namespace {

constexpr double kTaskFrameHz = 60.0;
constexpr const char* kHeader =
    "participant,task,trial,mode,rtt_s,scale,kv_per_s,finished,time_s,mean_error_m,max_error_m,balls_passed,balls,"
    "repositionings,holds,tool_force_max_n,hand_force_max_n";

/// What happened during the attempt, besides the path.
struct Conduct {
  bool rate = false, position = false;  // modes that were used
  int repositionings = 0;
  std::uint64_t holds = 0;
  double tool_force_max_n = 0.0, hand_force_max_n = 0.0;
  double rtt_s = 0.0, scale = 0.0, kv_per_s = 0.0;

  [[nodiscard]] const char* mode() const { return rate && position ? "hybrid" : rate ? "rate" : "position"; }
};

double norm_of(const recording::Vector& v) { return Vector3(v.x(), v.y(), v.z()).norm(); }

/// The file of a study. Throws UsageError if it cannot be continued.
class StudyFile {
 public:
  StudyFile(const std::string& name, const std::string& participant) : name_(name) {
    if (name.empty()) return;
    std::ifstream in(name);
    std::string line;
    bool first = true;
    for (; std::getline(in, line); first = false) {
      if (first && line != kHeader)
        throw UsageError("--csv = " + name + " has other columns in line 1; name a new file");
      if (line.starts_with(participant + ",path,")) ++trials_;
    }
    out_.open(name, std::ios::app);
    if (first) out_ << kHeader << "\n";
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

class PathTrial {
 public:
  PathTrial(const Options& options, const TaskCommand& command, PathProgress progress)
      : json_(options.json), limit_s_(command.limit_s), progress_(std::move(progress)) {}

  /// Returns false at the end of the trial.
  bool step(const proto::Frame& frame) {
    const recording::MasterView& view = frame.view();
    if (!view.far_known()) return true;
    const PathPhase before = progress_.phase();
    const int passed = before == PathPhase::kUnderway ? progress_.figures().passed : 0;
    progress_.step(frame.seconds(), tool_m(frame));
    const PathPhase phase = progress_.phase();
    if (phase == PathPhase::kAway && !asked_) {
      say("bring the tool to the start of the path; it is " + millimetres(progress_.error_m()) +
          " beside the path");
      asked_ = true;
    }
    if (phase == PathPhase::kReady && before != phase)
      say("the tool is at the start; the time begins when it leaves it");
    if (phase != PathPhase::kUnderway && phase != PathPhase::kDone) return true;
    if (before == PathPhase::kReady) {
      conduct_ = {};
      holds_before_ = view.holds();
      clutched_ = view.clutched();
    }
    watch(frame);
    const PathFigures figures = progress_.figures();
    if (figures.passed > passed)
      say("ball " + std::to_string(figures.passed) + " of " + std::to_string(progress_.balls()) +
          " passed after " + fixed(figures.time_s, 1) + " s");
    return phase != PathPhase::kDone && figures.time_s < limit_s_;
  }

  [[nodiscard]] bool begun() const { return progress_.phase() >= PathPhase::kUnderway; }
  [[nodiscard]] bool finished() const { return progress_.phase() == PathPhase::kDone; }

  [[nodiscard]] std::string row(const std::string& participant, int trial) const {
    const PathFigures f = progress_.figures();
    const Conduct& c = conduct_;
    std::string text = participant + ",path," + std::to_string(trial) + "," + c.mode();
    for (const double number : {c.rtt_s, c.scale, c.kv_per_s, finished() ? 1.0 : 0.0, f.time_s,
                                f.mean_error_m, f.max_error_m, static_cast<double>(f.passed),
                                static_cast<double>(progress_.balls()), static_cast<double>(c.repositionings),
                                static_cast<double>(c.holds), c.tool_force_max_n, c.hand_force_max_n})
      text += "," + format_number(number);
    return text;
  }

  [[nodiscard]] std::string sentence() const {
    const PathFigures f = progress_.figures();
    const Conduct& c = conduct_;
    return std::string(finished() ? "target reached" : "not finished") + " after " + fixed(f.time_s, 1) +
           " s in " + c.mode() + " mode: " + millimetres(f.mean_error_m) +
           " from the path on average, at most " + millimetres(f.max_error_m) + "; " +
           std::to_string(f.passed) + " of " + std::to_string(progress_.balls()) + " balls, " +
           std::to_string(c.repositionings) + " repositionings, " + std::to_string(c.holds) +
           " holds; at most " + fixed(c.tool_force_max_n, 1) + " N at the tool and " +
           fixed(c.hand_force_max_n, 1) + " N at the hand";
  }

 private:
  static std::string fixed(double value, int digits) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return text.str();
  }
  static std::string millimetres(double metres) { return fixed(1e3 * metres, 1) + " mm"; }

  void watch(const proto::Frame& frame) {
    const recording::MasterView& view = frame.view();
    Conduct& c = conduct_;
    (view.mode() == recording::RATE ? c.rate : c.position) = true;
    c.repositionings += view.clutched() && !clutched_;
    clutched_ = view.clutched();
    c.holds = view.holds() - holds_before_;
    c.tool_force_max_n = std::max(c.tool_force_max_n, norm_of(view.far().wrench().force_n()));
    c.hand_force_max_n = std::max(c.hand_force_max_n, norm_of(view.spring_force_n()));
    c.rtt_s = frame.link().rtt_s();
    c.scale = view.scale();
    c.kv_per_s = view.kv_per_s();
  }

  void say(const std::string& sentence) const {
    if (!json_) std::cout << sentence << std::endl;
  }

  bool json_;
  double limit_s_;
  PathProgress progress_;
  Conduct conduct_{};
  bool asked_ = false, clutched_ = false;
  std::uint64_t holds_before_ = 0;
};

ExitStatus judge_path(const Options& options, const TaskCommand& command) {
  StudyFile file(command.csv, command.participant);
  SideClient slave(Side::kSlave, options);
  std::optional<PathProgress> progress;
  try {
    progress = path_of(slave.part<proto::Robot>("robot"), slave.part<proto::Scene>("scene"));
  } catch (const std::invalid_argument& error) {
    throw SideError(SideError::Kind::kRefused, "the slave's scene is invalid: " + std::string(error.what()));
  }
  if (!progress)
    throw SideError(SideError::Kind::kRefused,
                    "the slave's scene has no path; start it with --set scene_file=scenes/path.txtpb");
  PathTrial trial(options, command, *progress);
  const auto& stop = stop_requested();
  const std::string why = follow_frames(
      options, kTaskFrameHz, stop, [&](grpc::ClientContext*) { return !stop; },
      [&](const proto::Frame& frame) { return !stop && trial.step(frame); });
  if (!trial.begun()) {
    if (!why.empty()) throw SideError(SideError::Kind::kDown, why);
    print_done(options, "the trial was not begun");
    return ExitStatus::kFailed;
  }
  const std::string row = trial.row(command.participant, command.trial.value_or(file.next_trial()));
  if (options.json) {
    std::cout << "{\"columns\":" << json_string(kHeader) << ",\"row\":" << json_string(row) << "}"
              << std::endl;
  } else {
    std::cout << trial.sentence() << std::endl;
  }
  file.add(row);
  if (!why.empty()) throw SideError(SideError::Kind::kDown, why);
  return trial.finished() ? ExitStatus::kDone : ExitStatus::kFailed;
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
  return command.what == TaskCommand::What::kOrder ? draw_order(options, command)
                                                   : judge_path(options, command);
}

}  // namespace longreach
