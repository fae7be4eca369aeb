#include "deploy/cli/adapter/adapter_push.hpp"

#include <algorithm>
#include <iostream>

#include "deploy/cli/adapter/adapter_conversation.hpp"
#include "deploy/cli/adapter/adapter_subject.hpp"
#include "deploy/cli/adapter/described_robot.hpp"
#include "deploy/cli/adapter/push_judgement.hpp"

namespace longreach {
namespace {

constexpr double kFelt_n = 4.0, kFelt_nm = 0.4;  // minimum of a push, relative to the report at rest
constexpr double kMoved = 0.02;                  // rad or m; a larger motion means that the robot yielded
constexpr double kStep_s = 0.05;

using adapter::RobotDatagram;
using adapter::SetpointDatagram;

/// Means of the received reports.
struct Told {
  Vector6 joint_rad = Vector6::Zero();
  Vector3 force_n = Vector3::Zero(), moment_nm = Vector3::Zero();
  int count = 0;
};

class Pushing {
 public:
  Pushing(const std::string& address, const std::string& robot_file, double push_timeout_s)
      : robot_(robot_file),
        timeout_s_(push_timeout_s),
        talk_(address, static_cast<std::uint64_t>(AdapterSocket::now_ns())) {
    section_.title = "robot adapter at " + address + ", push test";
  }

  Section run() {
    rest_ = listen(1.0);
    if (rest_.count == 0) {
      section_.findings.push_back(
          {FindingVerdict::kFailure, "answers", nothing_came(),
           "start the adapter, and run `longreach adapter check` without --push first"});
      return std::move(section_);
    }
    judge_joints();
    PushedSensor force{.what = "force", .unit = "N", .rest = rest_.force_n, .rest_max = 2.0};
    PushedSensor moment{.what = "moment", .unit = "N m", .rest = rest_.moment_nm, .rest_max = 0.5};
    for (std::size_t i = 0; i < 3; ++i)
      force.push[i] = ask("PUSH the tool along +", "with about 20 N (the weight of 2 kg)", i, false);
    for (std::size_t i = 0; i < 3; ++i)
      moment.push[i] = ask("TURN the tool about +", "right-handed, with about 2 N m", i, true);
    for (const auto* sensor : {&force, &moment})
      for (Finding& finding : judge_pushes(*sensor)) section_.findings.push_back(std::move(finding));
    judge_way();
    section_.findings.push_back(
        {FindingVerdict::kOk, "not tested",
         "this check does not detect small scale errors or a shifted reference point of the moments"});
    return std::move(section_);
  }

 private:
  [[nodiscard]] std::string nothing_came() const {
    const std::string trouble = talk_.socket().trouble();
    return trouble.empty() ? "no datagram arrived within 1 s" : "cannot connect to the adapter: " + trouble;
  }
  Told listen(double seconds) {
    const auto seen = talk_.talk(seconds, [](double) { return SetpointDatagram{}; });
    Told reported;
    for (const auto& s : seen) {
      ++reported.count;
      const double share = 1.0 / reported.count;
      reported.joint_rad += share * (Eigen::Map<const Vector6>(s.in.joint_rad) - reported.joint_rad);
      reported.force_n += share * (Eigen::Map<const Vector3>(s.in.force_n) - reported.force_n);
      reported.moment_nm += share * (Eigen::Map<const Vector3>(s.in.moment_nm) - reported.moment_nm);
    }
    if (reported.count > 0 && rest_.count > 0)
      moved_ = std::max(moved_, (reported.joint_rad - rest_.joint_rad).cwiseAbs().maxCoeff());
    return reported;
  }
  [[nodiscard]] Vector3 felt(const Told& reported, bool turn) const {
    return turn ? reported.moment_nm - rest_.moment_nm : reported.force_n - rest_.force_n;
  }

  Push ask(const char* what, const char* how, std::size_t i, bool turn) {
    std::cout << what << "xyz"[i] << " of the robot's base, " << how << ", and keep the force constant"
              << std::endl;
    const double least = turn ? kFelt_nm : kFelt_n;
    Push push;
    for (double t_s = 0.0; t_s < timeout_s_; t_s += kStep_s) {
      if (felt(listen(kStep_s), turn).norm() < least) continue;
      listen(0.3);  // until the push is steady
      const Told reported = listen(0.4);
      push.R_WE = robot_.orientation(reported.joint_rad);
      push.reported = felt(reported, turn);
      break;
    }
    std::cout << (push.reported.isZero(0.0) ? "  nothing was measured" : "  measured") << "; release the tool"
              << std::endl;
    for (double t_s = 0.0; t_s < timeout_s_ && felt(listen(kStep_s), turn).norm() > 0.5 * least;
         t_s += kStep_s)
      continue;
    return push;
  }

  void judge_joints() {
    const DescribedRobot::Wrong wrong = robot_.look(rest_.joint_rad);
    if (!wrong.text.empty())
      section_.findings.push_back({FindingVerdict::kFailure, "joints", wrong.text, wrong.advice, {}});
  }
  void judge_way() {
    if (moved_ <= kMoved) return;
    section_.findings.push_back({FindingVerdict::kWarning, "motion",
                                 in_text("the joints moved by up to %.3f rad (or m)", moved_),
                                 "while kMove is not set, the robot must stay in place however hard it is "
                                 "pushed"});
  }

  DescribedRobot robot_;
  double timeout_s_;
  Conversation<SetpointDatagram, RobotDatagram> talk_;
  Told rest_{};
  double moved_ = 0.0;
  Section section_;
};

}  // namespace

Section check_pushes(const std::string& address, const std::string& robot_file, double push_timeout_s) {
  return Pushing(address, robot_file, push_timeout_s).run();
}

}  // namespace longreach
