#include "deploy/lab/recording/lab_recording.hpp"

#include "common/config/config.hpp"
#include "common/link/header.hpp"
#include "common/recording/build_name.hpp"
#include "common/recording/recording_error.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kDrainAt = 1000;  // records; a record buffer holds four times as many

}  // namespace

LabRecording::LabRecording(const std::filesystem::path& file, const MasterConfig& master,
                           const SlaveConfig& slave, std::uint64_t seed, const Clocks& clocks)
    : file_(file),
      writer_(file_, build_name()),
      master_(master.loop.rate_hz, -clocks.master.time_since_epoch()),
      slave_(slave.loop.rate_hz, -clocks.slave.time_since_epoch()) {
  writer_.add_metadata("longreach", {{"side", "both"},
                                     {"version", std::string(build_version())},
                                     {"wire", std::to_string(kWireVersion)},
                                     {"commit", std::string(build_commit())},
                                     {"seed", std::to_string(seed)}});
  master_.declare(writer_);
  slave_.declare(writer_);
  master_.add_config(clocks.master, 0, recorded_text(to_message(master)));
  slave_.add_config(clocks.slave, 0, recorded_text(to_message(slave)));
}

LabRecording::~LabRecording() {
  if (finished_) return;
  drain();
  writer_.finish();
}

void LabRecording::add_slave_tick(const SlaveSide& side) {
  const SlaveInput& input = side.input();
  const std::uint64_t tick = slave_ticks_++;
  slave_.add_tick(tick, 0, input, side.output(), side.node().view());
  if (slave_.link_due(tick)) slave_.add_link(link_sample(input.now, side.figures()));
  undrained_ += input.commands.size() + 3;
  if (undrained_ >= kDrainAt) drain();
}

void LabRecording::add_master_tick(const MasterSide& side) {
  const MasterInput& input = side.input();
  const std::uint64_t tick = master_ticks_++;
  master_.add_tick(tick, 0, input, side.output(), side.node().view());
  if (master_.link_due(tick)) master_.add_link(link_sample(input.now, side.figures()));
  undrained_ += input.reports.size() + input.telemetry.size() + input.bodies.size() + 3;
  if (undrained_ >= kDrainAt) drain();
}

void LabRecording::drain() {
  master_.drain(writer_);
  slave_.drain(writer_);
  undrained_ = 0;
}

void LabRecording::finish() {
  drain();
  writer_.finish();
  finished_ = true;
  if (file_.failed()) throw RecordingError("cannot write " + file_.path().string() + ": " + file_.error());
  if (master_.ticks_dropped() + slave_.ticks_dropped() > 0)
    throw RecordingError(file_.path().string() + " is incomplete: some ticks could not be recorded");
}

}  // namespace longreach
