#include <iostream>
#include <optional>

#include "common/text/number_text.hpp"
#include "deploy/cli/frames.hpp"
#include "deploy/cli/task/conduct.hpp"
#include "deploy/cli/task/dock_progress.hpp"
#include "deploy/cli/task/task_trial.hpp"

namespace longreach {
namespace {

constexpr double kNoBody_s = 5.0;  // without a pose of the body, until that is reported

/// The pose of a body by its number, if the master has received it.
std::optional<Pose> body_pose(const recording::BodyPoses& bodies, int number) {
  const auto* field = recording::BodyPoses::descriptor()->FindFieldByName("body" + std::to_string(number));
  const auto* reflection = bodies.GetReflection();
  if (field == nullptr || !reflection->HasField(bodies, field)) return std::nullopt;
  const auto& pose = static_cast<const recording::BodyPose&>(reflection->GetMessage(bodies, field)).pose();
  const recording::Vector& p = pose.position_m();
  const recording::Quaternion& q = pose.orientation();
  return Pose{{p.x(), p.y(), p.z()}, Quaternion(q.w(), q.x(), q.y(), q.z())};
}

class DockTrial : public TaskTrial {
 public:
  DockTrial(const Options& options, const TaskCommand& command, DockProgress progress)
      : json_(options.json), limit_s_(command.limit_s), progress_(std::move(progress)) {}

  bool step(const proto::Frame& frame) override {
    const recording::MasterView& view = frame.view();
    if (!view.far_known()) return true;
    if (!first_s_) {
      first_s_ = frame.seconds();
      say("the time begins when the tool moves");
    }
    const DockPhase before = progress_.phase();
    progress_.step({.t_s = frame.seconds(),
                    .tool_m = tool_m(frame),
                    .X_WB = body_pose(view.bodies(), progress_.body()),
                    .holds = view.far().load(),
                    .force_n = norm_of(view.far().wrench().force_n())});
    const DockPhase phase = progress_.phase();
    if (!progress_.body_known() && !asked_ && frame.seconds() > *first_s_ + kNoBody_s) {
      say("the slave reports no pose of body " + std::to_string(progress_.body()) +
          ", so that it is not judged");
      asked_ = true;
    }
    if (phase == DockPhase::kWaiting) return true;
    if (before == DockPhase::kWaiting) watch_.begin(frame);
    watch_.step(frame);
    if (phase != before) report(before, phase);
    return phase != DockPhase::kDone && progress_.figures().time_s < limit_s_;
  }

  [[nodiscard]] bool begun() const override { return progress_.phase() != DockPhase::kWaiting; }
  [[nodiscard]] bool finished() const override { return progress_.phase() == DockPhase::kDone; }

  [[nodiscard]] std::string cells() const override {
    const DockFigures& f = progress_.figures();
    const Conduct& c = watch_.conduct();
    std::string text = c.mode();
    for (const double number :
         {c.rtt_s, c.scale, c.kv_per_s, finished() ? 1.0 : 0.0, f.time_s, f.grasp_s, f.seat_s,
          f.position_error_m, f.angle_error_rad, static_cast<double>(c.repositionings),
          static_cast<double>(c.holds), f.seat_force_n, c.tool_force_max_n, c.hand_force_max_n})
      text.append(",").append(format_number(number));
    return text;
  }

  [[nodiscard]] std::string sentence() const override {
    const DockFigures& f = progress_.figures();
    const Conduct& c = watch_.conduct();
    return std::string(finished() ? "docked" : "not finished") + " after " + fixed_digits(f.time_s, 1) +
           " s in " + c.mode() + " mode: " + in_millimetres(f.position_error_m) + " and " +
           fixed_digits(1e3 * f.angle_error_rad, 1) + " mrad from the goal; " + in_words(c);
  }

 private:
  void report(DockPhase before, DockPhase phase) const {
    const DockFigures& f = progress_.figures();
    const std::string after = " after " + fixed_digits(f.time_s, 1) + " s";
    const std::string off = ", " + in_millimetres(f.position_error_m) + " from its goal";
    if (phase == DockPhase::kHeld)
      say((before == DockPhase::kBegun ? "the body is held" : "the body has left its goal") + after);
    if (phase == DockPhase::kSeated && before != DockPhase::kReleased)
      say("the body is at its goal" + after + ": the force rose to " + fixed_digits(f.seat_force_n, 1) +
          " N and vanished; release it and retreat");
    if (phase == DockPhase::kReleased) say("the body is released" + after + "; retreat");
    if (phase == DockPhase::kBegun && before != DockPhase::kWaiting) say("the body was lost" + after + off);
  }

  void say(const std::string& sentence) const {
    if (!json_) std::cout << sentence << std::endl;
  }

  bool json_;
  double limit_s_;
  DockProgress progress_;
  ConductWatch watch_{};
  std::optional<double> first_s_{};
  bool asked_ = false;
};

}  // namespace

std::unique_ptr<TaskTrial> dock_trial(const Options& options, const TaskCommand& command, SideClient& slave) {
  const auto progress = dock_of(slave.part<proto::Robot>("robot"), slave.part<proto::Scene>("scene"));
  if (!progress)
    throw SideError(
        SideError::Kind::kRefused,
        "the slave's scene has no goal for a body; start it with --set scene_file=scenes/dock.txtpb");
  return std::make_unique<DockTrial>(options, command, *progress);
}

}  // namespace longreach
