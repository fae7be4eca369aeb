// A faulty force sensor on four arms in every state. Measures the uncommanded motion of the robot, its
// contact force, and when the fault is reported. The evaluation uses only the simulated plant (position, true
// force); from the slave, only its reports are used.
//
// Motion: the distance from the position at the start of the fault, minus the part that reduces the true
// force on a wall of known stiffness. A report is late if it comes after the fault has become implausible
// according to the table of slave/sensing/sensor_watch.hpp. Faults that are not detectable according to that
// table are counted separately: the tool is at rest or free, and the fault causes no motion. A drift in
// contact grows at rest and responds to a retreat like an approaching wall, so that the robot may retreat by
// up to give_way_m.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/robot/faulty_sensor.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kWallAt_m = 0.02;  // distance from the start, along x
constexpr double kWall_n_per_m = 2000.0;
constexpr double kFaultHand_m_per_s = 0.02;
constexpr double kFault_s = 4.5;  // start of the fault; the hand is at rest from then on
constexpr double kWatched_s = 4.0;
constexpr double kFaultGuard_n = 20.0;
constexpr double kUnanswered_m = 0.02;

constexpr std::array<const char*, 4> kFaultArms{"space_arm", "puma560", "ur10", "cartesian"};
enum class In : std::uint8_t {
  kIdle,
  kObserving,
  kFree,
  kContact,
  kHolding,
  kHoldingContact,
  kStopped,
  kCount
};
constexpr std::size_t kStates = static_cast<std::size_t>(In::kCount);

bool touches(In in) { return in == In::kContact || in == In::kHoldingContact; }

/// `leap`: no surface can cause such a change, so the fault is implausible from its start.
struct SensorFaultOutcome {
  SensorFault sensor_fault;
  bool leap = false;
};

std::vector<SensorFaultOutcome> sensor_faults() {
  const Vector3 askew = Vector3(1, 1, 1).normalized();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {{{SensorFaultKind::kNone}},
          {{SensorFaultKind::kBias, 9.0 * std::sqrt(3.0), askew}},
          {{SensorFaultKind::kBias, 60.0, askew}, true},
          {{SensorFaultKind::kDrift, 6.0, askew}},
          {{SensorFaultKind::kStuck, 15.0, askew}},
          {{SensorFaultKind::kStuck, 60.0, askew}, true},
          {{SensorFaultKind::kFrozen}},
          {{SensorFaultKind::kSpike, 1e300, askew}, true},
          {{SensorFaultKind::kSpike, nan, askew}, true},
          {{SensorFaultKind::kSaturation, 3.0}},
          {{SensorFaultKind::kSign}},
          {{SensorFaultKind::kFrame, 0.5 * std::numbers::pi, Vector3::UnitX()}},
          {{SensorFaultKind::kFrame, 0.5 * std::numbers::pi, Vector3::UnitY()}},
          {{SensorFaultKind::kFrame, 0.5 * std::numbers::pi, Vector3::UnitZ()}},
          {{SensorFaultKind::kAxes}}};
}

/// A wrong sign or frame is present from the beginning.
bool built_in(SensorFaultKind sensor_fault) {
  return sensor_fault == SensorFaultKind::kSign || sensor_fault == SensorFaultKind::kFrame ||
         sensor_fault == SensorFaultKind::kAxes;
}

struct FaultOutcome {
  double way_m = 0.0;
  double force_n = 0.0;  // true, largest
  std::optional<double> implausible_s{};
  std::optional<double> reported_s{};
};

/// No wall moves here, so that a reported approaching wall is also due to the sensor.
bool names_the_sensor(HoldCause cause) {
  return cause == HoldCause::kSensorFault || cause == HoldCause::kSensorSign ||
         cause == HoldCause::kForcePersists || cause == HoldCause::kSurfaceApproaching;
}

/// The force reported by a drifting sensor in contact grows at rest and responds to a retreat, like that of
/// an approaching wall.
bool fakes_an_answer(In in, SensorFaultKind sensor_fault) {
  return touches(in) && sensor_fault == SensorFaultKind::kDrift;
}

