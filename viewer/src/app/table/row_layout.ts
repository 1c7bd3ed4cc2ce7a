/** Browsers cannot scroll elements much higher than this, in pixels. */
const highest = 12_000_000;

/**
 * Where the rows of a long table lie. All rows have one height; opened rows have a further part below them. Tables that
 * are too high for a browser are scrolled by a factor.
 */
export class RowLayout {
  /** Height of all rows, in pixels of their own. */
  readonly height: number;
  readonly #count: number;
  readonly #rowHeight: number;
  /** Opened rows in ascending order, with the sum of the parts up to and including theirs. */
  readonly #opened: readonly { readonly row: number; readonly sum: number }[];

  constructor(count: number, rowHeight: number, opened: ReadonlyMap<number, number> = new Map()) {
    let sum = 0;
    this.#opened = [...opened]
      .sort(([a], [b]) => a - b)
      .map(([row, height]) => ({ row, sum: (sum += height) }));
    this.#count = count;
    this.#rowHeight = rowHeight;
    this.height = count * rowHeight + sum;
  }

  /** Height of the scrolled element. */
  get scrollHeight(): number {
    return Math.min(this.height, highest);
  }

  /** The offset of the first visible pixel for a scroll position of a window of a height. */
  offsetOfScroll(scroll: number, windowHeight: number): number {
    const range = this.scrollHeight - windowHeight;
    if (this.height <= highest || range <= 0) return scroll;
    return (scroll / range) * (this.height - windowHeight);
  }

  /** The inverse of offsetOfScroll. */
  scrollOfOffset(offset: number, windowHeight: number): number {
    if (this.height <= highest) return offset;
    return (offset / (this.height - windowHeight)) * (this.scrollHeight - windowHeight);
  }

  /** The offset of the top of a row. */
  topOf(row: number): number {
    let above = 0;
    for (const opened of this.#opened) {
      if (opened.row >= row) break;
      above = opened.sum;
    }
    return row * this.#rowHeight + above;
  }

  /** The row at an offset, its opened part included. */
  rowAt(offset: number): number {
    let low = 0;
    let high = Math.max(0, this.#count - 1);
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.topOf(middle) <= offset) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}
