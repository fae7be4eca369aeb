#pragma once
// The status of both sides as text: a table for people, one line for logs, JSON for programs. Pure.

#include <string>
#include <string_view>

#include "deploy/cli/side_client.hpp"

namespace longreach {

struct BothReports {
  SideReport master;
  SideReport slave;
};

/// Two columns, one row a quantity, rows that no side knows left out. Does not say why a side is down.
std::string status_table(const BothReports& reports);
/// One line without its end.
std::string status_line(const BothReports& reports);

/// An impairment in words: "delay 650 ms, loss 2 %"; "none" when nothing is impaired.
std::string in_words(const proto::Impairment& impairment);
/// A quantity with its SI prefix (m, u or none) and four digits: "650 ms".
std::string with_unit(double value, std::string_view unit);

}  // namespace longreach
