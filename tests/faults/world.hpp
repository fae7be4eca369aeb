#pragma once
// A laboratory with faults: applies the faults of a schedule between the nodes and their environment, and
// records what really happened.

#include <map>
#include <utility>
#include <vector>

#include "deploy/lab/laboratory.hpp"
#include "tests/faults/injected_defect.hpp"
#include "tests/faults/kind.hpp"
#include "tests/faults/moment.hpp"
#include "tests/faults/person.hpp"
#include "tests/faults/scenario.hpp"
#include "tests/faults/wire.hpp"

namespace longreach {

/// Combined effect of all faults in a tick; reset before each tick.
struct Levels {
  ImpairmentConfig up{}, down{};  // impairments of the link, increased by the active faults
  DirectionFaults wire_up{}, wire_down{};
  bool slave_skips_tick = false, master_skips_tick = false;
  double slave_ppm = 0.0, master_ppm = 0.0;  // rate errors of the clocks
  bool let_go = false, impatient = false, clutch = false;
};

class World : public FaultHooks {
 public:
  World(const Scenario& scenario, const Schedule& schedule,
        InjectedDefect injected_defect = InjectedDefect::kNone, const Clocks& clocks = {});

  /// Runs one tick and returns what happened.
  const Moment& step();

  // Interface for the kinds of fault.
  Levels levels{};
  OperatorRequests requests{};
  bool stop_slave = false;
  Laboratory& lab() { return lab_; }
  WireDirection& up() { return up_; }
  WireDirection& down() { return down_; }
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const Moment& moment() const { return moment_; }
  [[nodiscard]] const std::vector<Bytes>& past_life() const { return past_life_; }
  SentLog& sent_log() { return sent_log_; }
  /// Makes the slave follow a different session from now on; if `to_master`, the master uses it as well.
  void lease(bool to_master);
  /// Requests a change of a setting as a client of this side would; the program accepts or rejects it.
  void set_slave(std::string_view path, const std::string& value);
  void set_master(std::string_view path, const std::string& value);
  [[nodiscard]] std::uint64_t refused_changes() const { return refused_changes_; }
  void surround(const SceneConfig& scene) { lab_.arm().surround(scene); }

  /// Number of injections of each kind.
  [[nodiscard]] const std::vector<std::uint64_t>& injected() const { return injected_; }
  Person& person() { return person_; }
  [[nodiscard]] const Laboratory& laboratory() const { return lab_; }

  Duration slave_clock(Duration elapsed) override { return elapsed + slave_ahead_; }
  Duration master_clock(Duration elapsed) override { return elapsed + master_ahead_; }
  bool slave_skips_tick() override { return levels.slave_skips_tick; }
  bool master_skips_tick() override { return levels.master_skips_tick; }
  void robot_reported(Time now, RobotState& reported) override;
  void before_slave_step(SlaveInput& input) override;
  void after_slave_step(SlaveOutput& out) override;
  void handle_reported(HandleState& reported) override;
  void before_master_step(MasterInput& input) override;
  void after_master_step(MasterOutput& out) override;
  /// Called after the slave's turn and after the master's.
  void on_wire(MemoryChannelPair& wire) override;

 private:
  struct Running {
    const FaultKind* kind;
    Active active;
  };
  void begin_faults(double now_s);
  void act();
  /// Marks the signal of the lowest set bit as affected in this tick.
  void mark_affected(unsigned first);
  void apply_levels();
  void end_faults();
  void take_all(Channel& end, WireDirection& direction);
  bool change(google::protobuf::Message& present, const google::protobuf::Message& start,
              std::string_view path, const std::string& value, bool engaged);
  void finish();
  void live_before();
  template <class Hook, class Value>
  void hook(Hook FaultKind::*which, Value& value);

  Scenario scenario_;
  Schedule schedule_;
  Laboratory lab_;
  WireDirection up_, down_;
  DefectInjector defect_injector_;
  Person person_;
  SentLog sent_log_;
  proto::SlaveConfig slave_config_;
  proto::MasterConfig master_config_;
  MemoryChannelPair* channels_ = nullptr;
  Random sessions_;
  std::uint64_t leases_ = 1;
  /// Highest sequence number for each session and datagram type.
  std::map<std::pair<std::uint64_t, std::byte>, std::uint64_t> numbers_;
  std::size_t next_fault_ = 0;
  std::vector<Running> running_;
  std::vector<std::uint64_t> injected_;
  std::vector<Bytes> past_life_;
  Duration slave_ahead_, master_ahead_;
  ImpairmentConfig up_now_{}, down_now_{};
  Moment moment_{};
  std::map<std::uint64_t, double> reports_s_;  // time at which each of the last reports was sent, by number
  double slave_ran_s_ = 0.0, master_ran_s_ = 0.0;
  std::uint64_t refused_changes_ = 0;
  bool stop_waits_ = false;  // a stop was requested at the slave and its node has not run since
  bool slave_turn_ = true;   // the side whose datagrams are processed next
};

}  // namespace longreach
