#pragma once
// Status of both sides as text: a table for users, one line for logs, JSON for programs. Pure.

#include <string>
#include <string_view>

#include "deploy/cli/side_client.hpp"

namespace longreach {

struct BothReports {
  SideReport master;
  SideReport slave;
};

/// Two columns, one row per quantity; unknown rows are omitted. Does not include why a side is down.
std::string status_table(const BothReports& reports);
/// One line without its newline.
std::string status_line(const BothReports& reports);

/// Text of an impairment: "delay 650 ms, loss 2 %"; "none" if nothing is impaired.
std::string in_words(const proto::Impairment& impairment);
/// A quantity with its SI prefix (m, u or none) and four digits: "650 ms".
std::string with_unit(double value, std::string_view unit);

}  // namespace longreach
