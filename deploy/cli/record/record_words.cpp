#include "deploy/cli/record/record_words.hpp"

#include "common/text/number_text.hpp"

namespace longreach {
namespace {

constexpr const char* kRecordMore =
    R"(Each side records into its own folder (option --recordings of longreach-master and longreach-slave). These
recordings can be exported but not replayed; for a replay, start the programs with --record FILE.
Example: longreach record start drill-3)";

CLI::App* declare_one(CLI::App& parent, const char* name, const char* help, const char* more) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->footer(more);
  command->fallthrough();
  return command;
}

}  // namespace

void RecordWords::declare(CLI::App& app) {
  record_ = declare_one(app, "record", "record both sides, list and export recordings", kRecordMore);
  record_->require_subcommand(1);
  CLI::App* start = declare_one(*record_, "start", "start a recording on both sides",
                                "The default name is the current time. A recording ends when it "
                                "reaches --max-mb or the disk is full.\n"
                                "Example: longreach record start drill-3");
  start->add_option("NAME", name_, "base name of the files NAME-master.mcap and NAME-slave.mcap");
  start->add_option("--max-mb", max_mb_, "maximum size of a recording, 1 to 1000000 [4096]")->type_name("N");
  declare_one(*record_, "stop", "stop the recordings on both sides", "Example: longreach record stop");
  CLI::App* list = declare_one(*record_, "list", "list the recordings on this machine",
                               "A recording that is still being written is shown as truncated.\n"
                               "Example: longreach record list");
  list->add_option("DIR", folder_, "recordings folder [$XDG_STATE_HOME/longreach/recordings]");
  CLI::App* csv =
      declare_one(*record_, "export", "export a recording as tables, one CSV file per topic",
                  "Columns: t_s (time since the earliest message in all given files), log_time_ns "
                  "(Unix time,\n"
                  "to join tables of different recordings), and every number of the topic.\n"
                  "Example: longreach record export drill-3");
  csv->add_option("FILE", files_,
                  "files, or names as in `record start` and `record list`; a name stands for the "
                  "files of both sides")
      ->required();
  csv->add_flag("--csv", csv_, "export as CSV, the only format");
  csv->add_option("--out", folder_, "folder for the tables, created if missing [FILE without .mcap]")
      ->type_name("DIR");
}

RecordCommand RecordWords::command() const {
  RecordCommand out;
  out.name = name_;
  out.folder = folder_;
  out.files = files_;
  if (record_->got_subcommand("start")) {
    out.what = RecordCommand::What::kStart;
    const auto max_mb = parse_number(max_mb_);
    if (!max_mb || !(*max_mb >= 1.0 && *max_mb <= 1e6))
      throw UsageError("--max-mb = " + max_mb_ + " is not a number from 1 to 1000000");
    out.max_mb = *max_mb;
  } else if (record_->got_subcommand("stop")) {
    out.what = RecordCommand::What::kStop;
  } else if (record_->got_subcommand("list")) {
    out.what = RecordCommand::What::kList;
  } else {
    out.what = RecordCommand::What::kExport;
  }
  return out;
}

}  // namespace longreach
