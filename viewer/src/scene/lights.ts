/** The lights of a view: a global one that goes with the camera, and any number of lamps with places of their own. */

import { DirectionalLight, Group, HemisphereLight, PointLight, Vector3 } from "three";

import type { CameraState, LightsState, PointLightState } from "./api";
import { basisOf } from "./camera";
import type { Overlay } from "./overlay";
import type { Projector } from "./projection";
import type { SceneTheme } from "./theme";
import { toVector3 } from "./vec";

/** Of three.js: a light of this intensity shows a white surface at right angles to it white. */
const kFull = Math.PI;
const kAmbientShare = 0.42;
const kMarkerRadius = 8;

export class Lights {
  readonly group = new Group();
  private readonly ambient = new HemisphereLight();
  private readonly head = new DirectionalLight();
  private readonly lamps = new Map<number, PointLight>();
  /** Of the lamps, in coordinates of the database. */
  private readonly places = new Group();

  constructor() {
    this.group.add(this.ambient, this.head, this.head.target, this.places);
  }

  update(state: LightsState, camera: CameraState): void {
    const { global } = state;
    const brightness = global.on ? global.brightness * kFull : 0;
    this.ambient.color.set(global.color);
    this.ambient.groundColor.set(global.color).multiplyScalar(0.7);
    this.ambient.intensity = brightness * kAmbientShare;
    this.head.color.set(global.color);
    this.head.intensity = brightness * (1 - kAmbientShare) * 1.15;
    const { right, up, back } = basisOf(camera);
    this.head.target.position.set(0, 0, 0);
    this.head.position
      .set(0, 0, 0)
      .addScaledVector(back, 1)
      .addScaledVector(up, 0.45)
      .addScaledVector(right, -0.35);
    this.places.position.copy(toVector3(camera.target)).negate();
    this.updateLamps(state.lights);
  }

  private updateLamps(states: readonly PointLightState[]): void {
    const wanted = new Set(states.map(({ id }) => id));
    for (const [id, lamp] of this.lamps) {
      if (wanted.has(id)) continue;
      this.places.remove(lamp);
      this.lamps.delete(id);
    }
    for (const state of states) {
      let lamp = this.lamps.get(state.id);
      if (!lamp) {
        // Without decay: as bright everywhere near, and fading out towards its reach.
        lamp = new PointLight("#ffffff", 1, 0, 0);
        this.lamps.set(state.id, lamp);
        this.places.add(lamp);
      }
      lamp.visible = state.on;
      lamp.color.set(state.color);
      lamp.intensity = state.brightness * kFull;
      lamp.distance = state.reach;
      lamp.position.set(...state.position);
    }
  }

  dispose(): void {
    for (const lamp of this.lamps.values()) lamp.dispose();
    this.head.dispose();
    this.ambient.dispose();
  }
}

export function drawLightMarkers(
  overlay: Overlay,
  projector: Projector,
  state: LightsState,
  theme: SceneTheme,
): void {
  state.lights.forEach((light, index) => {
    const { x, y, visible } = projector.project(light.position);
    if (!visible) return;
    const selected = light.id === state.selected;
    if (selected) overlay.disc(x, y, kMarkerRadius + 4, "transparent", theme.accent);
    for (let i = 0; i < 8; i++) {
      const [dx, dy] = [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)];
      overlay.line(
        [x + 6 * dx, y + 6 * dy],
        [x + 9 * dx, y + 9 * dy],
        light.on ? theme.text : theme.muted,
        1.2,
      );
    }
    overlay.disc(x, y, 4.5, light.on ? light.color : "transparent", theme.text);
    overlay.text(`Light ${index + 1}`, x, y + 20, { color: theme.text, plate: theme.plate });
  });
}

/** The light whose marker is at a place of the view. */
export function lightAt(state: LightsState, projector: Projector, x: number, y: number): number | null {
  for (const light of [...state.lights].reverse()) {
    const place = projector.project(light.position);
    if (place.visible && Math.hypot(place.x - x, place.y - y) <= kMarkerRadius + 4) return light.id;
  }
  return null;
}

/** A new light beside the camera, with a free number. */
export function newLight(state: LightsState, camera: CameraState): PointLightState {
  const id = state.lights.reduce((most, light) => Math.max(most, light.id), 0) + 1;
  const { right, up, back } = basisOf(camera);
  // Near the border of the view, but in sight, so that its marker can be dragged.
  const aside = camera.height * 0.3;
  const position = new Vector3(...camera.target)
    .addScaledVector(back, camera.height * 0.45)
    .addScaledVector(up, aside)
    .addScaledVector(right, aside * (id % 2 === 1 ? 1 : -1));
  // Digits that are seen in the view.
  const grain = 10 ** Math.floor(Math.log10(camera.height) - 2);
  const round = (value: number): number => Number((Math.round(value / grain) * grain).toPrecision(15));
  return {
    id,
    on: true,
    color: "#ffd9a0",
    brightness: 1,
    position: [round(position.x), round(position.y), round(position.z)],
    reach: round(camera.height * 2.5),
  };
}
