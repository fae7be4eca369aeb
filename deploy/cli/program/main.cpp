// longreach: the command line client of a running master and slave.

#include <algorithm>
#include <iostream>
#include <string_view>
#include <variant>

#include "common/config/config.hpp"
#include "common/site/site.hpp"
#include "deploy/cli/command_line.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"

namespace {

using namespace std::string_view_literals;
using longreach::ExitStatus;

/// Help or version text as JSON.
std::string printout_json(const std::string& text) {
  return "{\"text\":" + longreach::json_string(text) + "}\n";
}

ExitStatus run(int argc, const char* const* argv) {
  // --json applies even if the command line cannot be parsed.
  const bool json = std::any_of(argv, argv + argc, [](const char* word) { return word == "--json"sv; });
  try {
    const auto asked = longreach::parse_command_line(argc, argv);
    if (const auto* printout = std::get_if<longreach::Printout>(&asked)) {
      std::cout << (json ? printout_json(printout->text) : printout->text);
      return printout->exit;
    }
    return longreach::run(std::get<longreach::Invocation>(asked));
  } catch (const longreach::SideError& error) {
    longreach::print_error(json, error.what());
    return error.kind() == longreach::SideError::Kind::kBadValue ? ExitStatus::kUsage : ExitStatus::kFailed;
  } catch (const longreach::UsageError& error) {
    longreach::print_error(json, error.what());
    return ExitStatus::kUsage;
  } catch (const longreach::ConfigError& error) {
    longreach::print_error(json, error.what());
    return ExitStatus::kUsage;
  } catch (const longreach::NoSiteError& error) {
    longreach::print_error(json, error.what());
    return ExitStatus::kUsage;
  } catch (const std::exception& error) {
    longreach::print_error(json, error.what());
    return ExitStatus::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) { return static_cast<int>(run(argc, argv)); }
