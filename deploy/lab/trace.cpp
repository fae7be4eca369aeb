#include "deploy/lab/trace.hpp"

#include <array>
#include <charconv>
#include <stdexcept>

#include "common/core/check.hpp"

namespace longreach {

Trace::Trace(const std::filesystem::path& folder, std::string_view name,
             const std::vector<std::string_view>& columns)
    : columns_(columns.size()) {
  if (folder.empty()) return;
  file_ = folder / (std::string(name) + ".csv");
  stream_.open(file_, std::ios::trunc);
  if (!stream_)
    throw std::runtime_error("cannot write " + file_.string() + "; choose another folder with --out");
  for (const std::string_view column : columns) {
    if (!line_.empty()) line_ += ',';
    line_ += column;
  }
  stream_ << line_ << '\n';
}

void Trace::row(const std::vector<double>& values) {
  CHECK(values.size() == columns_);
  if (file_.empty()) return;
  line_.clear();
  std::array<char, 40> text{};
  for (const double value : values) {
    if (!line_.empty()) line_ += ',';
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9).ptr;
    line_.append(text.data(), end);
  }
  stream_ << line_ << '\n';
}

void Trace::close() {
  if (file_.empty()) return;
  stream_.close();
  if (!stream_) throw std::runtime_error("cannot write " + file_.string() + ": check the free disk space");
}

}  // namespace longreach
