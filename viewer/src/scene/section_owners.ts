/** What a section plane was placed for: it goes with these columns, and is placed anew for others. */

import type { Column } from "./shape_store";

export class SectionOwners {
  private names: ReadonlySet<string> | null = null;

  /** A plane is placed for what is shown. */
  start(columns: readonly Column[]): void {
    this.forget();
    this.take(columns);
  }

  /** The next columns that are shown are those of the plane. */
  forget(): void {
    this.names = null;
  }

  /** Takes what is shown now; false if the plane was placed for other columns than these. */
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
  return `${source.title}\n${source.column}`;
}
