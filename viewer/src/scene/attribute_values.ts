/** Values of attributes of the columns in a scene, asked for when they are needed first. */

import type { AttributeValue } from "./api";
import type { Column } from "./shape_store";

const kValuesPerRequest = 10_000;

interface Values {
  readonly values: AttributeValue[];
  readonly abort: AbortController;
}

export class AttributeValues {
  private readonly known = new Map<Column, Map<string, Values>>();

  constructor(
    /** More values came. */
    private readonly changed: () => void,
  ) {}

  /** The values by row, as far as they have come; null of a column without the attribute. */
  of(column: Column, attribute: string): readonly AttributeValue[] | null {
    if (!column.source.attributes.some(({ name }) => name === attribute)) return null;
    let own = this.known.get(column);
    if (!own) this.known.set(column, (own = new Map<string, Values>()));
    let entry = own.get(attribute);
    if (!entry) {
      entry = { values: [], abort: new AbortController() };
      own.set(attribute, entry);
      void this.load(column, attribute, entry);
    }
    return entry.values;
  }

  private async load(column: Column, attribute: string, { values, abort }: Values): Promise<void> {
    const { source } = column;
    while (values.length < source.count) {
      const count = Math.min(kValuesPerRequest, source.count - values.length);
      const part = await source.values(attribute, values.length, count, abort.signal).catch(() => []);
      if (abort.signal.aborted || part.length === 0) break;
      values.push(...part);
    }
    if (!abort.signal.aborted) this.changed();
  }

  forget(column: Column): void {
    for (const { abort } of this.known.get(column)?.values() ?? []) abort.abort();
    this.known.delete(column);
  }
}
