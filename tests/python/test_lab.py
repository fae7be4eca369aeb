"""longreach.Lab and longreach.Env against longreach-lab, and their parts in Python."""

import csv
import json
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import numpy as np
import programs

import longreach

MOON = {'profile': 'moon'}


class Reproduces(unittest.TestCase):
    """The laboratory of Python is that of longreach-lab."""

    def test_metrics_and_trace_are_those_of_longreach_lab(self):
        with tempfile.TemporaryDirectory() as folder:
            programs.run('longreach-lab', 'run', 'touch', '--seed', 3, '--set', 'profile=moon', '--out', folder)
            expected = json.loads((pathlib.Path(folder) / 'metrics.json').read_text())['metrics']
            with open(pathlib.Path(folder) / 'touch.csv', encoding='ascii') as file:
                rows = list(csv.DictReader(file))
        lab = longreach.Lab(MOON, seed=3)
        metrics = lab.run()
        self.assertGreater(len(metrics), 20)
        for name, value in metrics.items():
            self.assertEqual(float(expected[name]['value'] if isinstance(expected[name], dict) else expected[name]), value,
                             name)
        trace = lab.trace()
        self.assertEqual(len(rows), len(trace['t_s']))
        for name, column in trace.items():
            self.assertEqual([row[name] for row in rows], [number_text(value) for value in column], name)

    def test_values_are_those_of_the_views(self):
        lab = longreach.Lab(seed=3)
        state = lab.run(until=6.0) and lab.state
        master, slave = lab.values(), lab.values('slave')
        self.assertEqual(master['state'].capitalize(), state.state)
        self.assertEqual([master['hand_m'][axis] for axis in 'xyz'], list(state.handle_m))
        self.assertEqual([slave['tool']['position_m'][axis] for axis in 'xyz'], list(state.X_WE[:3, 3]))
        self.assertEqual(slave['violations_by_limit']['joint_jerk'], '0')
        self.assertEqual(master['far']['engagement'], master['engagement'])
        self.assertEqual((master['tick'], slave['tick']), ('6000', '6000'))
        self.assertEqual(master['refusal']['cause'], 'NONE')
        self.assertNotIn('grip', master)
        with self.assertRaisesRegex(longreach.InputError, "side = 'hand' is neither"):
            lab.values('hand')

    def test_steps_of_any_size_give_the_same(self):
        whole, parts = longreach.Lab(seed=5), longreach.Lab(seed=5)
        whole.run(until=8.0)
        for ticks in (1, 7, 992, 3000, 4000):
            parts.step(ticks)
        self.assertEqual(whole.state.time_s, parts.state.time_s)
        self.assertEqual(whole.metrics(), parts.metrics())

    def test_another_seed_gives_another_run(self):
        first, second = longreach.Lab(seed=1), longreach.Lab(seed=2)
        first.run(until=4.0)
        second.run(until=4.0)
        self.assertNotEqual(first.metrics(), second.metrics())


def number_text(value):
    return 'nan' if np.isnan(value) else f'{value:.9g}'


class Speed(unittest.TestCase):
    """Ratios in one run, the best of several: the machine has other work."""

    @staticmethod
    def fastest(run):
        times = []
        for _ in range(4):
            start = time.process_time()
            run()
            times.append(time.process_time() - start)
        return min(times)

    @staticmethod
    def program():
        before = os.times()
        programs.run('longreach-lab', 'run', 'touch', '--seed', 3, '--quiet')
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    def test_takes_at_most_1_1_times_the_time_of_the_program(self):
        program = min(self.program() for _ in range(4))
        package = self.fastest(lambda: longreach.Lab(seed=3).run())
        print(f'longreach-lab {program:.3f} s, Lab {package:.3f} s: {package / program:.2f} times')
        self.assertLess(package, 1.1 * program)

    def test_takes_at_most_twice_the_time_with_an_operator(self):
        class Still:
            def hand(self, state):
                return np.array([0.01 * np.sin(state.time_s), 0.0, 0.0])

        seconds = 10.0
        without = self.fastest(lambda: self.driven().run(until=seconds))
        package = self.fastest(lambda: longreach.Lab(seed=3, operator=Still()).run(until=seconds))
        print(f'without {without:.3f} s, with an operator {package:.3f} s: {package / without:.2f} times')
        self.assertLess(package, 2.0 * without)

    @staticmethod
    def driven():
        lab = longreach.Lab(seed=3)
        lab.drive(longreach.Hand())
        return lab


