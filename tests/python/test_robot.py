"""longreach.Robot: vectorised kinematics."""

import json
import unittest

import numpy as np
import programs

import longreach


class Robot(unittest.TestCase):
    def test_forward_kinematics_are_those_of_longreach_lab(self):
        robot = longreach.Robot('ur5e')
        joints = [0.3, -1.1, 1.2, -0.4, 0.9, 0.2]
        answer = json.loads(programs.run('longreach-lab', 'solve', 'robot-fk', input=json.dumps({'robot': 'ur5e', 'q': joints})))
        np.testing.assert_allclose(robot.fk(joints), answer['X'], atol=1e-14)
        np.testing.assert_allclose(robot.jacobian(joints), answer['J'], atol=1e-14)

    def test_shapes_follow_the_arguments(self):
        robot = longreach.Robot('kr6')
        joints = np.random.default_rng(1).uniform(-1.0, 1.0, (2, 5, 6))
        poses = robot.fk(joints)
        self.assertEqual(poses.shape, (2, 5, 4, 4))
        self.assertEqual(robot.jacobian(joints).shape, (2, 5, 6, 6))
        solution = robot.ik(poses, near=joints)
        self.assertEqual(solution.joints.shape, joints.shape)
        self.assertEqual(solution.status.shape, (2, 5))
        self.assertEqual(len(robot.ik_all(poses)), 10)
        np.testing.assert_array_equal(robot.fk(joints[1, 3]), poses[1, 3])

    def test_inverse_kinematics_lead_back(self):
        for name in ('ur5e', 'irb120', 'puma560', 'space_arm'):
            with self.subTest(name):
                robot = longreach.Robot(name)
                random = np.random.default_rng(7)
                low = np.array([max(joint.min, -3.0) for joint in robot.joints])
                high = np.array([min(joint.max, 3.0) for joint in robot.joints])
                joints = random.uniform(low, high, (50, 6))
                poses = robot.fk(joints)
                solution = robot.ik(poses, near=joints)
                found = solution.status != 'nearest'
                self.assertTrue(found.all())
                np.testing.assert_allclose(robot.fk(solution.joints), poses, atol=1e-9)
                for all_joints, pose in zip(robot.ik_all(poses), poses):
                    self.assertGreaterEqual(len(all_joints), 1)
                    np.testing.assert_allclose(robot.fk(all_joints), np.broadcast_to(pose, (len(all_joints), 4, 4)),
                                               atol=1e-8)

    def test_the_jacobian_is_the_derivative(self):
        robot = longreach.Robot('ur10')
        q = np.array([0.2, -1.0, 1.0, 0.3, 0.7, -0.5])
        step = 1e-6
        for i in range(6):
            ahead, behind = q.copy(), q.copy()
            ahead[i] += step
            behind[i] -= step
            slope = (robot.fk(ahead)[:3, 3] - robot.fk(behind)[:3, 3]) / (2.0 * step)
            np.testing.assert_allclose(robot.jacobian(q)[3:, i], slope, atol=1e-8)

    def test_a_urdf_is_a_robot(self):
        robot = longreach.Robot(str(programs.SOURCE / 'deploy' / 'robots' / 'gantry.urdf'))
        self.assertTrue(any(joint.prismatic for joint in robot.joints))

    def test_errors_name_what_is_wrong(self):
        robot = longreach.Robot('ur5e')
        for call, why in ((lambda: robot.fk([0.0] * 5), 'last dimension must be 6'),
                          (lambda: robot.ik(np.eye(3)), 'must be 4 and 4'),
                          (lambda: robot.ik(2.0 * np.eye(4)), 'not a rigid transform'),
                          (lambda: robot.ik(np.eye(4), near=np.zeros(5)), 'near has shape'),
                          (lambda: robot.fk([np.nan] * 6), 'not finite'),
                          (lambda: longreach.Robot('no_such_robot'), 'no_such_robot')):
            with self.subTest(why), self.assertRaisesRegex(longreach.InputError, why):
                call()

    def test_out_of_reach_is_the_nearest_pose(self):
        robot = longreach.Robot('ur5e')
        far = np.eye(4)
        far[0, 3] = 5.0
        solution = robot.ik(far)
        self.assertEqual(solution.status, 'nearest')
        self.assertGreater(solution.position_error_m, 3.0)
