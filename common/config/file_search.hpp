#pragma once
// Where a file is looked for that a configuration, a scene or a command line names. One rule for all: an
// absolute name as it is; else from the folder of the file that names it and the one above (on a command
// line: from the working folder), then from LONGREACH_HOME, then from the installation.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "proto/config.pb.h"

namespace longreach {

class FileSearch {
 public:
  explicit FileSearch(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// The same, but before all in `folder`.
  [[nodiscard]] FileSearch first_in(const std::filesystem::path& folder) const;
  /// The same, but before all in the folder of `file` and the one above.
  [[nodiscard]] FileSearch beside(const std::filesystem::path& file) const;

  /// The path of `name`; of an absolute one itself. Throws ConfigError that lists the folders. `what`: the
  /// field or option, for the error.
  [[nodiscard]] std::filesystem::path find(std::string_view what, const std::string& name) const;
  /// A path that ends with .txtpb, or NAME, which stands for FOLDER/NAME.txtpb. `what`: "link profile" in
  /// "links", say.
  [[nodiscard]] std::filesystem::path find_named(const std::string& what, const std::string& folder,
                                                 const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Relative names of a command line count from here.
std::filesystem::path working_folder();

/// From LONGREACH_HOME, then from the installation. Throws ConfigError where there is neither.
FileSearch installed_files();
/// From `folder`, then from the installation.
FileSearch files_of(const std::filesystem::path& folder);

/// A setting PATH=VALUE of a command line (or of a file in `from`): where its field names a file that is in
/// `from`, with the whole path. Throws ConfigError where it is in no folder.
std::string placed_setting(const std::string& setting, const FileSearch& search,
                           const std::filesystem::path& from = working_folder());

/// A file that was read, and the field that named it.
struct FileRead {
  std::string field;
  std::filesystem::path path;
};

/// As those of config.hpp; `read` gets what was read.
void resolve_files(proto::SlaveConfig& config, const FileSearch& search, std::vector<FileRead>* read);
void resolve_files(proto::MasterConfig& config, const FileSearch& search, std::vector<FileRead>* read);
/// Of a command line: a name, or a path from the working folder.
proto::LinkProfile load_link_profile(const FileSearch& search, const std::string& name,
                                     std::vector<FileRead>* read = nullptr);

}  // namespace longreach
