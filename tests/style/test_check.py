#!/usr/bin/env python3
"""Tests of the style check. Each test adds one violation to a correct tree and checks that it is reported."""

import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check  # noqa: E402
import layers  # noqa: E402
import source  # noqa: E402

HEADER = '#pragma once\n\nnamespace longreach {\nstruct %s {};\n}  // namespace longreach\n'
SOUND = {
    'common/core/a.hpp': HEADER % 'A',
    'common/link/b.hpp': HEADER % 'B',
    'common/config/c.hpp': HEADER % 'C',
    'master/devices/d.hpp': HEADER % 'D',
    'master/rendering/e.hpp': HEADER % 'E',
    'master/config/e_config.hpp': HEADER % 'EConfig',
    'master/master_node.hpp': HEADER % 'MasterNode',
    'slave/kinematics/r.hpp': HEADER % 'R',
    'slave/config/slave_config.hpp': HEADER % 'SlaveConfig',
    'proto/config.proto': 'syntax = "proto2";\n',
    'deploy/config/master.txtpb': 'rpc { listen: "127.0.0.1:1" }\n',
    'tests/style/README.md': 'text\n',
    '.ci/run': '#!/bin/sh\n',
    'README.md': 'text\n',
}


def include(path):
    return f'#include "{path}"\n'


