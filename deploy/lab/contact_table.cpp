#include "deploy/lab/contact_table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "common/text/nearest_name.hpp"
#include "common/text/number_text.hpp"
#include "common/text/utf8.hpp"
#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {
namespace {

using solve_json::BadRequest;

struct Unit {
  const char* name;
  double si;
};

struct Quantity {
  char key;
  std::vector<const char*> names;
  std::vector<Unit> units;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all{
      {'t',
       {"t", "time", "timestamp"},
       {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"µs", 1e-6}, {"μs", 1e-6}, {"sec", 1.0}}},
      {'x',
       {"x", "penetration", "depth"},
       {{"m", 1.0}, {"mm", 1e-3}, {"um", 1e-6}, {"cm", 1e-2}, {"µm", 1e-6}, {"μm", 1e-6}}},
      {'v',
       {"v", "speed", "velocity"},
       {{"m/s", 1.0}, {"mm/s", 1e-3}, {"um/s", 1e-6}, {"m_per_s", 1.0}, {"mm_per_s", 1e-3}}},
      {'f', {"f", "force"}, {{"N", 1.0}, {"mN", 1e-3}, {"kN", 1e3}, {"n", 1.0}}}};
  return all;
}

bool take(std::string& text, const std::string& start) {
  if (!text.starts_with(start)) return false;
  text.erase(0, start.size());
  return true;
}

std::string trimmed(const std::string& text) {
  constexpr const char* kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Returns the part of `text` that is not in quotes.
std::string unquoted(const std::string& text) {
  std::string outside;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted) outside += c;
  }
  return outside;
}

std::string unit_names(const Quantity& quantity) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    text += (i == 0 ? "" : i == 2 ? " or " : ", ") + std::string(quantity.units[i].name);
  return text;
}

/// Parses a number as spreadsheets write it. Returns std::nullopt for anything else.
std::optional<double> number(std::string text) {
  if (take(text, "\xE2\x88\x92")) text.insert(0, 1, '-');  // the typographic minus sign
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.erase(0, 1);
  if (std::ranges::count(text, ',') == 1 && text.find('.') == std::string::npos)
    std::ranges::replace(text, ',', '.');
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

/// Says why a cell is not a number, and what to do.
std::string advice(char key, const std::string& cell) {
  for (const char* missing : {"", "na", "nan", "null", "none"}) {
    if (lower_case(cell) != missing) continue;
    return "; remove the lines that lack a value (R: na.omit, MATLAB: rmmissing, pandas: dropna)";
  }
  const auto digits_only = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (cell.find_first_of(",.'") != std::string::npos &&
      std::ranges::count_if(cell, digits_only) +
              std::ranges::count_if(
                  cell,
                  [](char c) { return std::string_view("+-.,' ").find(c) != std::string_view::npos; }) ==
          static_cast<std::ptrdiff_t>(cell.size()))
    return "; write numbers without thousands separators";
  if (key == 't' && cell.find(':') != std::string::npos)
    return "; write times in seconds since any fixed instant";
  return "";
}

/// Rejects a first line that is the header of another file format.
void refuse_heads(const std::string& line) {
  if (line.starts_with("LabVIEW Measurement"))
    throw BadRequest(
        "this is the header of a LabVIEW measurement file; delete all lines up to the last "
        "***End_of_Header***, and name the columns t, x and f (X_Value is t)");
  if (line.starts_with("["))
    throw BadRequest("a JSON array is not supported; write one object per line, as `jq -c .[]` does");
}

void refuse_other_encodings(const std::string& line) {
  if (line.find('\0') != std::string::npos || line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF"))
    throw BadRequest("the text is UTF-16; save it as UTF-8");
  const auto cr = line.find('\r');
  if (cr != std::string::npos && cr + 1 != line.size())
    throw BadRequest("lines end with CR only; save the file with LF or CR LF line endings");
  if (!is_utf8(line)) throw BadRequest("the text is not UTF-8: \"" + trimmed(line) + "\"; save it as UTF-8");
}

void set(ContactRow& row, char key, double value) {
  if (key == 't') row.t_s = value;
  if (key == 'x') row.x_m = value;
  if (key == 'f') row.f_n = value;
  if (key == 'v') row.v_m_per_s = value;
}

}  // namespace

ContactTable::Column ContactTable::column(const std::string& name) {
  constexpr const char* kBetween = " \t,_[(/.";
  const auto end = std::min(name.find_first_of(kBetween), name.size());
  std::string quantity_name = name.substr(0, end), unit = name.substr(end);
  quantity_name = lower_case(quantity_name);
  unit.erase(0, unit.find_first_not_of(kBetween));
  take(unit, "in ");
  unit.erase(unit.find_last_not_of(" \t])_.") + 1);
  // What MATLAB and R make of "m/s".
  std::string fraction = unit;
  std::ranges::replace_if(
      fraction, [](char c) { return c == '_' || c == '.'; }, '/');
  for (const Quantity& quantity : quantities()) {
    if (std::ranges::find(quantity.names, quantity_name) == quantity.names.end()) continue;
    if (unit.empty()) return {quantity.key, name, 1.0};
    for (const Unit& known : quantity.units) {
      if (unit != known.name && fraction != known.name) continue;
      if (quantity.key == 't') time_has_unit_ = true;
      if (quantity.key == 'x') x_has_unit_ = true;
      return {quantity.key, name, known.si};
    }
    if (lower_case(name) == "x_value") return {' ', name, 1.0};  // name of LabVIEW's time column
    throw BadRequest("the unit \"" + unit + "\" of \"" + name + "\" is unknown; use " + unit_names(quantity));
  }
  return {' ', name, 1.0};
}

std::vector<std::string> ContactTable::cells(const std::string& line) const {
  std::vector<std::string> result(1);
  bool quoted = false, was_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      result.back() += line[++i];
    } else if (c == '"' && (quoted || was_quoted || trimmed(result.back()).empty())) {
      quoted = !quoted;
      was_quoted = true;
    } else if (!quoted && c == *separator_) {
      result.emplace_back();
      was_quoted = false;
    } else {
      result.back() += c;
    }
  }
  if (quoted) throw BadRequest("a closing quotation mark is missing");
  for (std::string& cell : result) cell = trimmed(cell);
  if (*separator_ == ' ') std::erase(result, "");
  return result;
}

