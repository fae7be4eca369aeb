#pragma once
// Rewords errors of the protobuf text parser: corrects the position to point at the faulty word, and suggests
// corrections for unknown names.

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "common/text/text_position.hpp"

namespace longreach {

struct ParseError {
  TextPosition position;  // counted from 0
  std::string text;
};

/// `said` is the error that the parser reported for `text`, a message of type `root`.
ParseError reword(const ParseError& said, std::string_view text, const google::protobuf::Descriptor& root);

}  // namespace longreach
