/** What pointer and wheel do with the view: camera, selection, tools, and things that are dragged in the scene. */

import { Vector3 } from "three";

import type { CameraState, CellRef, Hit, NavigationState, Transformation, VertexMove } from "./api";
import { orbit, pan, placeInTargetPlane, turned, zoom } from "./camera";
import { lightAt } from "./lights";
import type { Motion } from "./navigation";
import { originOf } from "./picking";
import type { Picker } from "./picking";
import type { Click, Dragged, PointerClient } from "./pointer";
import { closestOnLine, draggedTo, moveVertices, placeOf } from "./vertex_drag";
import { outlineOf } from "./section";
import { FeatureEdges } from "./snapping";
import type { Stage } from "./stage";
import { primitiveOf } from "./geometry";
import { vertexTarget } from "./tools";
import { fromVector3, normalized, toVector3 } from "./vec";
import type { SceneState, ScenePatch } from "./api";

const kHandleReach = 12;
/** Hovering is not looked up among more points than this. */
const kMaxHoverPoints = 300_000;

/** What the interaction needs of the view. */
export interface InteractionHost {
  readonly state: SceneState;
  readonly selection: readonly CellRef[];
  moveCamera(camera: CameraState): void;
  update(patch: ScenePatch, moving?: boolean): void;
  selectByPerson(cells: readonly CellRef[]): void;
  opened(hit: Hit): void;
  picked(hit: Hit): void;
  hovered(hit: Hit | null): void;
  sectionRests(): void;
  vertexMoved(move: VertexMove): void;
  transformed(cell: CellRef, transformation: Transformation): void;
  redraw(moving: boolean): void;
  held(down: boolean): void;
}

export class Interaction implements PointerClient {
  private hoverRequest = 0;
  private readonly features = new WeakMap<object, FeatureEdges>();

  constructor(
    private readonly stage: Stage,
    private readonly picker: Picker,
    private readonly host: InteractionHost,
  ) {}

  navigation(): NavigationState {
    return this.host.state.navigation;
  }

  move(motion: Motion, dx: number, dy: number, x: number, y: number): void {
    if (motion === "zoom") {
      this.zoom(Math.exp((dy / this.stage.projector.size.height) * 3), x, y);
      return;
    }
    const camera = this.moved(motion, dx, dy);
    if (camera) this.host.moveCamera(camera);
  }

  private moved(motion: Motion, dx: number, dy: number): CameraState | null {
    const { camera, navigation } = this.host.state;
    const { height, width } = this.stage.projector.size;
    const turn = (navigation.rotationSpeed * Math.PI) / Math.min(height, width);
    if (motion === "rotate") return orbit(camera, dx * turn, dy * turn, navigation.orbit);
    if (motion === "roll") return turned(camera, "roll", (dx - dy) * turn * 40);
    const { panSpeed } = navigation;
    if (motion === "pan") return pan(camera, (dx / height) * panSpeed, (-dy / height) * panSpeed);
    return null;
  }

  zoom(factor: number, x: number, y: number): void {
    const { camera, navigation } = this.host.state;
    const { projector } = this.stage;
    const [nx, ny] = projector.normalized(x, y);
    const anchor = navigation.zoomToPointer
      ? placeInTargetPlane(camera, nx, ny, projector.aspect)
      : undefined;
    this.host.moveCamera(zoom(camera, factor ** navigation.zoomSpeed, anchor));
  }

  held(down: boolean): void {
    this.host.held(down);
  }

  click({ x, y, add, double }: Click): void {
    const hit = this.hitAt(x, y);
    const { selection } = this.host;
    const { tool } = this.host.state.tools;
    if (tool === "measure" || tool === "inspect") {
      if (hit) this.host.picked(hit);
      if (tool === "measure") return;
    }
    if (double && hit) {
      this.host.opened(hit);
      return;
    }
    if (!hit) {
      if (!add) this.host.selectByPerson([]);
      return;
    }
    const isHit = (cell: CellRef): boolean => JSON.stringify(cell) === JSON.stringify(hit.cell);
    const others = selection.filter((cell) => !isHit(cell));
    if (!add) this.host.selectByPerson([hit.cell]);
    else this.host.selectByPerson(others.length < selection.length ? others : [...selection, hit.cell]);
  }

  hover(place: { readonly x: number; readonly y: number } | null): void {
    cancelAnimationFrame(this.hoverRequest);
    if (!place) {
      this.host.hovered(null);
      return;
    }
    this.hoverRequest = requestAnimationFrame(() => {
      if (this.stage.handle.hover(place.x, place.y)) this.host.redraw(false);
      if (this.pointCount() > kMaxHoverPoints) return;
      this.host.hovered(this.hitAt(place.x, place.y));
    });
  }

  private pointCount(): number {
    let count = 0;
    for (const record of this.stage.store.visibleRecords()) {
      const points = record.finest && primitiveOf(record.finest.shape, "points");
      count += (points?.positions.length ?? 0) / 3;
    }
    return count;
  }

  hitAt(x: number, y: number): Hit | null {
    const { state } = this.host;
    const { tool, snapVertices, snapEdges } = state.tools;
    const snaps = tool !== "select";
    const options = {
      clipping: this.stage.section.clipping(state.section, this.stage.projector.origin),
      facesVisible: state.appearance.faces,
      snap: null,
    };
    const hit = this.picker.pick(x, y, options);
    if (!snaps || !hit?.triangle) return hit;
    const vertices = snapVertices || tool === "drag";
    const features = state.appearance.edges === "all" ? null : this.featuresOf(hit.cell);
    return this.picker.pick(x, y, {
      ...options,
      snap: { vertices, edges: snapEdges && tool === "measure", features },
    });
  }

