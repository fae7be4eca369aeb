// A free body of unknown shape: the robot tracks its pose, but no scene describes it. Drawn are a small box at the origin
// of its frame, the axes of the frame (x red, y green, z blue) and its number.

import { AxesHelper, BoxBufferGeometry, CanvasTexture, Group, Mesh, MeshStandardMaterial, Sprite, SpriteMaterial } from 'three';

const EDGE_M = 0.03;
const AXIS_M = 0.08;
const NUMBER_M = 0.05;
const PIXELS = 64;

function number_sprite(number, color) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = PIXELS;
  const ink = canvas.getContext('2d');
  ink.font = `bold ${0.75 * PIXELS}px sans-serif`;
  ink.textAlign = 'center';
  ink.textBaseline = 'middle';
  ink.fillStyle = 'white';     // the material gives the colour
  ink.fillText(String(number), PIXELS / 2, PIXELS / 2);
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), color, depthTest: false }));
  sprite.scale.set(NUMBER_M, NUMBER_M, 1);
  sprite.position.set(0, 0, AXIS_M);
  sprite.renderOrder = 10;
  return sprite;
}

export class BodyMarker {
  constructor(number, colors) {
    this.material = new MeshStandardMaterial({ color: colors.scene, roughness: 0.7, metalness: 0, transparent: true });
    this.group = new Group();
    this.group.add(new Mesh(new BoxBufferGeometry(EDGE_M, EDGE_M, EDGE_M), this.material), new AxesHelper(AXIS_M),
      number_sprite(number, colors.scene));
    this.group.visible = false;
    this.age_s = null;
  }
}
