// The campaign's lists against the schema: every limit is asked for, and judged.

#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "proto/config.pb.h"
#include "proto/options.pb.h"
#include "tests/faults/looseness.hpp"

namespace longreach::faults_lists_test {
namespace {

/// Fields below a message that a client cannot change freely, by path, with what the schema says of each.
void collect(const google::protobuf::Descriptor& message, const std::string& before,
             std::map<std::string, proto::Remote>& all) {
  for (int i = 0; i < message.field_count(); ++i) {
    const google::protobuf::FieldDescriptor& f = *message.field(i);
    const std::string path = before + f.name();
    if (f.message_type() != nullptr) {
      collect(*f.message_type(), path + ".", all);
      continue;
    }
    const proto::Remote remote = f.options().GetExtension(proto::remote);
    if (remote != proto::FREELY) all[path] = remote;
  }
}

template <class Config>
void expect_complete(std::span<const GuardedField> limits, const std::set<std::string>& parts) {
  std::map<std::string, proto::Remote> due;
  for (const std::string& part : parts)
    collect(*Config::descriptor()->FindFieldByName(part)->message_type(), part + ".", due);
  EXPECT_GT(due.size(), 30u);
  std::set<std::string> listed;
  for (const GuardedField& limit : limits) {
    const std::string path = limit.path;
    EXPECT_TRUE(listed.insert(path).second) << path << " twice";
    if (!parts.contains(path.substr(0, path.find('.')))) continue;
    ASSERT_TRUE(due.contains(path)) << path << " is no limit of the schema";
    const Loose by_schema = due.at(path) == proto::TIGHTER_DOWN ? Loose::kAbove
                            : due.at(path) == proto::TIGHTER_UP ? Loose::kBelow
                                                                : Loose::kOther;
    EXPECT_EQ(limit.looser, by_schema) << path;
  }
  for (const auto& [path, remote] : due) EXPECT_TRUE(listed.contains(path)) << path << " is missing";
  // Each exists, and none is less restrictive than itself.
  EXPECT_EQ(looser(Config(), Config()), "");
}

TEST(FaultLists, EveryLimitOfTheSchemaIsAskedForAndJudged) {
  expect_complete<proto::SlaveConfig>(slave_limits(), {"command", "sensing", "safety", "playout"});
  expect_complete<proto::MasterConfig>(master_limits(), {"rendering", "safety"});
}

TEST(FaultLists, WhatIsLooserIsNamed) {
  proto::SlaveConfig start, now;
  now.mutable_safety()->set_delay_rise_max_s(2.0);
  EXPECT_EQ(looser(start, now), "safety.delay_rise_max_s is less restrictive than at the start");
  now = {};
  now.mutable_safety()->set_gap_s(0.05);
  EXPECT_EQ(looser(start, now), "");  // 0, at the start, finds at least 0.1 s
  now.mutable_safety()->set_gap_s(0.2);
  EXPECT_NE(looser(start, now), "");
  now = {};
  now.mutable_sensing()->mutable_tool()->add_com_m(0.1);
  EXPECT_EQ(looser(start, now), "sensing.tool.com_m is less restrictive than at the start");
}

}  // namespace
}  // namespace longreach::faults_lists_test
