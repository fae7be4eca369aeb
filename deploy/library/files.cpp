#include "deploy/library/files.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "common/config/deploy_folder.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_library() {
  Dl_info found{};
  if (::dladdr(reinterpret_cast<const void*>(&library_files), &found) == 0 || found.dli_fname == nullptr)
    return {};
  std::error_code ignored;
  return fs::canonical(found.dli_fname, ignored).parent_path();
}

}  // namespace

fs::path library_files() {
  DeploySearch search;
  if (const char* home = std::getenv("LONGREACH_HOME")) search.longreach_home = home;
  search.program_folder = folder_of_library();
  search.working_folder = working_folder();
  return find_deploy_folder(search);
}

FileSearch library_search() { return files_of(library_files()).first_in(working_folder()); }

void require_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InputError(std::string(name) + " = " + format_number(value) + " is outside " + format_number(low) +
                   " to " + format_number(high));
}

InputError::InputError(const std::string& sentence) : std::invalid_argument(sentence) {}
InputError::~InputError() = default;

std::string library_version() { return LONGREACH_VERSION; }

}  // namespace longreach
