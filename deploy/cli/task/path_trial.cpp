#include <iostream>
#include <optional>

#include "common/text/number_text.hpp"
#include "deploy/cli/frames.hpp"
#include "deploy/cli/task/conduct.hpp"
#include "deploy/cli/task/path_progress.hpp"
#include "deploy/cli/task/task_trial.hpp"

namespace longreach {
namespace {

class PathTrial : public TaskTrial {
 public:
  PathTrial(const Options& options, const TaskCommand& command, PathProgress progress)
      : json_(options.json), limit_s_(command.limit_s), progress_(std::move(progress)) {}

  bool step(const proto::Frame& frame) override {
    if (!frame.view().far_known()) return true;
    const PathPhase before = progress_.phase();
    const int passed = before == PathPhase::kUnderway ? progress_.figures().passed : 0;
    progress_.step(frame.seconds(), tool_m(frame));
    const PathPhase phase = progress_.phase();
    if (phase == PathPhase::kAway && !asked_) {
      say("bring the tool to the start of the path; it is " + in_millimetres(progress_.error_m()) +
          " beside the path");
      asked_ = true;
    }
    if (phase == PathPhase::kReady && before != phase)
      say("the tool is at the start; the time begins when it leaves it");
    if (phase != PathPhase::kUnderway && phase != PathPhase::kDone) return true;
    if (before == PathPhase::kReady) watch_.begin(frame);
    watch_.step(frame);
    const PathFigures figures = progress_.figures();
    if (figures.passed > passed)
      say("ball " + std::to_string(figures.passed) + " of " + std::to_string(progress_.balls()) +
          " passed after " + fixed_digits(figures.time_s, 1) + " s");
    return phase != PathPhase::kDone && figures.time_s < limit_s_;
  }

  [[nodiscard]] bool begun() const override { return progress_.phase() >= PathPhase::kUnderway; }
  [[nodiscard]] bool finished() const override { return progress_.phase() == PathPhase::kDone; }

  [[nodiscard]] std::string cells() const override {
    const PathFigures f = progress_.figures();
    const Conduct& c = watch_.conduct();
    std::string text = c.mode();
    for (const double number : {c.rtt_s, c.scale, c.kv_per_s, finished() ? 1.0 : 0.0, f.time_s,
                                f.mean_error_m, f.max_error_m, static_cast<double>(f.passed),
                                static_cast<double>(progress_.balls()), static_cast<double>(c.repositionings),
                                static_cast<double>(c.holds), c.tool_force_max_n, c.hand_force_max_n})
      text.append(",").append(format_number(number));
    return text;
  }

  [[nodiscard]] std::string sentence() const override {
    const PathFigures f = progress_.figures();
    const Conduct& c = watch_.conduct();
    return std::string(finished() ? "target reached" : "not finished") + " after " +
           fixed_digits(f.time_s, 1) + " s in " + c.mode() + " mode: " + in_millimetres(f.mean_error_m) +
           " from the path on average, at most " + in_millimetres(f.max_error_m) + "; " +
           std::to_string(f.passed) + " of " + std::to_string(progress_.balls()) + " balls, " + in_words(c);
  }

 private:
  void say(const std::string& sentence) const {
    if (!json_) std::cout << sentence << std::endl;
  }

  bool json_;
  double limit_s_;
  PathProgress progress_;
  ConductWatch watch_{};
  bool asked_ = false;
};

}  // namespace

std::unique_ptr<TaskTrial> path_trial(const Options& options, const TaskCommand& command, SideClient& slave) {
  const auto progress = path_of(slave.part<proto::Robot>("robot"), slave.part<proto::Scene>("scene"));
  if (!progress)
    throw SideError(SideError::Kind::kRefused,
                    "the slave's scene has no path; start it with --set scene_file=scenes/path.txtpb");
  return std::make_unique<PathTrial>(options, command, *progress);
}

}  // namespace longreach
