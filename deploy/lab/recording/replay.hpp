#pragma once
// Runs a node again with its recorded inputs, starting at the first tick, and compares its outputs and its
// view with the recorded ones bit by bit.
//
// The internal state of a node is not recorded, so a replay must begin at the start of the node. A recording
// that begins later or has missing ticks is replayed as far as possible, and the result states the reason.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// The first value that differs from the recording.
struct ReplayDifference {
  std::uint64_t tick = 0;
  double time_s = 0.0;  // time since the first tick
  std::string field;    // e.g. output.wrench.force_n.x
  std::string recorded, replayed;
};

struct SideReplay {
  std::string side;            // master or slave
  std::uint64_t ticks = 0;     // number of ticks replayed without a difference
  double seconds = 0.0;        // recorded time between the first and the last of these ticks
  std::uint64_t messages = 0;  // number of messages received in these ticks
  std::optional<ReplayDifference> difference{};
  std::string stopped{};  // reason why the replay stopped before the end; empty: it reached the end
};

struct FileReplay {
  std::vector<SideReplay> sides;
  bool whole = false;   // the file was closed properly
  double last_s = 0.0;  // time from the first to the last message
  std::string commit;   // commit of the program that made the recording
};

/// Throws RecordingError if the file cannot be read.
FileReplay replay_file(const std::filesystem::path& file);

/// `longreach-lab replay FILE...`: prints one line per side. Returns 0 if all values are bitwise equal, 1 if
/// there is a difference, or 2 if a file could only be replayed in part.
int replay(const std::vector<std::string>& files, std::ostream& out, std::ostream& err);

}  // namespace longreach
