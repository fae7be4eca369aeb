#pragma once
// What a campaign leaves on disk: DIR/campaign.txtpb says whose it is, DIR/cells/NUMBER.txtpb what a cell
// gave. Each file is written under another name and renamed: it is there as a whole or not at all, also when
// several programs, on one host or on many, write into one folder.

#include <filesystem>
#include <optional>
#include <string>

#include "proto/campaign.pb.h"

namespace longreach {

/// Text of a file that is replaced as a whole. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);

class CampaignFolder {
 public:
  /// A folder of `record`: made if it is not there. Throws ConfigError if it is that of another campaign.
  CampaignFolder(std::filesystem::path folder, const proto::CampaignRecord& record);
  /// What is in a folder. Throws ConfigError if it is none of a campaign.
  explicit CampaignFolder(std::filesystem::path folder);

  [[nodiscard]] const proto::CampaignRecord& record() const { return record_; }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Of a cell, if it is done. Throws ConfigError for a result of another campaign.
  [[nodiscard]] std::optional<proto::CellRecord> result(std::size_t cell) const;
  /// Completes `result` (campaign, cell, complete) and writes it. Throws std::runtime_error.
  void write(std::size_t cell, proto::CellRecord result) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(std::size_t cell) const;

  std::filesystem::path folder_;
  proto::CampaignRecord record_;
  std::string name_;  // hash of the record
};

/// Why results of the one do not belong to the other, as "of commit A, not B"; empty if they do.
std::string difference(const proto::CampaignRecord& one, const proto::CampaignRecord& other);

}  // namespace longreach
