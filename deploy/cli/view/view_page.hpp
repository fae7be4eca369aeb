#pragma once
// The page, bundled by the build from master/console/page.

#include <string_view>

namespace longreach {

struct ViewPage {
  std::string_view html;
  std::string_view script;
  std::string_view style;
};

ViewPage view_page();

}  // namespace longreach
