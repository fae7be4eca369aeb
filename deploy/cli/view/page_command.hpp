#pragma once
// A command from a page: one JSON object per message.
//
//   {"take": true}                     takes control; false: returns it
//   {"aim": [x, y, z], "turn": [x, y, z], "clutch": false, "grip": false}    m and rad from the handle's home
//   {"do": "engage"}                   or "stop"
//   {"mode": "rate"}                   or "position"
//   {"scale": 0.5}
//   {"kv": 2.5}                        speed per deflection in rate mode, 1/s
//   {"link": "moon"}

#include <optional>
#include <string>
#include <string_view>

#include "proto/control.pb.h"

namespace longreach {

struct PageCommand {
  enum class Kind { kTake, kGive, kAim, kEngage, kStop, kMode, kScale, kKv, kLink };
  Kind kind = Kind::kGive;
  proto::HandAim aim{};
  proto::MotionMode mode = proto::POSITION;
  double value = 0.0;  // kScale, kKv
  std::string link{};  // name of a link profile: letters, digits, - and _
};

/// Returns std::nullopt if the text is not a valid command.
std::optional<PageCommand> read_page_command(std::string_view text);

}  // namespace longreach
