#pragma once
// Data of the console: one consistent snapshot of the master, taken outside the loop.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "master/console/situation.hpp"
#include "master/master_node.hpp"

namespace longreach {

struct ConsoleSnapshot {
  MasterView view{};
  LinkFigures link{};
  std::uint64_t late_ticks = 0;            // ticks that were more than 100 ms late
  std::uint64_t missed_ticks = 0;          // periods in which no tick ran
  RejectionCounts rejected{};              // datagrams dropped by this side, per reason
  std::string operator_phase{};            // phase of the scripted operator; empty: unknown
  std::string trouble{};                   // why there is no session with the slave; empty if there is one
  Shown shown{};                           // what is shown to the operator
  std::string notice{};                    // notice about the keyboard; empty if there is none
  double seconds = 0.0;                    // time since the start
  std::optional<double> seconds_left{};    // remaining duration of the run; none: no limit
  double force_max_n = 15.0;               // force at which the force bars have their full length
  bool show_keys = false;                  // list the keys below the view
  bool turns = true;                       // the handle of the device can rotate
  std::optional<double> expected_rtt_s{};  // round trip of the configured link; none: unknown
  bool hand_outside = false;               // a remote client holds the handle
  std::string_view pad_keys{};             // buttons of the gamepad or SpaceMouse, if there is one
};

}  // namespace longreach
