/** What is added to the picture by name and belongs to no result: caps of sections, overlays, markers. */

import type { CellRef, Markers, OverlayStyle } from "./api";
import { decodeShapes } from "../glb/shapes";
import { disposeAddition, markersAddition, shapesAddition } from "./markers";
import type { Stage } from "./stage";

export class Additions {
  constructor(private readonly stage: Stage) {}

  /** The exact cuts of solids, each moved with its solid in an exploded picture. */
  setCaps(caps: readonly { readonly cell: CellRef; readonly bytes: ArrayBuffer }[]): void {
    const { section, store } = this.stage;
    const decoded = caps.map(({ cell, bytes }) => ({ cell, shapes: decodeShapes(bytes) }));
    section.setCaps(decoded, (cell) => store.record(cell)?.look?.offset ?? [0, 0, 0]);
  }

  setOverlay(
    name: string,
    overlay: { readonly bytes: ArrayBuffer; readonly style: OverlayStyle } | null,
  ): void {
    const key = `overlay ${name}`;
    this.remove(key);
    if (overlay) this.stage.addAddition(key, shapesAddition(decodeShapes(overlay.bytes), overlay.style));
  }

  setMarkers(name: string, markers: Markers | null): void {
    const key = `markers ${name}`;
    this.remove(key);
    if (markers) this.stage.addAddition(key, markersAddition(markers));
  }

  private remove(key: string): void {
    const addition = this.stage.additions.get(key);
    if (!addition) return;
    disposeAddition(addition);
    this.stage.additions.delete(key);
  }

  clear(): void {
    for (const key of [...this.stage.additions.keys()]) this.remove(key);
  }
}
