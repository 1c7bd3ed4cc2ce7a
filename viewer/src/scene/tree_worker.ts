/** Builds the tree of a large primitive that came without one, beside the page. */

import { BufferAttribute, BufferGeometry } from "three";
import { MeshBVH } from "three-mesh-bvh";

interface Job {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly indices: Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | null;
}

self.onmessage = (event: MessageEvent<Job>) => {
  const { positions, indices } = event.data;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  if (indices) geometry.setIndex(new BufferAttribute(indices, 1));
  const tree = MeshBVH.serialize(new MeshBVH(geometry, { indirect: true }), { cloneBuffers: false });
  const order = new Uint32Array(tree.indirectBuffer ?? []);
  self.postMessage({ nodes: tree.roots[0], order }, { transfer: [tree.roots[0]!, order.buffer] });
};
