/** The columns in a scene: added and removed, loaded again, shown and hidden. */

import type { CellRef, ColumnRef, FocusState, LoadProgress, ShapeInfo, ShapeSource } from "./api";
import type { Coloring } from "./coloring";
import type { Loader } from "./loader";
import { cellKey, sameColumn } from "./shape_store";
import type { Column, ShapeStore } from "./shape_store";

type ColumnOrRow = ColumnRef & { readonly row?: number };

export class Contents {
  constructor(
    private readonly store: ShapeStore,
    private readonly loader: Loader,
    private readonly coloring: Coloring,
  ) {}

  get sources(): readonly ShapeSource[] {
    return this.store.columns.map(({ source }) => source);
  }

  get progress(): readonly LoadProgress[] {
    return [...this.loader.latest.values()];
  }

  has(ref: ColumnRef): boolean {
    return this.store.column(ref) !== undefined;
  }

  add(source: ShapeSource): void {
    this.loader.start(this.store.addColumn(source));
  }

  /** Removes one column of a result, or all of them. */
  remove(result: string, column?: string): void {
    for (const known of [...this.store.columns]) {
      if (known.source.result !== result || (column !== undefined && known.source.column !== column))
        continue;
      this.loader.stop(known);
      this.coloring.forget(known);
      this.store.removeColumn(known);
    }
  }

  reload(ref: ColumnRef): void {
    const column = this.store.column(ref);
    if (!column) return;
    this.loader.stop(column);
    column.generation++;
    this.loader.start(column);
  }

  stopLoading(ref: ColumnRef): void {
    const column = this.store.column(ref);
    if (column) this.loader.halt(column);
  }

  resumeLoading(ref: ColumnRef): void {
    const column = this.store.column(ref);
    if (column) this.loader.resume(column);
  }

  /** Shows or hides a column; it, if it was hidden until now. `refreshVisibility` is to follow. */
  setVisible(ref: ColumnRef, visible: boolean): Column | null {
    const column = this.store.column(ref);
    if (!column) return null;
    const appears = visible && !column.visible;
    column.visible = visible;
    return appears ? column : null;
  }

  /** Hides the objects that are not to be seen within their columns. `refreshVisibility` is to follow. */
  applyFocus({ hidden, cells, others }: FocusState): void {
    const out = new Set(hidden.map(cellKey));
    const only = others === "hidden" && cells.length > 0 ? new Set(cells.map(cellKey)) : null;
    for (const record of this.store.records()) {
      const key = cellKey(record.cell);
      record.hidden = out.has(key) || (only !== null && !only.has(key));
    }
  }

  refreshVisibility(): void {
    this.store.refreshVisibility();
    this.loader.reconsider();
  }

  isVisible(what: ColumnOrRow): boolean {
    const column = this.store.column(what);
    if (!column?.visible) return false;
    return what.row === undefined || !column.records.get(what.row)?.hidden;
  }

  shapes(ref?: ColumnRef): readonly ShapeInfo[] {
    return [...this.store.records()]
      .filter(({ column }) => !ref || sameColumn(column.source, ref))
      .map((record) => record.info());
  }

  shape(cell: CellRef): ShapeInfo | null {
    return this.store.record(cell)?.info() ?? null;
  }
}
