#pragma once
// A recording of a laboratory run with both sides in one file, in the same format as recordings by the real
// programs. The record buffers are also the same, but they are written to the file between ticks, so that
// identical runs give identical files. Time stamps are in the virtual time of the run.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/recording/mcap_writer.hpp"
#include "common/recording/recording_file.hpp"
#include "master/recording/master_record_buffer.hpp"
#include "master/side/master_side.hpp"
#include "slave/recording/slave_record_buffer.hpp"
#include "slave/side/slave_side.hpp"

namespace longreach {

class LabRecording {
 public:
  /// Initial clock readings of the two sides.
  struct Clocks {
    Time master{}, slave{};
  };
  /// Throws RecordingError.
  LabRecording(const std::filesystem::path& file, const MasterConfig& master, const SlaveConfig& slave,
               std::uint64_t seed, const Clocks& clocks);
  ~LabRecording();
  LabRecording(const LabRecording&) = delete;
  LabRecording& operator=(const LabRecording&) = delete;

  /// Adds the last tick of a side.
  void add_slave_tick(const SlaveSide& side);
  void add_master_tick(const MasterSide& side);

  /// Writes the remaining records. Throws RecordingError if anything could not be written.
  void finish();

 private:
  void drain();

  RecordingFile file_;
  McapWriter writer_;
  MasterRecordBuffer master_;
  SlaveRecordBuffer slave_;
  std::uint64_t master_ticks_ = 0, slave_ticks_ = 0;
  std::uint64_t undrained_ = 0;  // upper bound on the number of buffered records
  bool finished_ = false;
};

}  // namespace longreach
