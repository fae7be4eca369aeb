#include "deploy/lab/recording/replay.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ostream>

#include "common/config/config.hpp"
#include "common/link/header.hpp"
#include "common/recording/build_name.hpp"
#include "common/recording/mcap_reader.hpp"
#include "common/recording/quiet_protobuf.hpp"
#include "common/recording/recording_error.hpp"
#include "deploy/lab/recording/node_replay.hpp"

namespace longreach {
namespace {

constexpr int kSame = 0, kDifferent = 1, kNotReplayed = 2;

/// Returns "tick" for the topic "/master/tick" and the side "master", or an empty string for a topic of
/// another side.
std::string_view name_in(std::string_view topic, std::string_view side) {
  if (topic.size() < side.size() + 2 || topic.substr(1, side.size()) != side || topic[side.size() + 1] != '/')
    return {};
  return topic.substr(side.size() + 2);
}

/// Limits texts to 200 characters, which is enough for a result line.
template <class... Values>
std::string line(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

int judge(const SideReplay& side, double spent_s, std::ostream& out) {
  const auto ticks = static_cast<unsigned long long>(side.ticks);
  out << side.side << ": ";
  if (side.difference) {
    const ReplayDifference& d = *side.difference;
    out << line("first difference at tick %llu (%.6f s): ", static_cast<unsigned long long>(d.tick), d.time_s)
        << d.field << " is " << d.recorded << " in the recording, " << d.replayed << " in the replay\n";
    return kDifferent;
  }
  out << line("%llu ticks, %.1f s, %llu messages: outputs and views match the recorded ones bit for bit",
              ticks, side.seconds, static_cast<unsigned long long>(side.messages));
  if (side.seconds > 0.0) out << line(", %.0f times faster than real time", side.seconds / spent_s);
  if (!side.stopped.empty()) out << "; stopped: " << side.stopped;
  out << "\n";
  return side.stopped.empty() && side.ticks > 0 ? kSame : kNotReplayed;
}

}  // namespace

/// Returns metadata of the recording, or an empty string if there is none with this name.
std::string fact(const McapReader& reader, const std::string& name) {
  const auto facts = reader.metadata().find("longreach");
  if (facts == reader.metadata().end()) return "";
  const auto found = facts->second.find(name);
  return found == facts->second.end() ? "" : found->second;
}

/// Messages of another wire version have other fields, which the nodes of this version cannot process.
void refuse_other_wire(const McapReader& reader, const std::filesystem::path& file) {
  const std::string wire = fact(reader, "wire"), commit = fact(reader, "commit");
  if (wire == std::to_string(kWireVersion) || (wire.empty() && commit.empty())) return;
  throw RecordingError(file.string() + " was recorded with wire version " +
                       (wire.empty() ? "3 or older" : wire) + ", but this program uses version " +
                       std::to_string(kWireVersion) + "; replay it with the program built from commit " +
                       commit + ", or read it with this version of `longreach record export`");
}

FileReplay replay_file(const std::filesystem::path& file) {
  McapReader reader(file);
  MasterReplay master;
  SlaveReplay slave;
  bool has_master = false, has_slave = false;
  std::uint64_t began_ns = 0, last_ns = 0;
  const QuietProtobuf quiet;
  try {
    std::optional<std::uint64_t> first_ns;
    while (const auto message = reader.next()) {
      if (!reader.lost().empty()) break;               // the nodes need every tick
      if (!first_ns) refuse_other_wire(reader, file);  // metadata precedes all messages
      first_ns = first_ns.value_or(message->log_time_ns);
      last_ns = std::max({last_ns, *first_ns, message->log_time_ns});
      began_ns = *first_ns;
      if (const auto name = name_in(message->channel->topic, "master"); !name.empty()) {
        has_master = true;
        master.take(name, message->bytes);
      } else if (const auto other = name_in(message->channel->topic, "slave"); !other.empty()) {
        has_slave = true;
        slave.take(other, message->bytes);
      }
    }
  } catch (const ConfigError& e) {
    throw RecordingError(file.string() + ": " + e.what());
  } catch (const RecordingError& e) {
    if (std::string_view(e.what()).starts_with(file.string())) throw;
    throw RecordingError(file.string() + " is damaged: " + e.what());
  }
  if (!reader.lost().empty()) {
    const std::string why = lost_sentence({reader.lost().front()}, began_ns);
    if (has_master) master.stop(why);
    if (has_slave) slave.stop(why);
  }
  FileReplay out;
  out.last_s = 1e-9 * static_cast<double>(last_ns - began_ns);
  out.whole = reader.whole();
  out.commit = fact(reader, "commit");
  if (has_master) out.sides.push_back(master.result());
  if (has_slave) out.sides.push_back(slave.result());
  return out;
}

int replay(const std::vector<std::string>& files, std::ostream& out, std::ostream& err) {
  int worst = kSame;
  for (const std::string& file : files) {
    FileReplay result;
    const auto began = std::chrono::steady_clock::now();
    try {
      result = replay_file(file);
    } catch (const RecordingError& e) {
      err << "longreach-lab: " << e.what() << "\n";
      worst = kNotReplayed;
      continue;
    }
    const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (result.sides.empty()) {
      err << "longreach-lab: " << file << " contains no data of a master or slave\n";
      worst = kNotReplayed;
    }
    if (!result.commit.empty() && result.commit != build_commit())
      err << "longreach-lab: " << file << " was recorded by a program built from commit " << result.commit
          << "; this program was built from commit " << build_commit() << "\n";
    for (const SideReplay& side : result.sides) {
      const int status = judge(side, spent_s, out);
      if (status == kDifferent || worst == kSame) worst = status;
    }
    if (!result.whole) out << file << line(" is truncated: data after %.1f s is lost\n", result.last_s);
  }
  return worst;
}

}  // namespace longreach
