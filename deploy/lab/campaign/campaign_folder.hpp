#pragma once
// The files of a campaign: DIR/campaign.txtpb identifies the campaign, and DIR/cells/NUMBER.txtpb contains
// the result of a cell. Each file is written under a temporary name and then renamed, so that it is always
// complete, even if several processes on one or more hosts write to the same folder.

#include <filesystem>
#include <optional>
#include <string>

#include "proto/campaign.pb.h"

namespace longreach {

/// Writes a text file atomically. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);

class CampaignFolder {
 public:
  /// Opens the folder of the campaign `record` and creates it if it does not exist. Throws ConfigError if the
  /// folder belongs to another campaign.
  CampaignFolder(std::filesystem::path folder, const proto::CampaignRecord& record);
  /// Opens an existing folder. Throws ConfigError if the folder does not belong to a campaign.
  explicit CampaignFolder(std::filesystem::path folder);

  [[nodiscard]] const proto::CampaignRecord& record() const { return record_; }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Returns the result of a cell, if it is complete. Throws ConfigError if the file belongs to another
  /// campaign.
  [[nodiscard]] std::optional<proto::CellRecord> result(std::size_t cell) const;
  /// Sets the fields campaign, cell and complete of `result` and writes it. Throws std::runtime_error.
  void write(std::size_t cell, proto::CellRecord result) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t cell) const;

  std::filesystem::path folder_;
  proto::CampaignRecord record_;
  std::string name_;  // hash of the record
};

/// Returns how two campaigns differ, for example "from commit A, not B", or an empty string if they are the
/// same.
std::string difference(const proto::CampaignRecord& one, const proto::CampaignRecord& other);

}  // namespace longreach
