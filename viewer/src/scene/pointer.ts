/** Mouse, pen, fingers and wheel on the canvas, as movements, clicks and hovering. */

import type { NavigationState } from "./api";
import { buttonsOf, motionOf, wheelMotion } from "./navigation";
import type { Motion } from "./navigation";

/** A press that moves less than this, in pixels, is a click. */
const kClickReach = 4;
const kDoubleClick = 350;

/** Something that is dragged in the scene instead of the camera. */
export interface Dragged {
  move(x: number, y: number, event: PointerEvent): void;
  end(x: number, y: number): void;
}

export interface Click {
  readonly x: number;
  readonly y: number;
  /** With Ctrl or Shift: adds to the selection. */
  readonly add: boolean;
  readonly double: boolean;
}

export interface PointerClient {
  navigation(): NavigationState;
  /** What the press takes hold of, or null for the camera. */
  grab(x: number, y: number, event: PointerEvent): Dragged | null;
  /** A movement by pixels from (x, y). */
  move(motion: Motion, dx: number, dy: number, x: number, y: number): void;
  /** Closer by a factor below 1 around (x, y). */
  zoom(factor: number, x: number, y: number): void;
  /** A button or finger is down, so that more movement is to be expected. */
  held(down: boolean): void;
  click(click: Click): void;
  /** null: the pointer left. */
  hover(place: { readonly x: number; readonly y: number } | null): void;
}

interface Finger {
  x: number;
  y: number;
}

export class PointerInput {
  private readonly pointers = new Map<number, Finger>();
  private start: Finger = { x: 0, y: 0 };
  private moved = false;
  private dragged: Dragged | null = null;
  private lastClick = { time: 0, x: 0, y: 0 };

  constructor(
    private readonly element: HTMLElement,
    private readonly client: PointerClient,
  ) {
    element.addEventListener("pointerdown", this.onDown);
    element.addEventListener("pointermove", this.onMove);
    element.addEventListener("pointerup", this.onUp);
    element.addEventListener("pointercancel", this.onCancel);
    element.addEventListener("pointerleave", this.onLeave);
    element.addEventListener("wheel", this.onWheel, { passive: false });
    element.addEventListener("contextmenu", this.onContextMenu);
  }

  private place(event: MouseEvent): Finger {
    const rect = this.element.getBoundingClientRect();
    return { x: event.clientX - rect.left, y: event.clientY - rect.top };
  }

  private readonly onDown = (event: PointerEvent): void => {
    const place = this.place(event);
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, place);
    if (event.button === 1) event.preventDefault(); // no scrolling by the middle button
    this.client.held(true);
    if (this.pointers.size > 1) {
      this.endDrag(place);
      this.moved = true;
      return;
    }
    this.start = place;
    this.moved = false;
    this.dragged = this.client.grab(place.x, place.y, event);
  };

  private readonly onMove = (event: PointerEvent): void => {
    const place = this.place(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType !== "touch") this.client.hover(place);
      return;
    }
    if (this.pointers.size >= 2) {
      this.pinch(event.pointerId, place);
      return;
    }
    if (!this.moved && Math.hypot(place.x - this.start.x, place.y - this.start.y) < kClickReach) return;
    this.moved = true;
    this.pointers.set(event.pointerId, place);
    if (this.dragged) {
      this.dragged.move(place.x, place.y, event);
      return;
    }
    const motion = this.motion(event);
    if (motion !== "none")
      this.client.move(motion, place.x - before.x, place.y - before.y, this.start.x, this.start.y);
  };

  private motion(event: PointerEvent): Motion {
    if (event.pointerType === "touch") return "rotate";
    const modifiers = { shift: event.shiftKey, ctrl: event.ctrlKey || event.metaKey, alt: event.altKey };
    return motionOf(this.client.navigation().preset, buttonsOf(event.buttons), modifiers);
  }

  /** Two fingers move, turn and stretch what is seen. */
  private pinch(id: number, place: Finger): void {
    const other = [...this.pointers].find(([key]) => key !== id)?.[1];
    const before = this.pointers.get(id)!;
    this.pointers.set(id, place);
    if (!other) return;
    const middle = { x: (place.x + other.x) / 2, y: (place.y + other.y) / 2 };
    this.client.move("pan", (place.x - before.x) / 2, (place.y - before.y) / 2, middle.x, middle.y);
    const spread = Math.hypot(place.x - other.x, place.y - other.y);
    const spreadBefore = Math.hypot(before.x - other.x, before.y - other.y);
    if (spread > 10 && spreadBefore > 10) this.client.zoom(spreadBefore / spread, middle.x, middle.y);
  }

  private readonly onUp = (event: PointerEvent): void => {
    const place = this.place(event);
    const known = this.pointers.delete(event.pointerId);
    if (this.pointers.size === 0) this.client.held(false);
    if (this.dragged) {
      const clicked = !this.moved;
      this.endDrag(place);
      if (!clicked) return;
    }
    if (!known || this.moved || this.pointers.size > 0 || event.button !== 0) return;
    const { time, x, y } = this.lastClick;
    const double = event.timeStamp - time < kDoubleClick && Math.hypot(x - place.x, y - place.y) < 6;
    this.lastClick = { time: double ? 0 : event.timeStamp, ...place };
    this.client.click({ ...place, add: event.ctrlKey || event.metaKey || event.shiftKey, double });
  };

  private endDrag(place: Finger): void {
    this.dragged?.end(place.x, place.y);
    this.dragged = null;
  }

  private readonly onCancel = (event: PointerEvent): void => {
    this.pointers.delete(event.pointerId);
    this.client.held(false);
    this.endDrag(this.place(event));
  };

  private readonly onLeave = (): void => {
    if (this.pointers.size === 0) this.client.hover(null);
  };

  private readonly onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    const place = this.place(event);
    const { preset, invertWheel } = this.client.navigation();
    const turn = {
      x: event.deltaX,
      y: event.deltaY,
      mode: event.deltaMode,
      ctrl: event.ctrlKey,
      shift: event.shiftKey,
    };
    const { motion, x, y } = wheelMotion(preset, turn);
    if (motion === "zoom") this.client.zoom(1.0015 ** (invertWheel ? -y : y), place.x, place.y);
    else this.client.move(motion, x, y, place.x, place.y);
  };

  private readonly onContextMenu = (event: Event): void => {
    event.preventDefault();
  };

  dispose(): void {
    this.element.removeEventListener("pointerdown", this.onDown);
    this.element.removeEventListener("pointermove", this.onMove);
    this.element.removeEventListener("pointerup", this.onUp);
    this.element.removeEventListener("pointercancel", this.onCancel);
    this.element.removeEventListener("pointerleave", this.onLeave);
    this.element.removeEventListener("wheel", this.onWheel);
    this.element.removeEventListener("contextmenu", this.onContextMenu);
  }
}
