#pragma once
// A table of the guide whose rows come from the code.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace longreach {

/// Compares the rows of a table in deploy/guide/operating.md; with LONGREACH_WRITE_GUIDE=1, writes them instead. The table
/// stands between the comments `<!-- NAME: from FILE -->` and `<!-- end of NAME -->`.
inline void expect_guide_table(const std::string& name, const std::string& rows) {
  const std::string path = LONGREACH_GUIDE "/operating.md";
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::string head_end = "---|\n", end = "<!-- end of " + name + " -->";
  std::size_t first = text.find("<!-- " + name + ": from ");
  if (first != std::string::npos) first = text.find(head_end, first);
  const std::size_t last = text.find(end, first);
  ASSERT_NE(last, std::string::npos) << path << " has no table between comments with the name " << name;
  first += head_end.size();
  if (std::getenv("LONGREACH_WRITE_GUIDE") != nullptr) {
    text.replace(first, last - first, rows);
    std::ofstream(path) << text;
    return;
  }
  EXPECT_EQ(text.substr(first, last - first), rows)
      << path << ": LONGREACH_WRITE_GUIDE=1 writes the table " << name;
}

}  // namespace longreach
