#pragma once
// Files of a campaign: DIR/campaign.txtpb identifies it, DIR/cells/NUMBER.txtpb has the result of a cell.
// Each file is written under a temporary name and renamed, so that it is always complete, also if several
// programs, on one host or on many, write into one folder.

#include <filesystem>
#include <optional>
#include <string>

#include "proto/campaign.pb.h"

namespace longreach {

/// Writes the text of a file atomically. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);

class CampaignFolder {
 public:
  /// A folder of `record`: created if it does not exist. Throws ConfigError if it belongs to another
  /// campaign.
  CampaignFolder(std::filesystem::path folder, const proto::CampaignRecord& record);
  /// Opens an existing folder. Throws ConfigError if it does not belong to a campaign.
  explicit CampaignFolder(std::filesystem::path folder);

  [[nodiscard]] const proto::CampaignRecord& record() const { return record_; }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Result of a cell, if it is done. Throws ConfigError for a result of another campaign.
  [[nodiscard]] std::optional<proto::CellRecord> result(std::size_t cell) const;
  /// Completes `result` (campaign, cell, complete) and writes it. Throws std::runtime_error.
  void write(std::size_t cell, proto::CellRecord result) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t cell) const;

  std::filesystem::path folder_;
  proto::CampaignRecord record_;
  std::string name_;  // hash of the record
};

/// Returns why results of one do not belong to the other, for example "of commit A, not B"; empty if they do.
std::string difference(const proto::CampaignRecord& one, const proto::CampaignRecord& other);

}  // namespace longreach
