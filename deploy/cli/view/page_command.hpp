#pragma once
// What a page asks for: one JSON object a message.
//
//   {"take": true}                     the hand; false: gives it back
//   {"aim": [x, y, z], "turn": [x, y, z], "clutch": false, "grip": false}    m and rad from the handle's home
//   {"do": "engage"}                   or "stop"
//   {"mode": "rate"}                   or "position"
//   {"scale": 0.5}
//   {"link": "moon"}

#include <optional>
#include <string>
#include <string_view>

#include "proto/control.pb.h"

namespace longreach {

struct PageCommand {
  enum class Kind { kTake, kGive, kAim, kEngage, kStop, kMode, kScale, kLink };
  Kind kind = Kind::kGive;
  proto::HandAim aim{};
  proto::Mapping::Mode mode = proto::Mapping::POSITION;
  double scale = 0.0;
  std::string link{};  // a profile's name: letters, digits, - and _
};

/// None: it cannot be understood.
std::optional<PageCommand> read_page_command(std::string_view text);

}  // namespace longreach
