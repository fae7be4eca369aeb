#pragma once
// Finds the files that are named in a configuration, in a scene or on a command line. An absolute name is
// used unchanged. A relative name is searched for in the folder of the file that contains the name and in its
// parent folder (for a command line: in the working folder), then in LONGREACH_HOME, then in the
// installation.

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
  /// Returns a search that first tries the folder of `file` and its parent folder.
  [[nodiscard]] FileSearch beside(const std::filesystem::path& file) const;

  /// Returns the path of the file `name`; an absolute name is returned unchanged. Throws a ConfigError that
  /// lists the searched folders and names `what`, the field or option.
  [[nodiscard]] std::filesystem::path find(std::string_view what, const std::string& name) const;
  /// Finds a file that is given either as a path ending with .txtpb or as NAME, which stands for
  /// FOLDER/NAME.txtpb. For a link profile, for example, `what` is "link profile" and `folder` is "links".
  [[nodiscard]] std::filesystem::path find_named(const std::string& what, const std::string& folder,
                                                 const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Returns the folder to which relative names on a command line refer.
std::filesystem::path working_folder();

/// Returns a search in LONGREACH_HOME, then in the installation. Throws ConfigError if neither exists.
FileSearch installed_files();
/// Returns a search in `folder`, then in the installation.
FileSearch files_of(const std::filesystem::path& folder);

/// Resolves the file name in a setting PATH=VALUE from a command line (or from a file in the folder `from`).
/// If the field names a file and this file exists in `from`, returns the setting with the full path. Throws
/// ConfigError if no searched folder contains the file.
std::string placed_setting(const std::string& setting, const FileSearch& search,
                           const std::filesystem::path& from = working_folder());

/// A file that was read, and the field that named it.
struct FileRead {
  std::string field;
  std::filesystem::path path;
};

/// Same as the functions in config.hpp, but also append the files that were read to `read`.
void resolve_files(proto::SlaveConfig& config, const FileSearch& search, std::vector<FileRead>* read);
void resolve_files(proto::MasterConfig& config, const FileSearch& search, std::vector<FileRead>* read);
/// Loads a profile that a command line gives as a name or as a path relative to the working folder.
proto::LinkProfile load_link_profile(const FileSearch& search, const std::string& name,
                                     std::vector<FileRead>* read = nullptr);

}  // namespace longreach