  private featuresOf(cell: CellRef): FeatureEdges | null {
    const shape = this.stage.store.record(cell)?.finest?.shape;
    if (!shape) return null;
    const known = this.features.get(shape) ?? new FeatureEdges(shape);
    this.features.set(shape, known);
    return known;
  }

  grab(x: number, y: number, event: PointerEvent): Dragged | null {
    const left = event.button === 0;
    if (!left) return null;
    return (
      this.grabLight(x, y, event) ??
      this.grabSection(x, y) ??
      this.stage.handle.grab(x, y, this.host) ??
      this.grabVertex(x, y)
    );
  }

  /** The marker of a light, or with Ctrl the selected light from anywhere. */
  private grabLight(x: number, y: number, event: PointerEvent): Dragged | null {
    const { lights } = this.host.state;
    if (!lights.markers) return null;
    const { projector } = this.stage;
    const hit = lightAt(lights, projector, x, y);
    const id = hit ?? (event.ctrlKey ? lights.selected : null);
    const light = lights.lights.find((candidate) => candidate.id === id);
    if (!light) return null;
    if (lights.selected !== light.id) this.host.update({ lights: { selected: light.id } });
    const from = projector.toLocal(light.position);
    const start = draggedTo(projector.ray(x, y), from, new Vector3(), "free");
    if (!start) return null;
    return {
      move: (px, py) => {
        const to = draggedTo(projector.ray(px, py), from, new Vector3(), "free");
        if (!to) return;
        const position = fromVector3(projector.toGlobal(from.clone().add(to.sub(start))));
        const moved = this.host.state.lights.lights.map((one) =>
          one.id === light.id ? { ...one, position } : one,
        );
        this.host.update({ lights: { lights: moved } }, true);
      },
      end: () => this.host.redraw(false),
    };
  }

  /** The handle of the section plane: moves it along its normal; with Shift it tilts. */
  private grabSection(x: number, y: number): Dragged | null {
    const { section } = this.host.state;
    const { projector } = this.stage;
    if (!section.on || !section.plane || this.stage.contentBox.isEmpty()) return null;
    const { tip, centre } = outlineOf(section, this.stage.contentBox);
    const handle = projector.project(tip);
    if (!handle.visible || Math.hypot(handle.x - x, handle.y - y) > kHandleReach) return null;
    const normal = toVector3(normalized(section.normal));
    const start = toVector3(section.point);
    const held = projector.toLocal(tip);
    const hold = closestOnLine(projector.ray(x, y), held, normal);
    return {
      move: (px, py, event) => {
        const ray = projector.ray(px, py);
        if (event.shiftKey) {
          const to = draggedTo(ray, held, normal, "free");
          const tilted = to?.sub(projector.toLocal(centre)).normalize();
          if (tilted) this.host.update({ section: { normal: fromVector3(tilted), cap: "preview" } }, true);
          return;
        }
        const to = closestOnLine(ray, held, normal);
        if (!to || !hold) return;
        this.host.update(
          { section: { point: fromVector3(start.clone().add(to.sub(hold))), cap: "preview" } },
          true,
        );
      },
      end: () => this.host.sectionRests(),
    };
  }

  private grabVertex(x: number, y: number): Dragged | null {
    const target = vertexTarget(this.host.state);
    if (!target) return null;
    const hit = this.hitAt(x, y);
    if (
      hit?.vertex == null ||
      hit.snap !== "vertex" ||
      JSON.stringify(hit.cell) !== JSON.stringify(target.cell)
    )
      return null;
    const record = this.stage.store.record(target.cell)!;
    const level = record.finest!;
    const faces = primitiveOf(level.shape, "faces")!;
    const { projector } = this.stage;
    const origin = projector.toLocal(originOf(record));
    const vertex = nearestVertex(faces.positions, projector.toLocal(hit.point).sub(origin));
    const place = placeOf(faces, vertex);
    const from = new Vector3().fromArray(faces.positions, 3 * vertex).add(origin);
    let to = from;
    const report = (finished: boolean): void =>
      this.host.vertexMoved({
        cell: target.cell,
        vertex: place.id,
        from: fromVector3(projector.toGlobal(from)),
        to: fromVector3(projector.toGlobal(to)),
        finished,
      });
    return {
      move: (px, py) => {
        to = draggedTo(projector.ray(px, py), from, place.normal, target.how) ?? to;
        moveVertices(faces, place.vertices, to.clone().sub(origin));
        level.body.positionsChanged();
        this.host.redraw(true);
        report(false);
      },
      end: () => {
        this.picker.forget(faces);
        if (to !== from) report(true);
      },
    };
  }

  dispose(): void {
    cancelAnimationFrame(this.hoverRequest);
  }
}

function nearestVertex(positions: Float32Array, point: Vector3): number {
  let [best, gap] = [0, Infinity];
  const candidate = new Vector3();
  for (let i = 0; i < positions.length / 3; i++) {
    const distance = candidate.fromArray(positions, 3 * i).distanceToSquared(point);
    if (distance < gap) [best, gap] = [i, distance];
  }
  return best;
}
