#include "common/config/config.hpp"
#include "common/messages/conversion.hpp"

namespace longreach {
namespace {

template <class M, class S>
M message_of(const S& config) {
  M message;
  to_message(config, message);
  return message;
}

}  // namespace

MasterConfig to_struct(const proto::MasterConfig& message) { return from_message<MasterConfig>(message); }
SlaveConfig to_struct(const proto::SlaveConfig& message) { return from_message<SlaveConfig>(message); }
ImpairmentConfig to_struct(const proto::Impairment& message) {
  return from_message<ImpairmentConfig>(message);
}
proto::MasterConfig to_message(const MasterConfig& config) { return message_of<proto::MasterConfig>(config); }
proto::SlaveConfig to_message(const SlaveConfig& config) { return message_of<proto::SlaveConfig>(config); }
proto::Impairment to_message(const ImpairmentConfig& config) { return message_of<proto::Impairment>(config); }

}  // namespace longreach
