#include "common/io/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "common/config/config.hpp"

namespace longreach {
namespace {

spdlog::sink_ptr make_sink(const std::string& file, bool quiet) {
  if (file.empty() && quiet) return std::make_shared<spdlog::sinks::null_sink_mt>();
  if (file.empty()) return std::make_shared<spdlog::sinks::stderr_sink_mt>();
  try {
    return std::make_shared<spdlog::sinks::basic_file_sink_mt>(file);
  } catch (const spdlog::spdlog_ex& e) {
    throw ConfigError("cannot write the log file '" + file + "' (" + e.what() +
                      "); choose another with --log");
  }
}

}  // namespace

void set_up_log(const std::string& side, const std::string& file, bool quiet) {
  auto logger = std::make_shared<spdlog::logger>(side, make_sink(file, quiet));
  logger->set_formatter(std::make_unique<spdlog::pattern_formatter>("%Y-%m-%dT%H:%M:%S.%eZ %l %n %v",
                                                                    spdlog::pattern_time_type::utc));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace longreach
