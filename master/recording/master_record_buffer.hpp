#pragma once
// Collects the records of the master's loop.

#include <tuple>

#include "common/recording/tick_buffer.hpp"
#include "master/master_node.hpp"

namespace longreach {

struct MasterRecords {
  using Input = MasterInput;
  using TickInput = MasterTickInput;
  using Output = MasterOutput;
  using View = MasterView;
  using Messages = std::tuple<StiffnessReport, Telemetry, BodyPoses>;
  using Tick = recording::MasterTick;
  using ShownView = recording::MasterView;
  static constexpr const char* kName = "master";

  template <class F>
  static void for_each_message(const MasterInput& input, const F& f) {
    f(input.reports);
    f(input.telemetry);
    f(input.bodies);
  }
  static void count_messages(const MasterInput& input, recording::MasterInput& out) {
    out.set_reports(static_cast<std::uint32_t>(input.reports.size()));
    out.set_telemetry(static_cast<std::uint32_t>(input.telemetry.size()));
    out.set_bodies(static_cast<std::uint32_t>(input.bodies.size()));
  }
};

using MasterRecordBuffer = TickBuffer<MasterRecords>;

}  // namespace longreach