void ContactTable::header(std::string line) {
  if (take(line, "sep=") && !line.empty()) {
    separator_ = line[0];
    return;
  }
  const bool comment = take(line, "#") || take(line, "%");
  const std::string outside = unquoted(trimmed(line));
  const auto given = separator_;
  for (const char c : {'\t', ';', '|', ',', ' '}) {
    if (!separator_ && outside.find(c) != std::string::npos) separator_ = c;
  }
  if (!separator_) separator_ = ',';
  const std::vector<std::string> names = cells(*separator_ == '\t' ? line : trimmed(line));
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back(column(name));
  const auto has = [&](char key) { return std::ranges::count(columns, key, &Column::key); };
  if (comment && (has('t') == 0 || has('x') == 0 || has('f') == 0)) {
    separator_ = given;
    return;
  }
  if (std::ranges::all_of(names, [](const std::string& name) { return number(name).has_value(); }))
    throw BadRequest("the first line must name the columns, for example t,x,f");
  require_known(columns);
  for (const Column& one : columns) {
    if (one.key != ' ' && has(one.key) > 1)
      throw BadRequest("column \"" + std::string(1, one.key) + "\" is given twice");
  }
  for (const char key : {'t', 'x', 'f'}) {
    if (has(key) == 0) throw BadRequest("column \"" + std::string(1, key) + "\" is missing");
  }
  columns_ = std::move(columns);
}

/// Names all missing columns.
void ContactTable::require_known(const std::vector<Column>& columns) {
  std::string unknown;
  int count = 0;
  for (const Column& one : columns) {
    if (one.key != ' ' || one.name.empty()) continue;
    unknown += (count++ > 0 ? ", \"" : "\"") + one.name + "\"";
    if (lower_case(one.name) == "x_value") unknown += " (the time in LabVIEW files; name it t)";
  }
  if (count == 0) return;
  const bool none = std::ranges::none_of(columns, [](const Column& one) { return one.key != ' '; });
  if (none && unknown.find("LabVIEW") == std::string::npos)
    throw BadRequest("this line does not name the columns t, x and f, but contains " + unknown +
                     "; delete all lines before the one that names the columns, or begin them with #");
  throw BadRequest((count == 1 ? "unknown column " : "unknown columns ") + unknown +
                   "; remove columns other than t, x, v and f (time, penetration, speed, force), and use "
                   "these names, with units as in \"x [mm]\"");
}

