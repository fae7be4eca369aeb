// Any text as configuration of the master, of the slave or of a link, and as a `--set`: refused with a
// readable error and without effect, or accepted; what was accepted can be written and read again.

#include <google/protobuf/util/message_differencer.h>

#include "tests/fuzz/fuzz.hpp"

namespace longreach::fuzz {
namespace {

using google::protobuf::util::MessageDifferencer;

template <class Message>
void read(const std::string& text) {
  Message message;
  if (!load(text, message)) {
    require(MessageDifferencer::Equals(message, Message()), "a refused text changes nothing");
    return;
  }
  Message again;
  load_text("again", "# all\n" + get_field(message, ""), again);
  require(get_field(again, "") == get_field(message, ""), "what was written is read as it was");
  try {
    validate(message);
  } catch (const ConfigError& error) {
    require_readable(error, "");
  }
}

template <class Message>
void set(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return;
  Message message;
  try {
    set_field(message, text.substr(0, equals), text.substr(equals + 1));
  } catch (const ConfigError& error) {
    require_readable(error, "");
    require(MessageDifferencer::Equals(message, Message()), "a refused setting changes nothing");
  }
}

}  // namespace
}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  std::string text(reinterpret_cast<const char*>(bytes), size);
  const bool setting = text.starts_with("--set ");
  if (setting) text.erase(0, 6);
  // One message an input: three times as many inputs.
  switch (size % 3) {
    case 0:
      setting ? fuzz::set<proto::MasterConfig>(text) : fuzz::read<proto::MasterConfig>(text);
      break;
    case 1:
      setting ? fuzz::set<proto::SlaveConfig>(text) : fuzz::read<proto::SlaveConfig>(text);
      break;
    default:
      setting ? fuzz::set<proto::LinkProfile>(text) : fuzz::read<proto::LinkProfile>(text);
  }
  return 0;
}
