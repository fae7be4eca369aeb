#pragma once
// The status of both sides as text: a table for users and a single line for logs. Pure functions.

#include <string>
#include <string_view>

#include "deploy/cli/side_client.hpp"

namespace longreach {

struct BothReports {
  SideReport master;
  SideReport slave;
};

/// A table with one column per side and one row per quantity. Unknown quantities are omitted. The reason why
/// a side is down is not included.
std::string status_table(const BothReports& reports);
/// The same for a terminal of this size: sentences first and on several lines, long cells cut, and without the details if
/// they do not fit.
std::string watch_table(const BothReports& reports, std::size_t columns, std::size_t rows);
/// Breaks lines that are longer than `columns` between words.
std::string folded(const std::string& text, std::size_t columns);
/// The status as one line without a newline.
std::string status_line(const BothReports& reports);

/// Describes an impairment, for example "delay 650 ms, loss 2 %", or "none" for an unimpaired link.
std::string in_words(const proto::Impairment& impairment);
/// Formats a quantity with four significant digits and an SI prefix (m, u or none), for example "650 ms".
std::string with_unit(double value, std::string_view unit);

}  // namespace longreach
