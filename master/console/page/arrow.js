// An arrow in the direction of a force that starts at its point of application. It is drawn in front of all other
// objects, because it is mostly inside the tool.

import { ConeBufferGeometry, CylinderBufferGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';

const M_PER_N = 0.02;
const LEAST_M = 0.035;
const MOST_M = 0.3;
const SHOWN_N = 0.15;     // forces below this value may be noise
const UP = new Vector3(0, 1, 0);

export class Arrow {
  constructor(color) {
    const material = new MeshBasicMaterial({ color, depthTest: false, transparent: true, opacity: 0.95 });
    this.shaft = new Mesh(new CylinderBufferGeometry(0.0022, 0.0022, 1, 12), material);
    this.head = new Mesh(new ConeBufferGeometry(0.007, 0.02, 16), material);
    this.group = new Group();
    this.group.add(this.shaft, this.head);
    for (const mesh of this.group.children) mesh.renderOrder = 10;
    this.group.visible = false;
  }

  /** `old`: the force may be outdated. */
  show(at, force_n, old = false) {
    const n = force_n.length();
    this.group.visible = n > SHOWN_N;
    if (!this.group.visible) return;
    const length = Math.min(LEAST_M + M_PER_N * n, MOST_M);
    this.shaft.material.opacity = old ? 0.25 : 0.95;     // shaft and head share one material
    this.group.position.copy(at);
    this.group.quaternion.setFromUnitVectors(UP, force_n.clone().divideScalar(n));
    this.shaft.scale.y = length - 0.02;
    this.shaft.position.y = (length - 0.02) / 2;
    this.head.position.y = length - 0.01;
  }
}
