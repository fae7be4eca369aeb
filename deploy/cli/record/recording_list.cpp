#include "deploy/cli/record/recording_list.hpp"

#include <algorithm>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/recording_error.hpp"

namespace longreach {
namespace {

ListedRecording listed(const std::filesystem::path& file) {
  ListedRecording out{.file = file};
  try {
    std::error_code gone;
    out.bytes = std::filesystem::file_size(file, gone);
    const McapFigures figures = mcap_figures(file);
    out.messages = figures.messages;
    out.seconds = 1e-9 * static_cast<double>(figures.last_ns - figures.first_ns);
    out.whole = figures.whole;
    McapReader reader(file);
    (void)reader.next();
    if (const auto facts = reader.metadata().find("longreach"); facts != reader.metadata().end()) {
      TextMap known = facts->second;
      out.began = known["began"];
      out.side = known["side"];
    }
  } catch (const RecordingError& e) {
    out.trouble = e.what();
  }
  return out;
}

}  // namespace

std::vector<ListedRecording> list_recordings(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return {};
  std::vector<ListedRecording> out;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".mcap") out.push_back(listed(entry.path()));
  if (error) throw RecordingError("cannot read the folder " + folder.string() + ": " + error.message());
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  return out;
}

std::vector<std::filesystem::path> find_recordings(const std::filesystem::path& folder,
                                                   const std::string& name) {
  std::error_code ignored;
  const auto is_file = [&](const std::filesystem::path& path) {
    return std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored);
  };
  if (is_file(name)) return {name};
  const bool plain = !name.empty() && name.find('/') == std::string::npos;
  std::vector<std::filesystem::path> found;
  for (const std::string end : {"", ".mcap", "-master.mcap", "-slave.mcap"}) {
    if (plain && is_file(folder / (name + end))) found.push_back(folder / (name + end));
    if (!found.empty() && end != "-master.mcap") break;
  }
  if (found.empty())
    throw RecordingError("there is no recording " + name + (plain ? " here or in " + folder.string() : "") +
                         "; `longreach record list` lists the recordings");
  return found;
}

}  // namespace longreach