class Planted(unittest.TestCase):
    def findings(self, files, form=()):
        with tempfile.TemporaryDirectory() as root:
            for path, text in {**SOUND, **files}.items():
                os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
                with open(os.path.join(root, path), 'w', encoding='utf-8', newline='') as file:
                    file.write(text)
            return check.check(root, form)

    def found(self, path, text, *words):
        errors = self.findings({path: text}).errors
        for error in errors:
            if error.startswith(path) and all(word in error for word in words):
                return
        self.fail(f'not found in {path}: {words}; found: {errors}')

    def sound(self, path, text):
        self.assertEqual(self.findings({path: text}).errors, [])

    def test_an_adapter_that_vendors_copy_includes_the_layout_alone(self):
        self.found('deploy/adapters/a.cpp', include('common/core/a.hpp'), 'vendors')

    def test_a_banned_word_that_occurs_more_often_than_its_row_allows(self):
        rows = '# word | allowed | instead\nwhoever | 1 | a client\nnever used | 0 | -\n'
        two = {'tests/style/words.txt': rows, 'README.md': 'whoever\nand whoever\n'}
        self.assertTrue(any('"whoever" occurs 2 times' in error for error in self.findings(two).errors))
        one = {'tests/style/words.txt': rows, 'README.md': 'whoever, whoevers\n'}
        self.assertEqual(self.findings(one).errors, [])

    def test_a_banned_phrase_across_lines_of_a_comment(self):
        files = {'tests/style/words.txt': 'goes on | 0 | resumes\n',
                 'common/core/a.hpp': '#pragma once\n// It goes\n// on.\n' + HEADER[13:] % 'A'}
        self.assertTrue(any('"goes on" occurs 1 times' in error for error in self.findings(files).errors))

    def test_a_row_that_allows_more_than_there_is(self):
        files = {'tests/style/words.txt': 'whoever | 2 | a client\n', 'README.md': 'whoever\n'}
        self.assertTrue(any('lower the number' in warning for warning in self.findings(files).warnings))

    def test_a_name_of_a_test_over_60_characters(self):
        self.found('tests/unit/a_test.cpp', f'TEST(A, {"B" * 61}) {{}}\n', '61 characters')
        self.sound('tests/unit/a_test.cpp', f'TEST(A, {"B" * 60}) {{}}\n')

    def test_a_sound_tree_has_no_findings(self):
        result = self.findings({})
        self.assertEqual(result.errors + result.warnings, [])

    def test_higher_layers(self):
        self.found('common/core/x.cpp', include('common/link/b.hpp'), 'layer 0', 'layer 3')
        self.found('common/link/x.cpp', include('master/devices/d.hpp'), 'only that side')
        self.found('master/rendering/x.cpp', include('master/master_node.hpp'), 'includes master/master_node.hpp')
        self.found('common/link/x.cpp', include('common/config/c.hpp'), 'includes common/config/c.hpp')
        self.found('master/x.cpp', include('proto/config.pb.h'), 'stages and nodes')

    def test_stages_see_only_what_comes_before_them(self):
        self.found('master/devices/x.cpp', include('master/rendering/e.hpp'), 'includes master/rendering/e.hpp')
        self.sound('master/rendering/x.cpp', include('master/devices/d.hpp'))
        self.sound('master/devices/x.cpp', include('master/config/e_config.hpp'))
        self.sound('slave/kinematics/x.cpp', include('slave/config/slave_config.hpp'))
        self.found('common/core/x.cpp', include('slave/config/slave_config.hpp'), 'only that side')

    def test_the_sides_do_not_see_each_other(self):
        self.found('master/rendering/x.cpp', include('slave/kinematics/r.hpp'), 'only that side')
        self.found('slave/kinematics/x.cpp', include('master/devices/d.hpp'), 'only that side')
        self.found('common/config/x.cpp', include('slave/kinematics/r.hpp'), 'only that side')
        self.found('common/wire/x.cpp', include('slave/config/slave_config.hpp'), 'only that side')
        self.sound('common/config/x.cpp', include('slave/config/slave_config.hpp'))
        self.sound('deploy/cli/x.cpp', include('slave/kinematics/r.hpp'))
        self.sound('deploy/cli/x.cpp', include('master/devices/d.hpp'))
        self.found('deploy/cli/x.cpp', include('master/rendering/e.hpp'), 'only that side')
        self.sound('tests/loop/x.cpp', include('slave/kinematics/r.hpp') + include('master/master_node.hpp'))
        self.sound('deploy/lab/x.cpp', include('slave/kinematics/r.hpp') + include('master/master_node.hpp'))

    def test_no_product_includes_tests(self):
        files = {'tests/loop/t.hpp': HEADER % 'T', 'deploy/lab/x.cpp': include('tests/loop/t.hpp')}
        self.assertTrue(any('deploy/lab/x.cpp' in error for error in self.findings(files).errors))

    def test_a_node_does_not_see_its_program(self):
        files = {'slave/program/s.hpp': HEADER % 'S', 'slave/slave_node.cpp': include('slave/program/s.hpp')}
        self.assertTrue(any('slave_node.cpp' in error for error in self.findings(files).errors))
        files = {'slave/slave_node.hpp': HEADER % 'SlaveNode', 'slave/program/s.cpp': include('slave/slave_node.hpp')}
        self.assertEqual(self.findings(files).errors, [])

    def test_every_folder_has_a_layer(self):
        self.found('common/extra/x.cpp', include('common/core/a.hpp'), 'no layer')

    def test_a_type_is_defined_once(self):
        self.found('common/link/x.hpp', HEADER % 'A', 'A is defined in common/core/a.hpp as well')
        self.found('tests/unit/x.hpp', HEADER % 'A', 'A is defined in common/core/a.hpp as well')
        for text in ('namespace longreach {\nnamespace {\nstruct A {};\n}\n}\n',
                     'namespace longreach {\nstruct O {\n  struct A {};\n};\n}\n',
                     'namespace longreach::test {\nstruct A {};\n}\n', 'namespace longreach {\nstruct A;\n}\n'):
            self.sound('common/link/x.cpp', text)

    def test_documents_name_files_that_exist(self):
        for place in ('common/core/a.hpp', 'common/core/a', 'common/core', 'proto/config.proto', 'build/x', 'a/b'):
            self.sound('ARCHITECTURE.md', f'see `{place}`\n')
        for place in ('common/core/b', 'common/link/a.hpp', 'slave/gone'):
            self.found('ARCHITECTURE.md', f'see\n`{place}`\n', 'does not exist')

    def test_folders_stay_small(self):
        many = {f'master/devices/m{i}.cpp': '' for i in range(40)}
        self.assertEqual(self.findings(many).errors, ['master/devices:1: 41 files, over 40'])
        self.assertTrue(self.findings({f'slave/m{i}.cpp': '' for i in range(11)}).errors)
        self.assertEqual(self.findings({f'tests/loop/m{i}.cpp': '' for i in range(50)}).errors, [])

    def test_include_paths(self):
        self.found('common/link/x.cpp', include('b.hpp'), 'not a file seen from the root')
        self.found('common/link/x.cpp', include('../core/a.hpp'), 'not a path from the root')

    def test_stages_are_pure(self):
        for line in ('auto t = std::chrono::steady_clock::now();', 'auto t = Clock::now();', 'std::mutex m;',
                     'int i = rand();', 'std::mt19937 g;', 'void f() { printf("x"); }', 'void f() { std::cout << 1; }'):
            self.found('master/rendering/x.cpp', line + '\n', 'stages and nodes')
        for header in ('thread', 'mutex', 'atomic', 'iostream', 'random', 'spdlog/spdlog.h', 'google/protobuf/message.h'):
            self.found('slave/kinematics/x.cpp', f'#include <{header}>\n', 'may not include')
        self.sound('common/rpc/x.cpp', '#include <mutex>\n#include <thread>\nauto t = Clock::now();\n')
        self.sound('slave/kinematics/x.cpp', '// Clock::now() and rand()\nconst char* s = "printf(";\nint operand(int);\n')

    def test_names_that_say_nothing(self):
        for name in ('link_manager', 'util', 'string_utils', 'process', 'wire_data'):
            self.found(f'common/link/{name}.hpp', HEADER % 'X', 'says nothing')
        for name in ('LinkManager', 'DataBlock', 'ErrorInfo', 'Helpers', 'EventHandler'):
            self.found('common/link/x.hpp', HEADER % name, 'says nothing')
        self.found('common/link/x.hpp', '#pragma once\nusing FrameData = int;\n', 'says nothing')
        self.found('proto/x.proto', 'message LinkInfo {}\n', 'says nothing')
        self.assertEqual(len(self.findings({'common/link/infos/x.hpp': HEADER % 'X'}).errors), 1)
        self.sound('tests/process/x.cpp', '')
        self.sound('common/link/handle.hpp', HEADER % 'Handle')

    def test_text(self):
        self.found('common/link/x.cpp', 'using namespace std;\n', 'using namespace std')
        self.sound('common/rpc/x.cpp', 'using namespace std::chrono_literals;\n')
        self.found('common/link/x.cpp', 'int a;\t\n', 'tab')
        self.found('README.md', 'text \n', 'trailing blank')
        self.found('README.md', 'text', 'no newline')
        self.found('README.md', 'TO' + 'DO: write\n', 'unfinished')
        self.found('deploy/x', '# FIX' + 'ME\n', 'unfinished')
        self.found('tests/unit/x.cpp', 'TEST(A, DIS' + 'ABLED_B) {}\n', 'switched off')
        self.found('tests/unit/x.cpp', 'TEST(A, B) { GTEST_' + 'SKIP(); }\n', 'switched off')
        self.found('deploy/x', 'cd /ho' + 'me/somebody/longreach\n', 'path of one machine')
        self.found('common/link/x.hpp', 'struct X {};\n', 'pragma once')

    def test_the_top_level_is_fixed(self):
        self.assertEqual(self.findings({'docs/x.md': 'text\n'}).errors, ['docs:1: does not belong at the top level'])
        self.found('NOTES.md', 'text\n', 'top level')
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(len([error for error in check.check(root).errors if 'missing' in error]), 7)

    def test_sizes(self):
        self.found('common/link/x.cpp', 'int a;\n' * 401, '401 lines')
        self.assertEqual(len(self.findings({'common/link/x.cpp': 'int a;\n' * 301}).warnings), 1)
        body = '  a();\n' * 59
        self.sound('common/link/x.cpp', 'void f() {\n' + body[7:] + '}\n')
        self.found('common/link/x.cpp', 'void f() {\n' + body + '}\n', 'function of 61 lines')
        self.found('common/x.py', 'def f():\n' + '    a = 1\n' * 60, 'function of 61 lines')

    @unittest.skipUnless(check.formatter(), 'the clang-format of Debian 12 is not installed')
    def test_form(self):
        style = {'.clang-format': 'BasedOnStyle: Google\n', 'common/link/x.cpp': 'int   a ;\n'}
        style.update({path: '#pragma once\n' for path in SOUND if path.endswith('.hpp')})
        self.assertEqual(len(self.findings(style, form=None).errors), 1)
        self.assertEqual(self.findings({**style, 'common/link/x.cpp': 'int a;\n'}, form=None).errors, [])


