/** How an object and all objects are drawn, after the state has been resolved to plain values. */

import type { Plane } from "three";

import type { Appearance, Color, DisplayState, Vec3 } from "./api";
import type { DrawnColors } from "./element_colors";

/** Of one object. */
export interface Look {
  readonly color: Color;
  readonly opacity: number;
  readonly pointSize: number;
  readonly selected: boolean;
  /** By which it is moved, as in an exploded picture. */
  readonly offset: Vec3;
  /** In place of the colour, where it is drawn by itself; null: one colour. */
  readonly elements: DrawnColors | null;
}

export function isSameLook(a: Look, b: Look): boolean {
  return (
    a.color === b.color &&
    a.opacity === b.opacity &&
    a.pointSize === b.pointSize &&
    a.selected === b.selected &&
    a.elements === b.elements &&
    a.offset.every((part, axis) => part === b.offset[axis])
  );
}

/** Of all objects. */
export interface Style {
  readonly appearance: Appearance;
  readonly display: DisplayState;
  /** Of edges and vertices. */
  readonly edgeColor: Color;
  /** What lies on the positive side of them is seen. */
  readonly clipping: readonly Plane[];
  /** The cut is filled by counting faces in the stencil buffer. */
  readonly stencil: boolean;
}

/** How much is seen of what is ghosted. */
export const kGhostOpacity = 0.12;

export const kSelectionColor: Color = "#ff9d00";
export const kBoundaryColor: Color = "#d81b3a";
export const kNonManifoldColor: Color = "#b100d6";

export function isTransparent(opacity: number): boolean {
  return opacity < 0.999;
}
