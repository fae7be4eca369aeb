#include "deploy/lab/campaign/campaign_folder.hpp"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/lab/name_hash.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;
using google::protobuf::TextFormat;

constexpr const char* kRecord = "campaign.txtpb";

std::string text_of(const google::protobuf::Message& message) {
  std::string text;
  TextFormat::PrintToString(message, &text);
  return text;
}

class Silent : public google::protobuf::io::ErrorCollector {
  void AddError(int, int, const std::string&) override {}
};

}  // namespace

void write_whole(const fs::path& file, const std::string& text) {
  const fs::path part = file.string() + "." + std::to_string(::getpid()) + ".part";
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(part, file, error);
  if (stream && !error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  throw std::runtime_error("cannot write " + file.string() +
                           ": check the free disk space and the permissions of the folder");
}

std::string difference(const proto::CampaignRecord& one, const proto::CampaignRecord& other) {
  if (one.commit() != other.commit()) return "from commit " + one.commit() + ", not " + other.commit();
  if (text_of(one.campaign()) != text_of(other.campaign())) return "from another grid";
  if (one.configs() != other.configs()) return "from this grid, but with different files in deploy/";
  if (one.full() != other.full())
    return one.full() ? "from a full-size campaign (LONGREACH_FULL), not a small one"
                      : "from a small campaign, not a full-size one (LONGREACH_FULL)";
  return "";
}

CampaignFolder::CampaignFolder(fs::path folder, const proto::CampaignRecord& record)
    : folder_(std::move(folder)), record_(record), name_(name_hash(text_of(record))) {
  if (fs::exists(folder_ / kRecord)) {
    const std::string why = difference(CampaignFolder(folder_).record(), record);
    if (!why.empty())
      throw ConfigError(folder_.string() + " contains results " + why + "; choose another folder with --out");
  }
  std::error_code error;
  fs::create_directories(folder_ / "cells", error);
  if (error) throw ConfigError(folder_.string() + " cannot be created: " + error.message());
  if (!fs::exists(folder_ / kRecord)) write_whole(folder_ / kRecord, text_of(record));
}

CampaignFolder::CampaignFolder(fs::path folder) : folder_(std::move(folder)) {
  if (!fs::exists(folder_ / kRecord))
    throw ConfigError(folder_.string() + " was not written by `longreach-lab sweep`: it does not contain " +
                      kRecord);
  load_text_file(folder_ / kRecord, record_);
  name_ = name_hash(text_of(record_));
}

fs::path CampaignFolder::file_of(std::size_t cell) const {
  return folder_ / "cells" / (std::to_string(cell) + ".txtpb");
}

std::optional<proto::CellRecord> CampaignFolder::result(std::size_t cell) const {
  std::ifstream stream(file_of(cell), std::ios::binary);
  if (!stream) return std::nullopt;
  proto::CellRecord record;
  Silent silent;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&silent);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  // Files are written without fsync and may be truncated after a power failure. Such a cell is run again.
  if (!parser.ParseFromString(text, &record) || !record.complete()) return std::nullopt;
  if (record.campaign() != name_ || record.cell() != cell)
    throw ConfigError(file_of(cell).string() +
                      " belongs to another campaign; remove it or choose another folder");
  return record;
}

void CampaignFolder::write(std::size_t cell, proto::CellRecord result) const {
  result.set_campaign(name_);
  result.set_cell(static_cast<std::uint32_t>(cell));
  result.set_complete(true);
  write_whole(file_of(cell), text_of(result));
}

}  // namespace longreach