class Functions(unittest.TestCase):
    def lines(self, text):
        return source.functions(text)

    def test_methods_templates_and_tests(self):
        text = ('namespace a {\nclass B {\n public:\n  int f() const { return 1; }\n  template <class T>\n  void g(T t) {\n'
                '    if (t) {\n    }\n  }\n};\n}\nTEST(A, B) {\n  x();\n}\n')
        self.assertEqual(self.lines(text), [(4, 4), (5, 9), (12, 14)])

    def test_constructors_with_braced_members(self):
        self.assertEqual(self.lines('A::A(int b)\n    : b_{b},\n      c_(1) {\n  for (;;) {\n  }\n}\n'), [(1, 6)])

    def test_tables_and_types_are_no_functions(self):
        self.assertEqual(self.lines('const int a[] = {\n1,\n2};\nstruct S {\n int b;\n};\nenum class E { kA };\n'), [])

    def test_braces_in_strings_and_comments_do_not_count(self):
        self.assertEqual(self.lines('void f() {\n  s = "}"; // }\n  c = \'}\'; n = 1\'000;\n  r = R"(})";\n}\n'), [(1, 5)])


class Layers(unittest.TestCase):
    def test_the_table_follows_the_design(self):
        order = ['common/core/x.hpp', 'common/link/x.hpp', 'master/mapping/x.hpp', 'master/master_node.hpp',
                 'common/wire/x.hpp', 'master/program/main.cpp']
        self.assertEqual(sorted(order, key=layers.layer), order)
        self.assertIsNone(layers.layer('elsewhere/x.hpp'))

    def test_a_folder_has_one_layer(self):
        folders = [folder for row in layers.LAYERS for folder in row]
        self.assertEqual(len(folders), len(set(folders)))


if __name__ == '__main__':
    unittest.main()
