/** Decodes shapes beside the page; see decoding.ts. */

import { ShapeFormatError } from "../glb/container";
import type { Answer } from "./decoding";
import { decoded } from "./decoding";

self.onmessage = ({
  data: { id, bytes },
}: MessageEvent<{ readonly id: number; readonly bytes: ArrayBuffer }>) => {
  try {
    const result = decoded(bytes);
    const buffers = new Set<ArrayBuffer>([bytes]);
    for (const lines of result.features) if (lines) buffers.add(lines.buffer);
    self.postMessage({ id, decoded: result, problem: null } satisfies Answer, { transfer: [...buffers] });
  } catch (error) {
    const isFormat = error instanceof ShapeFormatError;
    const problem = error instanceof Error ? error.message : String(error);
    self.postMessage({ id, problem, isFormat } satisfies Answer);
  }
};
