#pragma once
// Runs a node again on its recorded inputs, from the first tick on, and compares its outputs and its view
// with the recorded ones, bit for bit.
//
// The state of a node is not recorded, so a replay begins at the start of the node: a recording that begins
// later, or lacks ticks, is replayed as far as possible, and the result says so.

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
  double time_s = 0.0;  // since the first tick
  std::string field;    // e.g. output.wrench.force_n.x
  std::string recorded, replayed;
};

struct SideReplay {
  std::string side;            // master or slave
  std::uint64_t ticks = 0;     // replayed without a difference
  double seconds = 0.0;        // between the first of them and the last, as recorded
  std::uint64_t messages = 0;  // received, in these ticks
  std::optional<ReplayDifference> difference{};
  std::string stopped{};  // why it could not be replayed to its end
};

struct FileReplay {
  std::vector<SideReplay> sides;
  bool whole = false;   // the file was completed
  double last_s = 0.0;  // of its last message, since its first
  std::string commit;   // of the recording program
};

/// Throws RecordingError if the file cannot be read.
FileReplay replay_file(const std::filesystem::path& file);

/// `longreach-lab replay FILE...`: prints a line per side. 0: equal bit for bit; 1: there is a difference; 2:
/// not everything could be replayed.
int replay(const std::vector<std::string>& files, std::ostream& out, std::ostream& err);

}  // namespace longreach
