/** The handle by which an object is moved, turned or scaled: arrows, rings or boxes in the middle of its box. */

import { Object3D, Vector3 } from "three";
import type { Camera, Scene } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

import type { CellRef, Transformation, TransformMode } from "./api";
import type { Dragged } from "./pointer";
import type { Projector } from "./projection";
import { cellKey } from "./shape_store";
import type { ShapeRecord, ShapeStore } from "./shape_store";
import { fromVector3 } from "./vec";

/** Factors nearer to zero would make something flat. */
const kLeastFactor = 1e-3;

export interface TransformTarget {
  readonly cell: CellRef;
  readonly how: TransformMode;
}

export class TransformHandle {
  private current: TransformTarget | null = null;
  private controls: TransformControls | null = null;
  /** What the handle moves: the middle of the object, relative to the local origin. */
  private readonly proxy = new Object3D();
  private readonly centre = new Vector3();

  constructor(
    private readonly scene: Scene,
    private readonly store: ShapeStore,
    private readonly projector: Projector,
  ) {
    scene.add(this.proxy);
  }

  get target(): TransformTarget | null {
    return this.current;
  }

  /** Takes back what a drag before has shown, unless the target is another object, which will stand for it. */
  set target(target: TransformTarget | null) {
    if (!target || !this.current || cellKey(target.cell) === cellKey(this.current.cell))
      this.record()?.finest?.body.setPreview(null);
    this.current = target;
    if (!target) this.controls?.detach();
  }

  private record(): ShapeRecord | null {
    return (this.current && this.store.record(this.current.cell)) ?? null;
  }

  /** Before each frame: puts the handle where the object is. */
  update(camera: Camera): void {
    const record = this.record();
    if (!record?.finest || !this.current) {
      this.controls?.detach();
      return;
    }
    this.controls ??= this.made(camera);
    this.controls.camera = camera;
    if (this.controls.mode !== this.current.how) this.controls.setMode(this.current.how);
    if (this.controls.dragging) return;
    record.box().getCenter(this.centre);
    this.reset();
    if (this.controls.object !== this.proxy) this.controls.attach(this.proxy);
    this.controls.getHelper().updateMatrixWorld(true);
  }

  private made(camera: Camera): TransformControls {
    const controls = new TransformControls(camera);
    this.scene.add(controls.getHelper());
    return controls;
  }

  private reset(): void {
    this.proxy.position.copy(this.projector.toLocal(this.centre));
    this.proxy.quaternion.identity();
    this.proxy.scale.set(1, 1, 1);
    this.proxy.updateMatrixWorld(true);
  }

  /** The pointer is at a place of the view; whether the handle looks different then. */
  hover(x: number, y: number): boolean {
    const { controls } = this;
    if (!controls?.object) return false;
    const before = controls.axis;
    controls.pointerHover(this.pointer(x, y, 0));
    // The plane in which a drag would go is that of the axis.
    controls.getHelper().updateMatrixWorld(true);
    return controls.axis !== before;
  }

  /** What is dragged if the handle is at a place of the view. */
  grab(
    x: number,
    y: number,
    host: {
      redraw(moving: boolean): void;
      transformed(cell: CellRef, transformation: Transformation): void;
    },
  ): Dragged | null {
    this.hover(x, y);
    const { controls, current } = this;
    const body = this.record()?.finest?.body;
    if (!controls?.axis || !current || !body) return null;
    controls.pointerDown(this.pointer(x, y, 0));
    let moved = false;
    return {
      move: (px, py) => {
        moved = true;
        controls.pointerMove(this.pointer(px, py, -1));
        const { quaternion, scale } = this.proxy;
        const move = this.projector.toGlobal(this.proxy.position).sub(this.centre);
        body.setPreview({ centre: this.centre, move, quaternion, scale });
        host.redraw(true);
      },
      end: (px, py) => {
        controls.pointerUp(this.pointer(px, py, 0));
        const done = moved ? this.transformation(current.how) : null;
        this.reset();
        if (done) host.transformed(current.cell, done);
        else body.setPreview(null);
        host.redraw(false);
      },
    };
  }

  /** What the handle shows; null if that is nothing, or something that would make the object flat. */
  private transformation(mode: TransformMode): Transformation | null {
    const { quaternion, scale } = this.proxy;
    const about = fromVector3(this.centre);
    if (mode === "translate") {
      const by = this.projector.toGlobal(this.proxy.position).sub(this.centre);
      return by.lengthSq() > 0 ? { mode, by: fromVector3(by) } : null;
    }
    if (mode === "scale") {
      const factors = fromVector3(scale);
      const isFlat = factors.some((factor) => Math.abs(factor) < kLeastFactor);
      return isFlat || factors.every((factor) => factor === 1) ? null : { mode, about, factors };
    }
    const axis = new Vector3(quaternion.x, quaternion.y, quaternion.z);
    const sine = axis.length();
    if (sine === 0) return null;
    const degrees = (2 * Math.atan2(sine, quaternion.w) * 180) / Math.PI;
    return { mode, about, axis: fromVector3(axis.divideScalar(sine)), degrees };
  }

  /** As TransformControls takes it: places from -1 to 1; the button is -1 in a movement. */
  private pointer(x: number, y: number, button: number): PointerEvent {
    const [nx, ny] = this.projector.normalized(x, y);
    return { x: nx, y: ny, button } as PointerEvent;
  }

  dispose(): void {
    this.controls?.detach();
    this.controls?.getHelper().dispose();
  }
}