/// The hand moves to the wall, or stays at rest.
HandTarget hand_at(In in, double t_s) {
  HandTarget hand;
  if (touches(in)) hand.position_m.x() = std::clamp(kFaultHand_m_per_s * (t_s - 1.0), 0.0, 2.5 * kWallAt_m);
  return hand;
}

/// Brings the slave to its state before kFault_s.
void bring(Laboratory& lab, In in, double t_s) {
  const auto at = [&](double s) { return std::abs(t_s - s) < 0.5 * lab.period_s(); };
  if (in == In::kIdle && at(lab.period_s())) lab.kill_master();
  if (in == In::kStopped && at(3.0)) lab.requests().stop = true;
  if ((in == In::kHolding || in == In::kHoldingContact) && at(3.5)) lab.kill_master();
}

FaultOutcome was_faulty(const ExperimentRun& run, const char* arm, In in, const SensorFaultOutcome& what,
                        const std::function<Vector3(const Laboratory&)>& answer = {}) {
  const bool engages = in != In::kIdle && in != In::kObserving;
  const std::string x = std::to_string(kWallAt_m);
  const proto::LabConfig config =
      configure({"profile=lab", std::string("robot_file=robots/") + arm + ".txtpb", "mapping.mode=POSITION",
                 "mapping.scale=1", "command.force_guard_n=" + std::to_string(kFaultGuard_n),
                 std::string("safety.engage_at_start=") + (engages ? "true" : "false"),
                 "scene.surface.wall.plane.point_m=" + x + ",0,0",
                 "scene.material.wall.stiffness_n_per_m=" + std::to_string(kWall_n_per_m)},
                find_deploy_folder());
  const SlaveConfig slave = to_struct(config.slave());
  Laboratory lab(to_struct(config.master()), slave, run.seed);
  FaultySensor sensor(slave.robot);
  if (built_in(what.sensor_fault.sensor_fault)) sensor.sensor_fault(what.sensor_fault);
  OnRobot hooks([&](Time now, RobotState& robot) {
    sensor.apply(now, robot);
    if (answer && lab.now_s() > kFault_s) robot.F_F_W.force = answer(lab);
  });
  lab.set_fault_hooks(hooks);
  FaultOutcome out;
  Vector3 from_m = Vector3::Zero();
  double from_n = 0.0;
  bool began = false;
  while (lab.now_s() < kFault_s + kWatched_s) {
    const double t_s = lab.now_s();
    lab.drive(hand_at(in, t_s));
    bring(lab, in, t_s);
    if (t_s >= kFault_s && !began) {
      began = true;
      from_m = lab.arm().true_pose().p;
      from_n = lab.arm().true_wrench().force.norm();
      if (!built_in(what.sensor_fault.sensor_fault)) sensor.sensor_fault(what.sensor_fault);
      if (what.leap) out.implausible_s = t_s;
    }
    lab.step();
    const double force_n = lab.arm().true_wrench().force.norm();
    out.force_n = std::max(out.force_n, force_n);
    if (!out.reported_s && names_the_sensor(lab.slave().cause)) out.reported_s = lab.now_s();
    if (!began) continue;
    const double eased_m = std::max(from_n - force_n, 0.0) / kWall_n_per_m;
    out.way_m = std::max(out.way_m, (lab.arm().true_pose().p - from_m).norm() - eased_m);
    // The robot has retreated as far as permitted, and the force did not respond.
    if (!out.implausible_s && what.sensor_fault.sensor_fault != SensorFaultKind::kNone &&
        out.way_m > 0.99 * kUnanswered_m)
      out.implausible_s = lab.now_s();
  }
  return out;
}

struct FaultCell {
  std::size_t arm, state, sensor_fault;
};

}  // namespace

