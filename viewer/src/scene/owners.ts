/** What a view was made for: it goes with these columns, and is placed anew for others. */

import type { Column } from "./shape_store";

export class Owners {
  private names: ReadonlySet<string> | null = null;

  /** The view is that of a link: the next columns that are shown are its own. */
  forget(): void {
    this.names = null;
  }

  /** Takes what is shown now; false if none of it was there before. Nothing is taken for what is still to come. */
  take(columns: readonly Column[]): boolean {
    const shown = new Set(columns.map(nameOf));
    if (shown.size === 0) return true;
    const isSame = this.names === null || [...shown].some((name) => this.names!.has(name));
    this.names = shown;
    return isSame;
  }
}

/** The same statement that is run again shows the same thing, though its result is another one. */
function nameOf({ source }: Column): string {
  return `${source.isPreview ? "preview" : ""}\n${source.title}\n${source.column}`;
}
