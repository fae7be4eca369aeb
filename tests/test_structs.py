#!/usr/bin/env python3
"""Tests of proto/structs.cpp: what it writes for each kind of field, and what it refuses.

usage: test_structs.py STRUCTS
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
STRUCTS = ''

ALL_KINDS = '''
// A drive.
message Drive {
  // Inertia, kg m^2.
  optional double inertia_kg_m2 = 1 [default = 3e-4];
  optional double torque_nm = 2 [default = 2];
}

message Small {
  option (struct_name) = "DriveConfig";
  optional double inertia_kg_m2 = 1 [default = 3e-4];
  optional double torque_nm = 2 [default = 0.5];
}

message Whole {
  enum Kind {
    option (enum_name) = "WholeKind";
    FIRST_ONE = 0;  // the first
    SECOND = 4;
  }
  optional Kind kind = 1 [default = SECOND];
  optional bool on = 2 [default = true];
  optional uint32 number = 3 [default = 7];
  optional string text = 4 [default = "a\\"b"];
  optional string empty = 5;
  repeated double axis = 6 [(count) = 3, (initial) = 0, (initial) = 0, (initial) = 1];
  repeated double place = 7 [(count) = 3];
  repeated double list = 8;
  repeated Drive three = 9 [(count) = 3];
  repeated Drive many = 10;
  optional Drive drive = 11;
  optional Small small = 12;
  optional Drive maybe = 13 [(none_if_absent) = true];
  optional bool old = 14 [(unused) = true];
  optional double operator = 15;
}
'''

EXPECTED = '''/// A drive.
struct DriveConfig {
  /// Inertia, kg m^2.
  double inertia_kg_m2 = 3e-04;
  double torque_nm = 2.0;

  bool operator==(const DriveConfig&) const = default;
};

template <class Visitor, Is<DriveConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("inertia_kg_m2", s.inertia_kg_m2);
  visit("torque_nm", s.torque_nm);
}

enum class WholeKind : std::uint8_t {
  kFirstOne = 0,  // the first
  kSecond = 4,
};
template <>
inline constexpr int kCountOf<WholeKind> = 5;

struct WholeConfig {
  WholeKind kind = WholeKind::kSecond;
  bool on = true;
  std::uint32_t number = 7;
  std::string text = "a\\"b";
  std::string empty{};
  Vector3 axis{0.0, 0.0, 1.0};
  Vector3 place = Vector3::Zero();
  std::vector<double> list{};
  std::array<DriveConfig, 3> three{};
  std::vector<DriveConfig> many{};
  DriveConfig drive{};
  DriveConfig small{.torque_nm = 0.5};
  std::optional<DriveConfig> maybe{};
  double operator_ = 0.0;
'''

STATES = '''
option (state) = true;
option (include) = "common/link/hold_cause.hpp";

enum Side {
  option (enum_name) = "SideOfLink";
  NEAR_SIDE = 0;
  FAR_SIDE = 1;
}
enum Other {
  option (enum_by_hand) = true;
  NOTHING = 0;
}
message Vector {
  option (by_hand) = true;
  option (struct_name) = "Vector3";
  double x = 1;
}
message Moment {
  sfixed64 now_ns = 1;
  optional sfixed64 seen_ns = 2;  // the last datagram
  Side side = 3 [(initial) = 1];
  Other other = 4;
  double scale = 5 [(initial) = 0.5];
  bool held = 6 [(initial) = 1];
  optional bool grip = 7;
  Vector hand_m = 8 [(member) = "p_MH"];
  bool button_mode = 9 [(member) = "Buttons buttons.mode"];
  bool button_clutch = 10 [(member) = "Buttons buttons.clutch"];
  Vector push_n = 11 [(none_if_absent) = true];
  Side cause = 12 [(type) = "Reason"];
  uint64 ticks = 13;
  sint32 steps = 14;
  uint32 age = 15 [(shown) = true];
}
'''

EXPECTED_STATES = '''#include "common/link/hold_cause.hpp"

namespace longreach {

enum class SideOfLink : std::uint8_t {
  kNearSide = 0,
  kFarSide = 1,
};
template <>
inline constexpr int kCountOf<SideOfLink> = 2;

struct Buttons {
  bool mode = false;
  bool clutch = false;
};

template <class Visitor, Is<Buttons> S>
void visit_fields(Visitor& visit, S& s) {
  visit("mode", s.mode);
  visit("clutch", s.clutch);
}

struct Moment {
  Time now{};
  std::optional<Time> seen{};  // the last datagram
  SideOfLink side = SideOfLink::kFarSide;
  Other other = Other::kNothing;
  double scale = 0.5;
  bool held = true;
  std::optional<bool> grip{};
  Vector3 p_MH = Vector3::Zero();
  Buttons buttons{};
  std::optional<Vector3> push_n{};
  Reason cause{};
  std::uint64_t ticks = 0;
  int steps = 0;
  std::uint32_t age = 0;
};

template <class Visitor, Is<Moment> S>
void visit_fields(Visitor& visit, S& s) {
  visit("now_ns", s.now);
  visit("seen_ns", s.seen);
  visit("side", s.side);
  visit("other", s.other);
  visit("scale", s.scale);
  visit("held", s.held);
  visit("grip", s.grip);
  visit("hand_m", s.p_MH);
  visit("button_mode", s.buttons.mode);
  visit("button_clutch", s.buttons.clutch);
  visit("push_n", s.push_n);
  visit("cause", s.cause);
  visit("ticks", s.ticks);
  visit("steps", s.steps);
}

template <class Visitor, Is<Moment> S>
void visit_shown(Visitor& visit, S& s) {
  visit("age", s.age);
}

}  // namespace longreach
'''


class Structs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.header = self.folder / 'a.hpp'

    def run_on(self, text, syntax='proto2'):
        (self.folder / 'proto').mkdir(exist_ok=True)
        (self.folder / 'proto/a.proto').write_text(
            f'syntax = "{syntax}";\npackage longreach.proto;\nimport "proto/options.proto";\n' + text)
        descriptors = self.folder / 'a.bin'
        subprocess.run(['protoc', '-I', self.folder, '-I', ROOT, '--include_imports', '--include_source_info',
                        f'--descriptor_set_out={descriptors}', self.folder / 'proto/a.proto'], check=True)
        return subprocess.run([STRUCTS, descriptors, 'proto/a.proto', self.header], capture_output=True, text=True,
                              check=False)

    def refused(self, text, reason):
        result = self.run_on(text)
        self.assertEqual((result.returncode, result.stderr), (1, f'structs: longreach.proto.{reason}\n'))
        self.assertFalse(self.header.exists())

    def test_each_kind_of_field_becomes_a_member(self):
        self.assertEqual(self.run_on(ALL_KINDS).returncode, 0)
        header = self.header.read_text()
        self.assertIn(EXPECTED, header)
        self.assertIn('  visit("operator", s.operator_);\n', header)
        self.assertNotIn('old', header)
        self.assertNotIn('protobuf', header)

    def test_each_kind_of_field_of_a_state_becomes_a_member(self):
        self.assertEqual(self.run_on(STATES, 'proto3').returncode, 0)
        self.assertTrue(self.header.read_text().endswith(EXPECTED_STATES), self.header.read_text())

    def test_a_header_that_stays_the_same_is_not_written(self):
        self.run_on(ALL_KINDS)
        before = self.header.stat().st_mtime_ns
        self.run_on(ALL_KINDS)
        self.assertEqual(self.header.stat().st_mtime_ns, before)

    def test_what_has_no_member_is_refused_by_name(self):
        self.refused('message A { optional int64 x = 1; }', 'A.x: a field of this type has no member')
        self.refused('message A { optional double x = 1 [(member) = "A b"]; }',
                     'A.x: (member) must be MEMBER or TYPE MEMBER.MEMBER')
        self.refused('message A { repeated double x = 1 [(count) = 3, (initial) = 1]; }',
                     'A.x: (initial) must give three numbers')

    def test_messages_that_share_a_struct_have_the_same_fields(self):
        one = 'message A { optional double x = 1; }\n'
        shared = 'message B { option (struct_name) = "AConfig"; optional %s = 1; %s }\nmessage C { optional B b = 1; }'
        self.refused(one + shared % ('double y', ''), 'B.y: differs from longreach.proto.A.x, which shares its struct')
        self.refused(one + shared % ('bool x', ''), 'B.x: differs from longreach.proto.A.x, which shares its struct')
        self.refused(one + shared % ('double x', 'optional bool y = 2;'), 'B: has other fields than longreach.proto.A')

    def test_descriptors_that_cannot_be_read_are_named(self):
        result = subprocess.run([STRUCTS, self.folder / 'none', 'proto/a.proto', self.header], capture_output=True,
                                text=True, check=False)
        self.assertEqual((result.returncode, result.stderr),
                         (1, f'structs: {self.folder}/none: is not a set of descriptors\n'))
        self.assertEqual(subprocess.run([STRUCTS], capture_output=True, check=False).returncode, 2)


if __name__ == '__main__':
    STRUCTS = sys.argv.pop(1)
    unittest.main()
