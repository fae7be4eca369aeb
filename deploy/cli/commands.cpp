#include "deploy/cli/commands.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iostream>
#include <thread>
#include <type_traits>

#include "common/text/number_text.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/cli/view_text.hpp"

namespace longreach {
namespace {

constexpr double kScaleStep = 0.05;
constexpr double kScaleMin = 0.05;
constexpr double kScaleMax = 1.0;
constexpr double kKvStep = 1.25, kKvMin_per_s = 0.001, kKvMax_per_s = 1000.0;

SideReport ask(Side side, const Options& options) { return SideClient(side, options).report(); }

ExitStatus run_status(const Options& options, const StatusCommand& command) {
  auto slave = std::async(std::launch::async, ask, Side::kSlave, options);
  const BothReports reports{ask(Side::kMaster, options), slave.get()};
  if (options.json) {
    std::cout << status_json(reports) << "\n";
  } else {
    std::cout << status_table(reports);
    if (command.all && reports.master.status)
      std::cout << "\nmaster\n" << values_table(reports.master.status->master_view());
    if (command.all && reports.slave.status)
      std::cout << "\nslave\n" << values_table(reports.slave.status->slave_view());
  }
  std::cout.flush();
  for (const SideReport* report : {&reports.master, &reports.slave})
    if (!report->status) std::cerr << "longreach: " << report->error << "\n";
  return reports.master.status && reports.slave.status ? ExitStatus::kDone : ExitStatus::kFailed;
}

ExitStatus run_get(const Options& options, const GetCommand& command) {
  std::string text = SideClient(command.side, options).get(command.path, command.origin);
  if (options.json) {
    std::cout << "{\"text\":" << json_string(text) << "}\n";
  } else {
    std::cout << text << (text.ends_with('\n') ? "" : "\n");
  }
  return ExitStatus::kDone;
}

ExitStatus run_set(const Options& options, const SetCommand& command) {
  SideClient(command.side, options).set(command.assignments);
  std::string done = "set at the " + std::string(name_of(command.side)) + ":";
  for (const auto& [path, value] : command.assignments) done += " " + path + " = " + value + ";";
  done.pop_back();
  print_done(options, done);
  return ExitStatus::kDone;
}

ExitStatus run_scale(const Options& options, const ScaleCommand& command) {
  SideClient master(Side::kMaster, options);
  double scale = command.value.value_or(0.0);
  if (!command.value) {
    const proto::Status status = master.status();
    if (!status.has_scale())
      throw SideError(SideError::Kind::kRefused,
                      "the master does not report the scale: give a number instead of up or down");
    // Rounds to multiples of 1e-6, so that equal numbers of steps up and down return to the initial value.
    const double stepped = status.scale() + command.steps * kScaleStep;
    scale = std::clamp(std::round(stepped * 1e6) / 1e6, kScaleMin, kScaleMax);
  }
  proto::Action sets;
  sets.set_scale(scale);
  master.run(sets);
  print_done(options, "scale set to " + format_number(scale));
  return ExitStatus::kDone;
}

ExitStatus run_kv(const Options& options, const KvCommand& command) {
  SideClient master(Side::kMaster, options);
  double kv_per_s = command.value.value_or(0.0);
  if (!command.value) {
    const double present_per_s = master.status().master_view().kv_per_s();
    kv_per_s = std::clamp(present_per_s * std::pow(kKvStep, command.steps), kKvMin_per_s, kKvMax_per_s);
  }
  proto::Action sets;
  sets.set_kv_per_s(kv_per_s);
  master.run(sets);
  print_done(options, "kv set to " + format_number(kv_per_s) + " 1/s");
  return ExitStatus::kDone;
}

ExitStatus run_action(const Options& options, const ActionCommand& command) {
  print_done(options, SideClient(command.side, options).run(command.action));
  return ExitStatus::kDone;
}

/// Requests an engagement and waits for the result. After a round trip and two seconds at most, the master
/// has engaged or reports the reason why not.
ExitStatus run_engage(const Options& options) {
  using std::chrono::steady_clock;
  constexpr double kBesides_s = 2.0;
  SideClient master(Side::kMaster, options);
  const std::uint32_t before = master.status().engagement();
  proto::Action engages;
  engages.mutable_engage();
  std::string done = master.run(engages);
  const auto asked = steady_clock::now();
  proto::Status status;
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
    status = master.status();
    const std::chrono::duration<double> waited = steady_clock::now() - asked;
    const bool late = waited.count() > status.link().rtt_s() + kBesides_s;
    if (status.state() == "Engaged") done = "engaged";
    if (status.state() == "Engaged" || (status.engagement() != before && status.state() != "Observing"))
      break;
    if (!late) continue;
    if (status.refusal().empty()) break;
    throw SideError(SideError::Kind::kRefused, "not engaged: " + status.refusal());
  }
  for (const std::string& sentence : status.reduced_protection()) done += "\nreduced protection: " + sentence;
  print_done(options, done);
  return ExitStatus::kDone;
}

}  // namespace

void print_done(const Options& options, const std::string& sentence) {
  if (options.json) {
    std::cout << "{\"done\":" << json_string(sentence) << "}\n";
  } else {
    std::cout << sentence << "\n";
  }
  std::cout.flush();
}

void print_error(bool json, const std::string& sentence) {
  if (json) std::cout << "{\"error\":" << json_string(sentence) << "}" << std::endl;
  std::cerr << "longreach: " << sentence << "\n";
}

ExitStatus run(const Invocation& invocation) {
  Options options = invocation.options;
  options.connections = std::make_shared<RpcConnections>();
  return std::visit(
      [&options](const auto& command) {
        using Asked = std::decay_t<decltype(command)>;
        if constexpr (std::is_same_v<Asked, StatusCommand>) return run_status(options, command);
        if constexpr (std::is_same_v<Asked, WatchCommand>) return run_watch(options, command);
        if constexpr (std::is_same_v<Asked, ViewCommand>) return run_view(options, command);
        if constexpr (std::is_same_v<Asked, GetCommand>) return run_get(options, command);
        if constexpr (std::is_same_v<Asked, SetCommand>) return run_set(options, command);
        if constexpr (std::is_same_v<Asked, LinkShowCommand>) return run_link_show(options);
        if constexpr (std::is_same_v<Asked, LinkSetCommand>) return run_link_set(options, command);
        if constexpr (std::is_same_v<Asked, ActionCommand>) return run_action(options, command);
        if constexpr (std::is_same_v<Asked, ScaleCommand>) return run_scale(options, command);
        if constexpr (std::is_same_v<Asked, KvCommand>) return run_kv(options, command);
        if constexpr (std::is_same_v<Asked, EngageCommand>) return run_engage(options);
        if constexpr (std::is_same_v<Asked, StopCommand>) return run_stop(options);
        if constexpr (std::is_same_v<Asked, PairCommand>) return run_pair(options, command);
        if constexpr (std::is_same_v<Asked, UnpairCommand>) return run_unpair(options, command);
        if constexpr (std::is_same_v<Asked, RecordCommand>) return run_record(options, command);
        if constexpr (std::is_same_v<Asked, DoctorCommand>) return run_doctor(options, command);
        if constexpr (std::is_same_v<Asked, RobotCommand>) return run_robot(options, command);
        if constexpr (std::is_same_v<Asked, DemoCommand>) return run_demo(command);
        if constexpr (std::is_same_v<Asked, TaskCommand>) return run_task(options, command);
        if constexpr (std::is_same_v<Asked, AdapterCheckCommand>) return run_adapter_check(options, command);
      },
      invocation.command);
}

}  // namespace longreach
