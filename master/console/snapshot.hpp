#pragma once
// Data of the console: one consistent picture of the master, taken outside the loop.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "master/master_node.hpp"

namespace longreach {

struct ConsoleSnapshot {
  MasterView view{};
  LinkFigures link{};
  std::uint64_t late_ticks = 0;          // late by over 100 ms
  std::uint64_t missed_ticks = 0;        // periods in which no tick ran
  RejectionCounts rejected{};            // datagrams dropped on this side, by reason
  std::string operator_phase{};          // state of the operator; empty: unknown
  std::string trouble{};                 // why there is no session with the slave; empty: there is one
  std::string notice{};                  // of the keyboard; empty: none
  double seconds = 0.0;                  // since the start
  std::optional<double> seconds_left{};  // none: runs until it is ended
  double force_max_n = 15.0;             // full length of the force bars
  bool show_keys = false;                // list the keys below the view
  bool turns = true;                     // the handle of the device can rotate
  bool hand_outside = false;             // a remote hand holds the handle
  std::string_view pad_keys{};           // likewise for a gamepad or SpaceMouse, if there is one
};

}  // namespace longreach
