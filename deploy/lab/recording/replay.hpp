#pragma once
// Runs a node again on what was recorded of it: the inputs of every tick, from the first on, and compares its
// outputs, and what it shows, with those of the recording, bit for bit.
//
// A node's state is nowhere but in the node, so a replay begins where the node began: a recording that begins
// later, or lacks ticks, is followed as far as it can be, and says so.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace longreach {

/// The first value that is not the recorded one.
struct ReplayDifference {
  std::uint64_t tick = 0;
  double time_s = 0.0;  // since the first tick
  std::string field;    // e.g. output.wrench.force_n.x
  std::string recorded, replayed;
};

struct SideReplay {
  std::string side;            // master or slave
  std::uint64_t ticks = 0;     // replayed and the same
  double seconds = 0.0;        // between the first of them and the last, as recorded
  std::uint64_t messages = 0;  // received, in these ticks
  std::optional<ReplayDifference> difference{};
  std::string stopped{};  // why it could not be followed to its end, in words
};

struct FileReplay {
  std::vector<SideReplay> sides;
  bool whole = false;   // the file was ended properly
  double last_s = 0.0;  // of its last message, since its first
  std::string commit;   // that recorded it
};

/// Throws RecordingError for a file that cannot be read.
FileReplay replay_file(const std::filesystem::path& file);

/// `longreach-lab replay FILE...`: prints a line a side. 0: all bit for bit; 1: there is a difference; 2: not
/// all could be replayed.
int replay(const std::vector<std::string>& files, std::ostream& out, std::ostream& err);

}  // namespace longreach
