// Forward kinematics of an arm with Denavit-Hartenberg rows as in proto/config_slave.proto, message Robot.

import { Matrix4, Quaternion, Vector3 } from 'three';

export const vector = (numbers) => new Vector3(...(numbers?.length === 3 ? numbers : [0, 0, 0]));

/** Quaternion of an orientation {x, y, z, w}. */
export const orientation = ({ x, y, z, w }) => new Quaternion(x, y, z, w);

/** Quaternion of a rotation vector, rad. */
export function rotation(numbers) {
  const v = vector(numbers);
  const angle = v.length();
  return new Quaternion().setFromAxisAngle(angle > 0 ? v.divideScalar(angle) : v.set(0, 0, 1), angle);
}

const turn = (axis, angle) => new Matrix4().makeRotationAxis(axis, angle);
const shift = (x, z) => new Matrix4().makeTranslation(x, 0, z);
const X = new Vector3(1, 0, 0);
const Y = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);
const placed = (placement) => new Matrix4().compose(vector(placement?.position_m), rotation(placement?.rotation_rad),
  new Vector3(1, 1, 1));

function row(joint, q, modified) {
  const theta = joint.theta_rad + (joint.kind === 'REVOLUTE' ? q : 0);
  const d = joint.d_m + (joint.kind === 'PRISMATIC' ? q : 0);
  const about_z = turn(Z, theta).multiply(shift(0, d));
  const about_x = shift(joint.a_m, 0).multiply(turn(X, joint.alpha_rad)).multiply(turn(Y, joint.beta_rad ?? 0));
  return modified ? about_x.multiply(about_z) : about_z.multiply(about_x);
}

/** Frames of the base, after each row, and of the tool. */
export function frames(robot, q) {
  const all = [placed(robot.base)];
  robot.joint.forEach((joint, i) => {
    all.push(all.at(-1).clone().multiply(row(joint, q[i] ?? 0, robot.convention === 'MODIFIED')));
  });
  all.push(all.at(-1).clone().multiply(placed(robot.tool)));
  return all;
}

/** Pose of the tool at the start position of the robot. */
export const start_frame = (robot) => frames(robot, robot.joint.map((joint) => joint.start_rad)).at(-1);

/** Indices of the joints that are at the end of their range. */
export function at_limit(robot, q) {
  return robot.joint.flatMap((joint, i) => {
    const margin = 0.004 * (joint.max_rad - joint.min_rad);
    const out = joint.kind !== 'FIXED' && (q[i] < joint.min_rad + margin || q[i] > joint.max_rad - margin);
    return out ? [i] : [];
  });
}