/// A line of units below the names.
bool ContactTable::take_units(const std::vector<std::string>& values) {
  const auto is_number = [](const std::string& value) { return number(value).has_value(); };
  if (values.size() != columns_.size() || std::ranges::any_of(values, is_number)) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (columns_[i].key == ' ') continue;
    const Column with_unit = column(std::string(1, columns_[i].key) + " " + values[i]);
    if (!values[i].empty()) columns_[i].unit = with_unit.unit;
  }
  return true;
}

ContactRow ContactTable::from_json(const std::string& line) {
  const solve_json::Json object = solve_json::parse(line);
  ContactRow row;
  std::string keys;
  for (const auto& [name, value] : object.items()) {
    const Column found = column(name);
    if (found.key == ' ') throw BadRequest("unknown key \"" + name + "\"; the keys are t, x, v and f");
    if (keys.find(found.key) != std::string::npos) throw BadRequest("key \"" + name + "\" is given twice");
    keys += found.key;
    set(row, found.key, found.unit * solve_json::number(object, name));
  }
  for (const char key : {'t', 'x', 'f'}) {
    if (keys.find(key) == std::string::npos)
      throw BadRequest("key \"" + std::string(1, key) + "\" is missing");
  }
  return row;
}

ContactRow ContactTable::from_csv(const std::vector<std::string>& values) const {
  if (values.size() != columns_.size())
    throw BadRequest(std::to_string(values.size()) + " values for " + std::to_string(columns_.size()) +
                     " columns" +
                     (values.size() == 2 * columns_.size() && *separator_ == ','
                          ? "; with decimal commas, separate the columns by semicolons or tabs"
                      : values.size() == columns_.size() + 1 && rows_ == 0
                          ? "; name all columns (R: write.table with row.names = FALSE)"
                          : ""));
  ContactRow row;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Column& at = columns_[i];
    if (at.key == ' ' && values[i].empty()) continue;
    const auto value = number(values[i]);
    if (!value)
      throw BadRequest("\"" + at.name + "\" must be a number, not \"" + values[i] + "\"" +
                       (values[i] == at.name
                            ? "; a second table starts here; put each table into its own file"
                            : advice(at.key, values[i])));
    if (!std::isfinite(*value))
      throw BadRequest("\"" + at.name + "\" is not a finite number" + advice(at.key, values[i]));
    set(row, at.key, at.unit * *value);
  }
  return row;
}

std::optional<ContactRow> ContactTable::read(std::string line) {
  if (lines_++ == 0) take(line, "\xEF\xBB\xBF");  // byte order mark
  refuse_other_encodings(line);
  if (trimmed(line).empty()) return std::nullopt;
  const bool begun = json_ || !columns_.empty();
  if (!begun && trimmed(line).front() == '{') json_ = true;
  if (!json_ && !begun) {
    refuse_heads(trimmed(line));
    header(line);
    return std::nullopt;
  }
  ContactRow row;
  if (json_) {
    row = from_json(line);
  } else {
    if (trimmed(line).front() == '#' || trimmed(line).front() == '%') return std::nullopt;
    std::vector<std::string> values = cells(*separator_ == '\t' ? line : trimmed(line));
    if (std::ranges::all_of(values, &std::string::empty)) return std::nullopt;
    while (values.size() > columns_.size() && values.back().empty()) values.pop_back();
    if (rows_ == 0 && take_units(values)) return std::nullopt;
    row = from_csv(values);
  }
  if (rows_ > 0 && !(row.t_s > last_t_s_))
    throw BadRequest("\"t\" does not increase: " + format_number(row.t_s) + " s after " +
                     format_number(last_t_s_) + " s; sort the lines by t and remove lines with equal times");
  if (rows_ > 0 && row.v_m_per_s.has_value() != has_v_)
    throw BadRequest(has_v_ ? "key \"v\" is missing, although the previous lines have it"
                            : "key \"v\" is given, although the previous lines do not have it");
  has_v_ = row.v_m_per_s.has_value();
  last_t_s_ = row.t_s;
  ++rows_;
  return row;
}

}  // namespace longreach