class Parts(unittest.TestCase):
    """Each part in Python changes the result as it should, and its exceptions end the run."""

    def test_an_operator_moves_the_robot(self):
        class Along:
            def hand(self, state):
                moved = 0.02 if state.state == 'Engaged' else 0.0
                return longreach.Hand(position_m=(0.0, moved, 0.0), firm=True)

        lab = longreach.Lab({'master.mapping.mode': 'POSITION', 'master.mapping.scale': 1.0}, operator=Along())
        lab.run(until=8.0)
        tool_m = lab.state.X_WE[:3, 3] - lab.state.anchor_m
        np.testing.assert_allclose(tool_m, lab.state.goal_m, atol=1e-3)
        self.assertGreater(lab.state.goal_m[1], 0.01)

    def test_a_law_is_what_the_hand_feels(self):
        class Pushes:
            def force(self, state):
                return [0.0, 0.0, 1.5]

        lab = longreach.Lab(law=Pushes())
        lab.drive(longreach.Hand())
        lab.run(until=3.0)
        # A light hand yields to the force.
        self.assertGreater(lab.state.handle_m[2], 1e-3)
        control = longreach.Lab()
        control.drive(longreach.Hand())
        control.run(until=3.0)
        self.assertLess(abs(control.state.handle_m[2]), 1e-4)

    def test_an_estimator_is_what_is_rendered(self):
        class Half:
            def stiffness(self, state):
                return 400.0

        own, control = longreach.Lab(seed=3, estimator=Half()), longreach.Lab(seed=3)
        own.run()
        control.run()
        self.assertAlmostEqual(own.metrics()['rendered_stiffness_n_per_m'], 400.0, delta=1.0)
        self.assertAlmostEqual(control.metrics()['rendered_stiffness_n_per_m'], 1000.0, delta=50.0)

    def test_a_robot_is_what_the_slave_controls(self):
        class Follower:
            """Follows at once, without contact."""

            def __init__(self, start):
                self.joints = np.array(start)
                self.calls = 0

            def step(self, time_s, setpoint):
                before = self.joints
                if setpoint is not None:
                    self.joints = setpoint
                self.calls += 1
                return self.joints, (self.joints - before) / 1e-3, np.zeros(3), np.zeros(3)

        robot = Follower(longreach.Robot('space_arm').start)
        lab = longreach.Lab({'sensing.force_noise_n': 0, 'sensing.moment_noise_nm': 0}, seed=3, robot=robot)
        lab.run(until=15.0)
        self.assertEqual(robot.calls, round(15.0 / lab.period_s))
        self.assertFalse(lab.state.in_contact)
        control = longreach.Lab(seed=3)
        control.run(until=15.0)
        self.assertEqual(control.metrics()['contact'], 1.0)
        np.testing.assert_allclose(longreach.Robot('space_arm').fk(robot.joints), lab.state.X_WE, atol=1e-3)

    def test_an_exception_ends_the_run_with_its_traceback(self):
        class Breaks:
            def __init__(self):
                self.calls = 0

            def _fail(self, *_):
                self.calls += 1
                raise KeyError('of the part')

            hand = force = stiffness = step = _fail

        for part in ('operator', 'law', 'estimator', 'robot'):
            with self.subTest(part):
                broken = Breaks()
                lab = longreach.Lab(seed=3, **{part: broken})
                names = []
                trace = None
                try:
                    lab.run()
                except KeyError as error:
                    trace = error.__traceback__
                while trace is not None:
                    names.append(trace.tb_frame.f_code.co_name)
                    trace = trace.tb_next
                self.assertIn('_fail', names)
                self.assertEqual(broken.calls, 1)

    def test_a_result_of_the_wrong_form_is_named(self):
        class Wrong:
            def force(self, state):
                return [1.0, 2.0]

        with self.assertRaisesRegex(longreach.InputError, r'law.force\(\) returned \[1.0, 2.0\], which is not a force'):
            longreach.Lab(law=Wrong()).step()
        with self.assertRaisesRegex(longreach.InputError, r'law has no method force\(\)'):
            longreach.Lab(law=object())


class Long(unittest.TestCase):
    """Long calls."""

    def test_other_threads_run_and_ctrl_c_ends_it(self):
        lab = longreach.Lab({'duration_s': 600, 'master.operator.probe_cycles': 1000})
        count = [0]
        end = threading.Event()

        def work():
            while not end.is_set():
                count[0] += 1
                time.sleep(1e-3)

        thread = threading.Thread(target=work)
        thread.start()
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            lab.run()
        end.set()
        thread.join()
        self.assertGreater(count[0], 20)
        self.assertGreater(lab.state.time_s, 0.0)
        lab.step()  # it continues

    def test_settings_are_checked(self):
        with self.assertRaises(longreach.InputError) as raised:
            longreach.Lab({'mapping.scale': 7})
        self.assertEqual(raised.exception.field, 'master.mapping.scale')
        with self.assertRaises(longreach.InputError):
            longreach.Lab(['profile=nowhere'])


class Task(unittest.TestCase):
    """longreach.Env."""

    def test_observations_are_delayed_and_seeds_repeat(self):
        env = longreach.Env(MOON, seconds=6.0, reward=lambda state: -float(np.linalg.norm(state.true_n)))
        first, info = env.reset(seed=4)
        self.assertEqual(first.shape, env.observation_space.shape)
        self.assertEqual(info['state'].state, 'Engaged')
        start_s = info['state'].time_s
        moved_s = seen_s = None
        observations = []
        truncated = False
        while not truncated:
            observation, reward, terminated, truncated, info = env.step([0.0, 0.03, 0.0])
            self.assertFalse(terminated)
            self.assertLessEqual(reward, 0.0)
            observations.append(observation)
            state = info['state']
            if moved_s is None and np.linalg.norm(state.X_WE[:3, 3] - state.anchor_m) > 1e-3:
                moved_s = state.time_s
            if seen_s is None and np.linalg.norm(observation[6:9]) > 1e-3:
                seen_s = state.time_s
        self.assertGreater(seen_s - moved_s, 1.2)  # one way of the link
        self.assertAlmostEqual(info['state'].time_s - start_s, 6.0, delta=0.1)
        again, _ = env.reset(seed=4)
        np.testing.assert_array_equal(first, again)
        np.testing.assert_array_equal(observations[0], env.step([0.0, 0.03, 0.0])[0])

    def test_step_before_reset_is_refused(self):
        with self.assertRaises(longreach.InputError):
            longreach.Env().step([0.0, 0.0, 0.0])
