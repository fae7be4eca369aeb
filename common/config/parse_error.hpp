#pragma once
// What the protobuf text parser says, in the words of this system: the position of the faulty word itself,
// and for unknown names what was probably meant.

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "common/config/text_position.hpp"

namespace longreach {

struct ParseError {
  TextPosition position;  // from 0
  std::string text;
};

/// `said` as the parser reported it for `text`, which should hold a message of type `root`.
ParseError reword(const ParseError& said, std::string_view text, const google::protobuf::Descriptor& root);

}  // namespace longreach