std::vector<Plot> sensor_faults_plots() {
  return {{.name = "sensor_faults",
           .csv = "sensor_faults",
           .title = "A faulty force sensor: uncommanded motion and true force (one point per run)",
           .x_column = "run",
           .x_label = "run (arm, state, fault)",
           .panels = {{"uncommanded motion (mm)", {{"way_m", "", 1e3}}, ""},
                      {"true force (N)", {{"force_n", ""}}, ""}}}};
}

std::vector<Metric> run_sensor_faults(const ExperimentRun& run) {
  const std::vector<SensorFaultOutcome> all = sensor_faults();
  std::vector<FaultCell> cells;
  for (std::size_t arm = 0; arm < kFaultArms.size(); ++arm) {
    for (std::size_t state = 0; state < kStates; ++state) {
      for (std::size_t sensor_fault = 0; sensor_fault < all.size(); ++sensor_fault)
        cells.push_back({arm, state, sensor_fault});
    }
  }
  std::vector<FaultOutcome> outcomes(cells.size());
  on_all_cores(
      cells.size(),
      [&](std::size_t i) {
        const FaultCell& c = cells[i];
        outcomes[i] = was_faulty(run, kFaultArms[c.arm], static_cast<In>(c.state), all[c.sensor_fault]);
      },
      run.progress);
  Trace trace(run.out, "sensor_faults", {"run", "arm", "state", "lie", "way_m", "force_n", "told_s"});
  double way_m = 0.0, force_n = 0.0, faked_m = 0.0, faked_n = 0.0, late_s = 0.0, never = 0.0, reported = 0.0,
         false_faults = 0.0, honest = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const FaultOutcome& o = outcomes[i];
    const bool faulty_now = all[cells[i].sensor_fault].sensor_fault.sensor_fault != SensorFaultKind::kNone;
    const bool fakes = fakes_an_answer(static_cast<In>(cells[i].state),
                                       all[cells[i].sensor_fault].sensor_fault.sensor_fault);
    (fakes ? faked_m : way_m) = std::max(fakes ? faked_m : way_m, o.way_m);
    (fakes ? faked_n : force_n) = std::max(fakes ? faked_n : force_n, o.force_n);
    reported += faulty_now && o.reported_s ? 1.0 : 0.0;
    honest += faulty_now ? 0.0 : 1.0;
    false_faults += !faulty_now && o.reported_s ? 1.0 : 0.0;
    if (o.implausible_s && !o.reported_s) never += 1.0;
    if (o.implausible_s && o.reported_s && !fakes)
      late_s = std::max(late_s, *o.reported_s - *o.implausible_s);
    trace.row({static_cast<double>(i), static_cast<double>(cells[i].arm), static_cast<double>(cells[i].state),
               static_cast<double>(cells[i].sensor_fault), o.way_m, o.force_n, o.reported_s.value_or(-1.0)});
  }
  trace.close();
  // Control: the metric must be bad for a false force that responds to the motion.
  const auto answers = [start = std::optional<Vector3>{}](const Laboratory& lab) mutable {
    const Vector3& p_m = lab.arm().true_pose().p;
    if (!start) start = p_m;
    return Vector3((18.0 - 130.0 * (p_m - *start).norm()) * Vector3::UnitY());
  };
  const FaultOutcome control = was_faulty(run, kFaultArms[3], In::kHolding, {}, answers);
  const double runs = static_cast<double>(cells.size());
  return {{"runs", runs, ""},
          {"way_max_m", way_m, "m"},
          {"true_force_over_guard", force_n / kFaultGuard_n, ""},
          {"faked_answer_way_max_m", faked_m, "m"},
          {"faked_answer_true_force_over_guard", faked_n / kFaultGuard_n, ""},
          {"told", reported, ""},
          {"told_late_max_s", late_s, "s"},
          {"implausible_never_told", never, ""},
          {"not_revealed", runs - honest - reported, ""},
          {"honest_runs", honest, ""},
          {"false_faults", false_faults, ""},
          {"control_way_m", control.way_m, "m"}};
}

}  // namespace longreach
