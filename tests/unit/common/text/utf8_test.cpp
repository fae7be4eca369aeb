#include "common/text/utf8.hpp"

#include <gtest/gtest.h>

namespace longreach::utf8_test {
namespace {

TEST(Utf8, PrintableEscapesControlsAndWhatIsNotUtf8) {
  EXPECT_EQ(printable("x [µm] \xe2\x88\x92"), "x [µm] \xe2\x88\x92");
  EXPECT_EQ(printable("\x1b[2J\r\x7f"), "\\x1b[2J\\x0d\\x7f");
  EXPECT_EQ(printable("\xb5m \xe2\x88"), "\\xb5m \\xe2\\x88");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");
}

}  // namespace
}  // namespace longreach::utf8_test
