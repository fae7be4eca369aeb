#include "tests/faults/looseness.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "proto/options.pb.h"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

void collect(const google::protobuf::Descriptor& message, const std::string& before,
             std::vector<GuardedField>& limits) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& f = *message.field(i);
    const std::string path = before + f.name();
    const auto remote = f.options().GetExtension(proto::remote);
    if (f.message_type() != nullptr) {
      collect(*f.message_type(), path + ".", limits);
    } else if (remote != proto::FREELY) {
      limits.push_back({path,
                        remote == proto::TIGHTER_DOWN ? Loose::kAbove
                        : remote == proto::TIGHTER_UP ? Loose::kBelow
                                                      : Loose::kOther,
                        f.options().GetExtension(proto::automatic)});
    }
  }
}

template <class Config>
std::vector<GuardedField> limits_of(std::initializer_list<const char*> parts) {
  std::vector<GuardedField> limits;
  for (const char* part : parts)
    collect(*Config::descriptor()->FindFieldByName(part)->message_type(), std::string(part) + ".", limits);
  return limits;
}

double number(const Message& m, const FieldDescriptor& f) {
  const auto& reflection = *m.GetReflection();
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(m, &f);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(m, &f);
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(m, &f) ? 1.0 : 0.0;
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnumValue(m, &f);
    default:
      throw std::logic_error("no number: " + f.full_name());
  }
}

/// The number or numbers at a path; throws std::logic_error where there are none.
std::vector<double> values(const Message& m, std::string_view path) {
  const std::size_t dot = path.find('.');
  const FieldDescriptor* field = m.GetDescriptor()->FindFieldByName(std::string(path.substr(0, dot)));
  if (field == nullptr) throw std::logic_error("no field " + std::string(path));
  if (dot != std::string_view::npos)
    return values(m.GetReflection()->GetMessage(m, field), path.substr(dot + 1));
  if (!field->is_repeated()) return {number(m, *field)};
  std::vector<double> all;
  for (int i = 0; i < m.GetReflection()->FieldSize(m, field); ++i)
    all.push_back(m.GetReflection()->GetRepeatedDouble(m, field, i));
  return all;
}

bool is_looser(const GuardedField& limit, const Message& start, const Message& now) {
  const std::vector<double> before = values(start, limit.path), after = values(now, limit.path);
  const auto stands_for = [&](double value) { return value == 0.0 ? limit.automatic : value; };
  switch (limit.looser) {
    case Loose::kAbove:
      return !(stands_for(after.front()) <= stands_for(before.front()));
    case Loose::kBelow:
      return !(after.front() >= before.front());
    case Loose::kOther:
      break;
  }
  return before != after;
}

std::string first_looser(std::span<const GuardedField> limits, const Message& start, const Message& now) {
  for (const GuardedField& limit : limits)
    if (is_looser(limit, start, now)) return limit.path + " is less restrictive than at the start";
  return {};
}

}  // namespace

std::span<const GuardedField> slave_limits() {
  static const auto kLimits = limits_of<proto::SlaveConfig>({"command", "sensing", "safety", "playout"});
  return kLimits;
}
std::span<const GuardedField> master_limits() {
  static const auto kLimits = limits_of<proto::MasterConfig>({"rendering", "safety"});
  return kLimits;
}

std::string looser(const proto::SlaveConfig& start, const proto::SlaveConfig& now) {
  return first_looser(slave_limits(), start, now);
}
std::string looser(const proto::MasterConfig& start, const proto::MasterConfig& now) {
  return first_looser(master_limits(), start, now);
}

}  // namespace longreach
