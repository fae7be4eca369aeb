#pragma once
// Search for files that a configuration, a scene or a command line names. One rule applies to all: an
// absolute name is used as it is; other names are searched in the folder of the file that names it and its
// parent (on a command line: in the working folder), then in LONGREACH_HOME, then in the installation.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "proto/config.pb.h"

namespace longreach {

class FileSearch {
 public:
  explicit FileSearch(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// Returns a search that tries `folder` first.
  [[nodiscard]] FileSearch first_in(const std::filesystem::path& folder) const;
  /// Returns a search that tries the folder of `file` and its parent first.
  [[nodiscard]] FileSearch beside(const std::filesystem::path& file) const;

  /// Returns the path of `name`; an absolute name itself. Throws ConfigError that lists the folders. `what`
  /// is the field or option, for the error.
  [[nodiscard]] std::filesystem::path find(std::string_view what, const std::string& name) const;
  /// Accepts a path that ends with .txtpb, or NAME, which stands for FOLDER/NAME.txtpb. `what` is "link
  /// profile" in "links", for example.
  [[nodiscard]] std::filesystem::path find_named(const std::string& what, const std::string& folder,
                                                 const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Base folder of relative names on a command line.
std::filesystem::path working_folder();

/// Searches LONGREACH_HOME, then the installation. Throws ConfigError if neither exists.
FileSearch installed_files();
/// Searches `folder`, then the installation.
FileSearch files_of(const std::filesystem::path& folder);

/// Resolves a setting PATH=VALUE of a command line (or of a file in `from`): if its field names a file in
/// `from`, returns it with the full path. Throws ConfigError if the file is in no folder.
std::string placed_setting(const std::string& setting, const FileSearch& search,
                           const std::filesystem::path& from = working_folder());

/// A file that was read, and the field that names it.
struct FileRead {
  std::string field;
  std::filesystem::path path;
};

/// Like those of config.hpp; `read` receives the files that were read.
void resolve_files(proto::SlaveConfig& config, const FileSearch& search, std::vector<FileRead>* read);
void resolve_files(proto::MasterConfig& config, const FileSearch& search, std::vector<FileRead>* read);
/// For a command line: a name, or a path relative to the working folder.
proto::LinkProfile load_link_profile(const FileSearch& search, const std::string& name,
                                     std::vector<FileRead>* read = nullptr);

}  // namespace longreach
