#pragma once
// The page in master/console/page, which the build embeds in the program.

#include <string_view>

namespace longreach {

struct ViewPage {
  std::string_view html;
  std::string_view script;
  std::string_view style;
};

ViewPage view_page();

}  // namespace longreach
