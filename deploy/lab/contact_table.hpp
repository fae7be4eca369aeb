#pragma once
// Reads a recording of a contact line by line. Accepts JSON objects, one per line, or CSV with a header, as
// written by spreadsheets, data loggers and other programs:
//   separator   comma, semicolon, tab, vertical bar or spaces, detected in the header; a line `sep=;` is
//               accepted
//   cells       may be quoted; a decimal comma is accepted unless it could be a separator; `+0.1`, `1E-3`
//   names       t (time), x (penetration, depth), v (speed, velocity), f (force), in upper or lower case;
//               the unit may follow the name, as in `x [mm]`, `t (ms)` or `f_kN`, or be in the line below;
//               the default units are s, m, m/s and N; names converted by MATLAB or R are accepted:
//               `x_mm_`, `v..m.s.`
//   other       a byte order mark, CR LF, empty lines, empty trailing cells, and comments that begin with # or %
// Not supported: UTF-16, thousands separators, cells that contain line breaks, LabVIEW headers.

#include <optional>
#include <string>
#include <vector>

namespace longreach {

struct ContactRow {
  double t_s = 0.0;
  double x_m = 0.0;                   // penetration; <= 0: free space
  std::optional<double> v_m_per_s{};  // derivative of x
  double f_n = 0.0;                   // contact force, positive when pushing
};

class ContactTable {
 public:
  /// Reads the next line. Returns its row, or std::nullopt for a header, a comment or an empty line. Throws
  /// solve_json::BadRequest.
  std::optional<ContactRow> read(std::string line);

  /// Returns whether the recording states the unit of t.
  [[nodiscard]] bool time_has_unit() const { return time_has_unit_; }
  /// Returns whether the recording states the unit of x.
  [[nodiscard]] bool x_has_unit() const { return x_has_unit_; }

 private:
  struct Column {
    char key = ' ';  // t, x, v or f; space: an empty trailing column
    std::string name;
    double unit = 1.0;  // conversion factor to SI units
  };

  [[nodiscard]] std::vector<std::string> cells(const std::string& line) const;
  void header(std::string line);
  static void require_known(const std::vector<Column>& columns);
  Column column(const std::string& name);
  bool take_units(const std::vector<std::string>& values);
  ContactRow from_csv(const std::vector<std::string>& values) const;
  ContactRow from_json(const std::string& line);

  std::vector<Column> columns_;  // columns of a CSV file
  std::optional<char> separator_{};
  bool json_ = false;
  std::size_t lines_ = 0, rows_ = 0;
  bool has_v_ = false;
  bool time_has_unit_ = false, x_has_unit_ = false;
  double last_t_s_ = 0.0;
};

}  // namespace longreach
