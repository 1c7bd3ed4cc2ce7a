/** Decoding of shapes, with what is computed of them, beside the page: in a worker, if the browser has them. */

import type { Box } from "./api";
import { ShapeFormatError } from "../glb/container";
import { decodeShapes } from "../glb/shapes";
import type { IndexArray, Shape } from "../glb/shapes";
import { featureLines, rememberFeatures } from "./features";
import { partsOf, rememberParts } from "./parts";

/** Parts of shapes are looked for up to so many triangles of an answer. */
export const kMostPartTriangles = 300_000;

/** The shapes of an answer, each with its creases, and with the boxes of its parts, if these were looked for. */
export interface Decoded {
  readonly shapes: readonly Shape[];
  readonly features: readonly (IndexArray | null)[];
  readonly parts: readonly (readonly Box[])[] | null;
}

export function decoded(bytes: ArrayBuffer): Decoded {
  const shapes = decodeShapes(bytes);
  const triangles = shapes.reduce((sum, { shown }) => sum + shown, 0);
  return {
    shapes,
    features: shapes.map(featureLines),
    parts: triangles <= kMostPartTriangles ? shapes.map(partsOf) : null,
  };
}

export type Answer = { readonly id: number } & (
  | { readonly decoded: Decoded; readonly problem: null }
  | { readonly problem: string; readonly isFormat: boolean }
);

interface Waiting {
  readonly take: (decoded: Decoded) => void;
  readonly fail: (error: Error) => void;
}

/** One for all views of a page. */
class Decoder {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private count = 0;

  async decode(bytes: ArrayBuffer): Promise<readonly Shape[]> {
    const { shapes, features, parts } = await this.ask(bytes);
    shapes.forEach((shape, index) => {
      rememberFeatures(shape, features[index] ?? null);
      if (parts) rememberParts(shape, parts[index]!);
    });
    return shapes;
  }

  private ask(bytes: ArrayBuffer): Promise<Decoded> {
    if (typeof Worker === "undefined") return Promise.resolve().then(() => decoded(bytes));
    const id = ++this.count;
    const answer = new Promise<Decoded>((take, fail) => this.waiting.set(id, { take, fail }));
    this.worker ??= this.makeWorker();
    this.worker.postMessage({ id, bytes }, [bytes]);
    return answer;
  }

  private makeWorker(): Worker {
    const worker = new Worker(new URL("./decode_worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }: MessageEvent<Answer>) => {
      const one = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.problem === null) one?.take(data.decoded);
      else one?.fail(data.isFormat ? new ShapeFormatError(data.problem) : new Error(data.problem));
    };
    worker.onerror = ({ message }) => {
      for (const { fail } of this.waiting.values())
        fail(new Error(`The shapes cannot be decoded: ${message}`));
      this.waiting.clear();
      worker.terminate();
      this.worker = null;
    };
    return worker;
  }
}

const decoder = new Decoder();

/** The shapes of an answer, whose bytes are taken away. Errors: ShapeFormatError, as of `decodeShapes`. */
export function decodeBeside(bytes: ArrayBuffer): Promise<readonly Shape[]> {
  return decoder.decode(bytes);
}
