/**
 * Bounding volume hierarchies of triangles, for picking.
 *
 * Relies on three-mesh-bvh 0.9, whose serialized form (version 1) has 32 bytes a node, little endian as all machines that
 * run browsers are: six floats minimum x, y, z, maximum x, y, z; then of a leaf a u32 offset of its first triangle, a u16
 * count, and the u16 0xffff; of an inner node a u32 distance to the right child in nodes, and a u32 axis of division. The
 * left child is the next node. The server writes the same, so that no tree is built here. The library takes whole
 * ArrayBuffers only: the nodes are copied out of the server's bytes when the object is picked for the first time.
 */

import type { BufferGeometry } from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { SerializedBVH } from "three-mesh-bvh";

import type { Primitive } from "../glb/shapes";

const kNodeBytes = 32;
const kNodeWords = kNodeBytes / 4;
const kLeaf = 0xffff;

/** Above it a tree is built in a worker. */
export const kWorkerTriangles = 200_000;

/**
 * A copy of the nodes of the server's tree; null if a child lies outside of the tree or a leaf outside of the triangles,
 * so that no picking can run astray. Cost: linear in the number of nodes.
 */
export function checkedTree(bytes: Uint8Array<ArrayBuffer>, triangles: number): ArrayBuffer | null {
  if (bytes.byteLength === 0 || bytes.byteLength % kNodeBytes !== 0) return null;
  const buffer: ArrayBuffer = bytes.slice().buffer;
  const words = new Uint32Array(buffer);
  const halves = new Uint16Array(buffer);
  const nodes = buffer.byteLength / kNodeBytes;
  for (let node = 0; node < nodes; node++) {
    const value = words[node * kNodeWords + 6]!;
    const valid =
      halves[node * 16 + 15] === kLeaf
        ? value + halves[node * 16 + 14]! <= triangles
        : value >= 2 && node + value < nodes;
    if (!valid) return null;
  }
  return buffer;
}

/**
 * The tree of a geometry from nodes in the form of three-mesh-bvh. `order` has the triangle of the geometry for each one
 * of the leaves; null if they are the same.
 */
export function treeOf(
  nodes: ArrayBuffer,
  geometry: BufferGeometry,
  order: Uint32Array<ArrayBuffer> | null = null,
): MeshBVH {
  // The library's class is one of types only.
  const serialized: unknown = { version: 1, roots: [nodes], index: null, indirectBuffer: order };
  return MeshBVH.deserialize(serialized as SerializedBVH, geometry, { setIndex: false });
}

interface WorkerAnswer {
  readonly nodes: ArrayBuffer;
  readonly order: Uint32Array<ArrayBuffer>;
}

/**
 * The tree of a primitive: the server's if it came with one, else it is built now, or in a worker if there are many
 * triangles (then null until it is there, and `ready` is called).
 */
export class TreeMaker {
  private readonly trees = new WeakMap<Primitive, MeshBVH>();
  private readonly moved = new WeakSet<Primitive>();
  private readonly running = new Map<Primitive, Worker>();

  tree(primitive: Primitive, geometry: BufferGeometry, ready: () => void): MeshBVH | null {
    const known = this.trees.get(primitive);
    if (known) return known;
    const triangles = (geometry.index?.count ?? 0) / 3;
    const given = this.moved.has(primitive) ? null : primitive.tree;
    const nodes = given && checkedTree(given, triangles);
    if (nodes) return this.remember(primitive, treeOf(nodes, geometry));
    if (triangles <= kWorkerTriangles || typeof Worker === "undefined") {
      return this.remember(primitive, new MeshBVH(geometry, { indirect: true, setBoundingBox: false }));
    }
    this.startWorker(primitive, geometry, ready);
    return null;
  }

  /** The triangles of the primitive were moved: the next tree is built anew. */
  forget(primitive: Primitive): void {
    this.trees.delete(primitive);
    this.moved.add(primitive);
  }

  private remember(primitive: Primitive, tree: MeshBVH): MeshBVH {
    this.trees.set(primitive, tree);
    return tree;
  }

  private startWorker(primitive: Primitive, geometry: BufferGeometry, ready: () => void): void {
    if (this.running.has(primitive)) return;
    const worker = new Worker(new URL("./tree_worker.ts", import.meta.url), { type: "module" });
    this.running.set(primitive, worker);
    const finish = (): void => {
      worker.terminate();
      this.running.delete(primitive);
    };
    worker.onmessage = (event: MessageEvent<WorkerAnswer>) => {
      const { nodes, order } = event.data;
      this.remember(primitive, treeOf(nodes, geometry, order));
      finish();
      ready();
    };
    worker.onerror = finish;
    // Copies of positions and indices go to the worker; the originals are being drawn.
    worker.postMessage({
      positions: primitive.positions.slice(),
      indices: primitive.indices?.slice() ?? null,
    });
  }

  dispose(): void {
    for (const worker of this.running.values()) worker.terminate();
    this.running.clear();
  }
}
