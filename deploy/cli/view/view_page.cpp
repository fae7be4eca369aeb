#include "deploy/cli/view/view_page.hpp"

// Defined in view_page.S.
extern "C" {
extern const char longreach_page_html_begin[], longreach_page_html_end[];
extern const char longreach_page_script_begin[], longreach_page_script_end[];
extern const char longreach_page_style_begin[], longreach_page_style_end[];
}

namespace longreach {

ViewPage view_page() {
  return {{longreach_page_html_begin, longreach_page_html_end},
          {longreach_page_script_begin, longreach_page_script_end},
          {longreach_page_style_begin, longreach_page_style_end}};
}

}  // namespace longreach
