#pragma once
// A person at the keyboard of the real programs does a task, and `longreach task` judges it. The row of figures is compared
// with the recording of the master.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/recording/mcap_reader.hpp"
#include "common/spatial/spatial.hpp"
#include "proto/recording.pb.h"
#include "tests/process/client_run.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach {

/// The newest row of a file of figures.
class StudyRow {
 public:
  explicit StudyRow(const std::string& file) {
    std::ifstream in(file);
    std::string line;
    if (std::getline(in, line)) names_ = cells(line);
    while (std::getline(in, line)) values_ = cells(line);
    EXPECT_EQ(names_.size(), values_.size()) << line;
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    const auto at = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
    EXPECT_LT(at, values_.size()) << name;
    return at < values_.size() ? values_[at] : "nan";
  }
  [[nodiscard]] double number(const std::string& name) const { return std::stod(text(name)); }

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) result.push_back(cell);
    return result;
  }
  std::vector<std::string> names_{}, values_{};
};

/// What the master received, from its recording.
struct RecordedTask {
  struct Telemetry {
    double t_s;  // of its arrival
    Vector3 tool_m;
    double force_n;
    bool load;
  };
  struct Body {
    double t_s;
    Pose X_WB;
  };
  std::vector<Telemetry> telemetry{};
  std::vector<Body> body{};  // the first one

  explicit RecordedTask(const std::string& file) {
    const auto vector = [](const recording::Vector& v) { return Vector3(v.x(), v.y(), v.z()); };
    McapReader reader(file);
    while (const auto message = reader.next()) {
      const double t_s = 1e-9 * static_cast<double>(message->log_time_ns);
      const auto size = static_cast<int>(message->bytes.size());
      if (message->channel->topic == "/master/received_telemetry") {
        recording::ReceivedTelemetry received;
        EXPECT_TRUE(received.ParseFromArray(message->bytes.data(), size));
        const recording::Telemetry& t = received.telemetry();
        telemetry.push_back(
            {t_s, vector(t.tool().position_m()), vector(t.wrench().force_n()).norm(), t.load()});
      } else if (message->channel->topic == "/master/received_bodies") {
        recording::ReceivedBodies received;
        EXPECT_TRUE(received.ParseFromArray(message->bytes.data(), size));
        const recording::Pose& pose = received.bodies().body1().pose();
        const recording::Quaternion& q = pose.orientation();
        body.push_back({t_s, {vector(pose.position_m()), Quaternion(q.w(), q.x(), q.y(), q.z())}});
      }
    }
    EXPECT_TRUE(reader.whole());
  }
  /// The newest pose of the body at a time.
  [[nodiscard]] Pose body_at(double t_s) const {
    Pose newest;
    for (const Body& b : body)
      if (b.t_s <= t_s) newest = b.X_WB;
    return newest;
  }
  /// The maximum force at the tool from one time to another.
  [[nodiscard]] double force_max_n(double from_s, double to_s) const {
    double most_n = 0.0;
    for (const Telemetry& t : telemetry)
      if (t.t_s >= from_s && t.t_s <= to_s) most_n = std::max(most_n, t.force_n);
    return most_n;
  }
};

class TaskStation : public Station {
 protected:
  void start(const std::string& scene, const std::string& mode, const std::string& profile = "lab") {
    start_slave({"--profile", profile, "--set", "scene_file=scenes/" + scene + ".txtpb"});
    start_master(
        {"--profile", profile, "--operator", "keyboard", "--mode", mode, "--engage", "--record", recorded_},
        {terminal_.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
    const auto now = slave_.status();
    for (int i = 0; i < 3; ++i) start_m_[i] = now->tool_m(i);
  }
  std::vector<std::string> client(const std::vector<std::string>& words) {
    std::vector<std::string> all{"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc), "--slave",
                                 "127.0.0.1:" + std::to_string(ports_.slave_rpc)};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  /// Of the tool from its start, along one axis.
  double at_m(int axis) {
    const auto now = slave_.status();
    return now && now->tool_m_size() == 3 ? now->tool_m(axis) - start_m_[axis] : NAN;
  }
  double hand_m(int axis) {
    const auto now = master_.status();
    return now && now->hand_m_size() == 3 ? now->hand_m(axis) : NAN;
  }
  bool mode_is(const std::string& mode) {
    return eventually([&] {
      const auto now = master_.status();
      return now && now->mode() == mode;
    });
  }
  /// Ends the master and reads its recording.
  RecordedTask recording() {
    master_program_->signal(SIGTERM);
    EXPECT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << master_program_->output();
    return RecordedTask(recorded_);
  }

  const TemporaryFolder folder_;
  const std::string study_ = (folder_.path() / "study.csv").string();
  const std::string recorded_ = (folder_.path() / "master.mcap").string();
  const Terminal terminal_;
  Vector3 start_m_ = Vector3::Zero();
};

}  // namespace longreach
