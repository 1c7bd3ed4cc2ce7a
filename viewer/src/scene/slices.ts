/**
 * The drawing of a scene in parts, each of a limited number of triangles and lines, in the order in which three.js draws
 * all of it. What is off the scene by the time when its turn comes is left out.
 */

import { Frustum, InstancedBufferGeometry, Matrix4, Vector3 } from "three";
import type {
  BufferAttribute,
  BufferGeometry,
  Camera,
  InterleavedBufferAttribute,
  Material,
  Object3D,
  Scene,
  WebGLRenderer,
} from "three";

import { kLargeBytes, uploadNext } from "./uploads";

/** What is drawn in the present part, and the lights on it. */
export const kSliceLayer = 2;
/** Bytes whose upload takes as long as drawing a triangle, by processor. */
const kBytesPerTriangle = 100;

interface Drawable extends Object3D {
  readonly geometry: BufferGeometry;
  readonly material: Material;
  readonly isMesh?: boolean;
  readonly isLineSegments?: boolean;
  readonly isPoints?: boolean;
}

interface Piece {
  readonly object: Drawable;
  /** Towards the eye. */
  readonly nearness: number;
}

/** Bytes of large arrays that are copied for one part, in 8 milliseconds on a slow processor. */
const kUploadBytes = 8_000_000;
/** Smaller arrays that were drawn already. */
const uploaded = new WeakSet<object>();

export class Slices {
  private readonly pieces: readonly Piece[];
  private next = 0;
  /** Elements of the next piece that are drawn already. */
  private drawn = 0;

  constructor(
    private readonly scene: Scene,
    private readonly camera: Camera,
  ) {
    this.pieces = piecesOf(scene, camera);
  }

  /** Draws about so many triangles; true if nothing is left. The target of the renderer is set, and is not cleared. */
  draw(renderer: WebGLRenderer, budget: number): boolean {
    const slice: { object: Drawable; start: number; count: number }[] = [];
    let left = budget;
    while (this.next < this.pieces.length && left > 0) {
      const { object } = this.pieces[this.next]!;
      const { geometry } = object;
      if (!isInScene(object, this.scene)) {
        this.advance();
        continue;
      }
      if (this.drawn === 0) {
        const bytes = uploadNext(geometry, kUploadBytes);
        if (bytes > 0) {
          slice.push({ object, start: 0, count: 0 });
          break;
        }
        left -= uploadCost(geometry);
      }
      const { start, count } = rangeOf(geometry);
      const unit = unitOf(object);
      const isWhole = unit === 0;
      const most = isWhole ? count : Math.max(1, Math.floor(left)) * unit;
      const taken = Math.min(count - this.drawn, most);
      slice.push({ object, start: start + this.drawn, count: taken });
      left -= isWhole ? costOfWhole(geometry) : taken / unit;
      this.drawn += taken;
      if (this.drawn >= count) this.advance();
    }
    this.render(renderer, slice);
    return this.next >= this.pieces.length;
  }

  private advance(): void {
    this.next++;
    this.drawn = 0;
  }

  private render(
    renderer: WebGLRenderer,
    slice: readonly { object: Drawable; start: number; count: number }[],
  ): void {
    const { scene, camera } = this;
    const layers = camera.layers.mask;
    const before = slice.map(({ object: { geometry } }) => ({ ...geometry.drawRange }));
    for (const { object, start, count } of slice) {
      object.layers.enable(kSliceLayer);
      if (unitOf(object) > 0) object.geometry.setDrawRange(start, count);
    }
    camera.layers.set(kSliceLayer);
    renderer.render(scene, camera);
    camera.layers.mask = layers;
    slice.forEach(({ object }, i) => {
      object.layers.disable(kSliceLayer);
      object.geometry.setDrawRange(before[i]!.start, before[i]!.count);
    });
  }
}

/** What is visible, as three.js sorts it: what is seen through last, near things first, those seen through from afar. */
function piecesOf(scene: Scene, camera: Camera): Piece[] {
  const pieces: Piece[] = [];
  const place = new Vector3();
  scene.updateMatrixWorld();
  const { projectionMatrix, matrixWorldInverse } = camera;
  const sight = new Frustum().setFromProjectionMatrix(
    new Matrix4().multiplyMatrices(projectionMatrix, matrixWorldInverse),
  );
  scene.traverseVisible((object) => {
    const { isMesh, isLineSegments, isPoints, material } = object as Drawable;
    const isDrawable = [isMesh, isLineSegments, isPoints].includes(true) || "isLine" in object;
    if (!isDrawable || !material.visible || !object.layers.test(camera.layers)) return;
    // As the renderer does: of what is out of sight nothing would be copied.
    if (object.frustumCulled && !sight.intersectsObject(object)) return;
    const sphere = (object as Drawable).geometry.boundingSphere;
    place.copy(sphere?.center ?? place.set(0, 0, 0)).applyMatrix4(object.matrixWorld);
    place.applyMatrix4(camera.matrixWorldInverse);
    pieces.push({ object: object as Drawable, nearness: place.z });
  });
  return pieces.sort(comparePieces);
}

function comparePieces(a: Piece, b: Piece): number {
  const [first, second] = [a.object.material.transparent, b.object.material.transparent];
  if (first !== second) return first ? 1 : -1;
  const [before, after] = [a.object.renderOrder, b.object.renderOrder];
  if (before !== after) return before < after ? -1 : 1;
  return first ? a.nearness - b.nearness : b.nearness - a.nearness;
}

function isInScene(object: Object3D, scene: Scene): boolean {
  for (let at: Object3D | null = object; at; at = at.parent) {
    if (!at.visible) return false;
    if (at === scene) return true;
  }
  return false;
}

/** Elements of a triangle, line or point; 0 for what cannot be divided. */
function unitOf({ geometry, isMesh, isLineSegments, isPoints }: Drawable): 0 | 1 | 2 | 3 {
  if (geometry instanceof InstancedBufferGeometry) return 0;
  if (isMesh) return 3;
  if (isLineSegments) return 2;
  return isPoints ? 1 : 0;
}

function rangeOf({ index, attributes, drawRange }: BufferGeometry): { start: number; count: number } {
  const all = index?.count ?? attributes["position"]?.count ?? 0;
  const start = Math.min(drawRange.start, all);
  return { start, count: Math.min(drawRange.count, all - start) };
}

function costOfWhole(geometry: BufferGeometry): number {
  const instances = geometry instanceof InstancedBufferGeometry ? geometry.instanceCount : 1;
  return Math.min(instances, 1e6) + rangeOf(geometry).count / 3;
}

/** Of what is drawn for the first time. */
function uploadCost({ index, attributes }: BufferGeometry): number {
  let bytes = 0;
  const all: (BufferAttribute | InterleavedBufferAttribute)[] = Object.values(attributes);
  for (const attribute of index ? [...all, index] : all) {
    if (uploaded.has(attribute) || attribute.array.byteLength >= kLargeBytes) continue;
    uploaded.add(attribute);
    bytes += attribute.array.byteLength;
  }
  return bytes / kBytesPerTriangle;
}
