/**
 * Copies large arrays to the graphics card bit by bit. The renderer copies an array whole when it meets it first; of one
 * that is reserved here it only makes room then, and the rest follows as ranges that have changed.
 */

import { InterleavedBufferAttribute } from "three";
import type { BufferAttribute, BufferGeometry, InterleavedBuffer } from "three";

/** Arrays with fewer bytes are copied whole, which takes a few milliseconds. */
export const kLargeBytes = 4_000_000;

type Data = BufferAttribute | InterleavedBuffer;

/** Of which the renderer is to make room only. */
const reserved = new WeakSet<object>();
/** How many numbers of an array are on their way already. */
const begun = new WeakMap<Data, number>();
const unfinished = new Set<Data>();

/** Makes a context keep to what is reserved. */
export function takeReserved(gl: WebGL2RenderingContext): void {
  const bufferData = gl.bufferData.bind(gl);
  const reserving = (target: number, data: ArrayBufferView<ArrayBuffer>, usage: number): void => {
    if (reserved.has(data)) bufferData(target, data.byteLength, usage);
    else bufferData(target, data, usage);
  };
  gl.bufferData = reserving as typeof gl.bufferData;
}

/** Has about so many bytes of a geometry copied when it is drawn next; how many, or 0 if nothing of it is left. */
export function uploadNext(geometry: BufferGeometry, most: number): number {
  for (const data of largeData(geometry)) {
    const { array } = data;
    const from = begun.get(data);
    if (from === undefined) {
      // First there is only room for it.
      reserved.add(array);
      begun.set(data, 0);
      unfinished.add(data);
      return 1;
    }
    if (from >= array.length) continue;
    const count = Math.min(array.length - from, Math.ceil(most / array.BYTES_PER_ELEMENT));
    copy(data, from, count);
    return count * array.BYTES_PER_ELEMENT;
  }
  return 0;
}

/** What is begun is copied whole when it is drawn next. */
export function finishUploads(): void {
  for (const data of unfinished) {
    const from = begun.get(data) ?? 0;
    copy(data, from, data.array.length - from);
  }
}

function copy(data: Data, from: number, count: number): void {
  data.addUpdateRange(from, count);
  data.needsUpdate = true;
  begun.set(data, from + count);
  if (from + count < data.array.length) return;
  // A context that was lost and comes back gets all of it at once.
  reserved.delete(data.array);
  unfinished.delete(data);
}

function* largeData({ index, attributes }: BufferGeometry): Generator<Data> {
  const all = Object.values(attributes);
  for (const attribute of index ? [...all, index] : all) {
    const data = attribute instanceof InterleavedBufferAttribute ? attribute.data : attribute;
    const isChanging = data.updateRanges.length > 0 && !unfinished.has(data);
    if (data.array.byteLength >= kLargeBytes && !isChanging) yield data;
  }
}
