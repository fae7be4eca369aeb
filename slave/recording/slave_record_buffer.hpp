#pragma once
// Collects the records of the slave's loop.

#include <tuple>

#include "common/recording/tick_buffer.hpp"
#include "slave/slave_node.hpp"

namespace longreach {

struct SlaveRecords {
  using Input = SlaveInput;
  using TickInput = SlaveTickInput;
  using Output = SlaveOutput;
  using View = SlaveView;
  using Messages = std::tuple<MotionCommand>;
  using Tick = recording::SlaveTick;
  using ShownView = recording::SlaveView;
  static constexpr const char* kName = "slave";

  template <class F>
  static void for_each_message(const SlaveInput& input, const F& f) {
    f(input.commands);
  }
  static void count_messages(const SlaveInput& input, recording::SlaveInput& out) {
    out.set_commands(static_cast<std::uint32_t>(input.commands.size()));
  }
};

using SlaveRecordBuffer = TickBuffer<SlaveRecords>;

}  // namespace longreach
