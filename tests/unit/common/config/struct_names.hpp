#pragma once
// Compares the fields of structs and messages by name in the source, because the tests by reflection would
// not detect two interchanged members. Shared by the tests of master and slave.

#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "tests/unit/common/config/walk.hpp"

namespace longreach {

inline void expect_same(const Vector3& v, const google::protobuf::RepeatedField<double>& numbers) {
  ASSERT_EQ(numbers.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(v[i], numbers.Get(i));
}

inline void expect_same(const ImpairmentConfig& s, const proto::Impairment& m) {
  EXPECT_EQ(s.delay_s, m.delay_s());
  EXPECT_EQ(s.jitter_s, m.jitter_s());
  EXPECT_EQ(s.loss, m.loss());
  EXPECT_EQ(s.loss_burst, m.loss_burst());
  EXPECT_EQ(s.duplicate, m.duplicate());
  EXPECT_EQ(s.reorder, m.reorder());
  EXPECT_EQ(s.corrupt, m.corrupt());
  EXPECT_EQ(s.rate_bit_per_s, m.rate_bit_per_s());
  EXPECT_EQ(s.queue_s, m.queue_s());
  EXPECT_EQ(s.step_delay_s, m.step_delay_s());
  EXPECT_EQ(s.step_start_s, m.step_start_s());
  EXPECT_EQ(s.step_duration_s, m.step_duration_s());
  EXPECT_EQ(s.drift_s_per_s, m.drift_s_per_s());
  EXPECT_EQ(s.blackout_start_s, m.blackout_start_s());
  EXPECT_EQ(s.blackout_duration_s, m.blackout_duration_s());
  EXPECT_EQ(s.blackout_period_s, m.blackout_period_s());
  EXPECT_EQ(s.rpc_delay_s, m.rpc_delay_s());
}

inline void expect_same(const RpcServerConfig& s, const proto::RpcServer& m) {
  EXPECT_EQ(s.listen, m.listen());
}

inline void expect_same(const LoopConfig& s, const proto::Loop& m) {
  EXPECT_EQ(s.rate_hz, m.rate_hz());
  EXPECT_EQ(s.priority, m.priority());
  EXPECT_EQ(s.lock_memory, m.lock_memory());
}

inline void expect_same(const AdapterConfig& s, const proto::Adapter& m) {
  EXPECT_EQ(s.address, m.address());
  EXPECT_EQ(s.silence_s, m.silence_s());
}

template <class Drive>
void expect_same(const DriveConfig& s, const Drive& m) {
  EXPECT_EQ(s.inertia_kg_m2, m.inertia_kg_m2());
  EXPECT_EQ(s.viscous_nm_s_per_rad, m.viscous_nm_s_per_rad());
  EXPECT_EQ(s.coulomb_nm, m.coulomb_nm());
  EXPECT_EQ(s.resolution_rad, m.resolution_rad());
  EXPECT_EQ(s.torque_max_nm, m.torque_max_nm());
  EXPECT_EQ(s.bandwidth_hz, m.bandwidth_hz());
}

}  // namespace longreach
