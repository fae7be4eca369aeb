// `longreach record`: starts and stops recordings at both sides by RPC, and lists and exports recordings on
// this machine.

#include <algorithm>
#include <cstdio>
#include <future>
#include <iostream>
#include <limits>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/recording_folder.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/record/csv_export.hpp"
#include "deploy/cli/record/recording_list.hpp"
#include "deploy/cli/side_client.hpp"

namespace longreach {
namespace {

/// The reply of a side, or its error.
struct Answer {
  std::string text;
  std::optional<SideError> error{};
};

template <class Call>
Answer ask(Side side, const Options& options, const Call& call) {
  try {
    SideClient client(side, options);
    return {call(client)};
  } catch (const SideError& error) {
    return {error.what(), error};
  }
}

/// Calls both sides in parallel. Successful if both calls are.
template <class Call>
ExitStatus at_both(const Options& options, const std::string& doing, const Call& call) {
  auto slave = std::async(std::launch::async, [&] { return ask(Side::kSlave, options, call); });
  const Answer master_answer = ask(Side::kMaster, options, call);
  const Answer slave_answer = slave.get();
  if (master_answer.error && slave_answer.error)
    throw SideError(master_answer.error->kind(), master_answer.text + "; " + slave_answer.text);
  const auto part = [&doing](const Answer& answer, const char* side) {
    return answer.error ? answer.text : doing + " at the " + side + ": " + answer.text;
  };
  print_done(options, part(master_answer, "master") + "; " + part(slave_answer, "slave"));
  return master_answer.error || slave_answer.error ? ExitStatus::kFailed : ExitStatus::kDone;
}

std::string json_of(const ListedRecording& r) {
  char numbers[120];
  std::snprintf(numbers, sizeof numbers,
                ",\"bytes\":\"%llu\",\"messages\":\"%llu\",\"seconds\":%.3f,\"whole\":%s",
                static_cast<unsigned long long>(r.bytes), static_cast<unsigned long long>(r.messages),
                r.seconds, r.whole ? "true" : "false");
  return "{\"file\":" + json_string(r.file.string()) + ",\"side\":" + json_string(r.side) +
         ",\"began\":" + json_string(r.began) + numbers + ",\"trouble\":" + json_string(r.trouble) + "}";
}

ExitStatus list(const Options& options, const RecordCommand& command) {
  const std::filesystem::path folder =
      command.folder.empty() ? default_recordings() : std::filesystem::path(command.folder);
  if (!command.folder.empty() && !std::filesystem::is_directory(folder))
    throw UsageError("the folder " + folder.string() + " does not exist");
  const auto recordings = list_recordings(folder);
  if (options.json) {
    std::string out;
    for (const auto& r : recordings) out += (out.empty() ? "" : ",") + json_of(r);
    std::cout << "{\"recordings\":[" << out << "]}" << std::endl;
    return ExitStatus::kDone;
  }
  for (const auto& r : recordings) {
    if (!r.trouble.empty()) {
      std::cout << r.trouble << "\n";
      continue;
    }
    char line[120];
    std::snprintf(line, sizeof line, "%8.1f s %9.1f MB  %-16s %s  ", r.seconds,
                  1e-6 * static_cast<double>(r.bytes), r.began.c_str(), r.whole ? "whole" : "cut  ");
    std::cout << line << r.file.string() << "\n";
  }
  if (recordings.empty()) std::cout << "no recordings in " << folder.string() << "\n";
  std::cout.flush();
  return ExitStatus::kDone;
}

std::string formatted_cut(double last_s) {
  char text[80];
  std::snprintf(text, sizeof text, " is truncated: data after t_s = %.1f is lost", last_s);
  return text;
}

/// Files that are exported together share their time origin: t_s of every table starts at their first
/// message.
ExitStatus export_tables(const Options& options, const RecordCommand& command) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : command.files) {
    const bool path = name.find('/') != std::string::npos;
    const auto found = find_recordings(path ? std::filesystem::path() : default_recordings(), name);
    files.insert(files.end(), found.begin(), found.end());
  }
  std::uint64_t zero_ns = std::numeric_limits<std::uint64_t>::max();
  for (const auto& file : files) {
    const McapFigures figures = mcap_figures(file);  // a file that is not a recording is reported as such
    if (figures.messages > 0) zero_ns = std::min(zero_ns, figures.first_ns);
  }
  std::uint64_t tables = 0, rows = 0;
  std::string folders, skipped, lost;
  for (const auto& file : files) {
    const std::filesystem::path folder =
        command.folder.empty() ? file.parent_path() / file.stem() : std::filesystem::path(command.folder);
    if (folder == file)
      throw UsageError(file.string() + " has no extension: give a folder for the tables with --out DIR");
    const CsvExport written = export_csv(file, folder, zero_ns);
    for (const auto& table : written.tables) rows += table.rows;
    tables += written.tables.size();
    for (const std::string& what : written.damaged)
      lost += "; damaged data in " + file.string() + " was skipped: " + what;
    if (!written.whole) lost += "; " + file.string() + formatted_cut(written.last_s);
    for (const std::string& topic : written.skipped) skipped += (skipped.empty() ? "" : ", ") + topic;
    if (folders.find(folder.string()) == std::string::npos)
      folders += (folders.empty() ? "" : " and ") + folder.string();
  }
  print_done(options,
             std::to_string(tables) + " tables with " + std::to_string(rows) + " rows in " + folders +
                 (skipped.empty() ? "" : "; skipped, because they are not protobuf: " + skipped) + lost);
  return ExitStatus::kDone;
}

}  // namespace

ExitStatus run_record(const Options& options, const RecordCommand& command) {
  try {
    switch (command.what) {
      case RecordCommand::What::kStart: {
        const std::string name = command.name.empty() ? recording_name_now() : command.name;
        check_recording_name(name);
        proto::Action starts;
        starts.mutable_start_recording()->set_name(name);
        starts.mutable_start_recording()->set_max_mb(command.max_mb);
        return at_both(options, "recording", [&](SideClient& side) { return side.run(starts); });
      }
      case RecordCommand::What::kStop: {
        proto::Action stops;
        stops.mutable_stop_recording();
        return at_both(options, "recorded", [&](SideClient& side) { return side.run(stops); });
      }
      case RecordCommand::What::kList:
        return list(options, command);
      case RecordCommand::What::kExport:
        break;
    }
    return export_tables(options, command);
  } catch (const RecordingError& e) {
    throw UsageError(e.what());
  }
}

}  // namespace longreach
