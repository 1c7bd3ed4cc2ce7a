/** What is in the scene for one level of detail of one shape. */

import type { Quaternion, Vector3 } from "three";

import type { Shape } from "../glb/shapes";
import type { EyeFrom, PlaneBudget } from "./front_faces";
import type { Look, Style } from "./look";

/** Where a body is drawn for the moment: scaled and turned about a place, then moved. */
export interface Preview {
  readonly centre: Vector3;
  readonly move: Vector3;
  readonly quaternion: Quaternion;
  readonly scale: Vector3;
}

export interface Body {
  readonly shape: Shape;
  setVisible(visible: boolean): void;
  setLook(look: Look): void;
  setStyle(style: Style): void;
  /** Draws only what shows its front to the eye, if nothing else can be seen; null: leaves that to the renderer. */
  chooseFronts(eyeFrom: EyeFrom | null, budget: PlaneBudget): void;
  /** The positions of the shape were changed in place, as by dragging a vertex. */
  positionsChanged(): void;
  /** Marks the vertices, so that they can be taken hold of. Of merged shapes they are not marked. */
  showGrips(show: boolean): void;
  /** null: where it is. Merged shapes stay where they are. */
  setPreview(preview: Preview | null): void;
  dispose(): void;
}
