// What `accuracy` chooses for the stages of a side. BALANCED is what the schema has as defaults; the two
// others are points of the fronts that `longreach-lab run trade` measures.

#include "common/config/accuracy.hpp"

#include <array>
#include <span>

#include "common/config/config.hpp"
#include "common/config/field_path.hpp"

namespace longreach {
namespace {

using google::protobuf::Message;

struct Choice {
  std::string_view path, fast, exact;
};

// A wall's stiffness is limited by the sample time, the cost is proportional to the rate.
constexpr Choice kRate{"loop.rate_hz", "500", "2000"};

constexpr std::array kMaster{
    kRate,
    Choice{"link.send_hz", "100", "1000"},
};

constexpr std::array kSlave{
    kRate,
    Choice{"link.telemetry_hz", "15", "60"},
    Choice{"command.tolerance_m", "1e-6", "1e-13"},
    Choice{"command.iterations_max", "5", "100"},
    Choice{"estimator.first_sd", "0.05", "0.02"},
    Choice{"estimator.deadband", "0.1", "0.005"},
};

bool is_set(const Message& root, std::string_view path) {
  const Message* message = &root;
  for (const PathStep& step : find_path(root, path).path) {
    if (!message->GetReflection()->HasField(*message, step.field)) return false;
    if (holds_messages(*step.field)) message = &message_at(*message, step);
  }
  return true;
}

void choose(Message& config, proto::Accuracy accuracy, std::span<const Choice> choices) {
  if (accuracy == proto::BALANCED) return;
  for (const Choice& c : choices) {
    if (!is_set(config, c.path)) set_field(config, c.path, accuracy == proto::FAST ? c.fast : c.exact);
  }
}

}  // namespace

void apply_accuracy(proto::MasterConfig& config) { choose(config, config.accuracy(), kMaster); }

void apply_accuracy(proto::SlaveConfig& config) { choose(config, config.accuracy(), kSlave); }

}  // namespace longreach
