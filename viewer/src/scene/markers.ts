/** Points, segments and triangles that are highlighted in the scene, and shapes that belong to no result. */

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  LineBasicMaterial,
  Points,
  Vector3,
} from "three";
import type { Material } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";

import type { Box, Markers, OverlayStyle, Vec3 } from "./api";
import type { Shape } from "../glb/shapes";
import { boxLines, setLines } from "./furniture";
import { AttributeCache, geometryOf, kMaxWideSegments, primitiveOf, sphereOf, wideLines } from "./geometry";
import { pointMaterial } from "./materials";
import type { Overlay } from "./overlay";
import type { SceneTheme } from "./theme";
import { toBox3 } from "./vec";

/** A named addition to the picture. */
export interface Addition {
  readonly group: Group;
  readonly box: Box3;
  readonly labels: Markers["labels"];
}

function flat(points: readonly Vec3[], origin: Vec3): Float32Array<ArrayBuffer> {
  return new Float32Array(points.flatMap((point) => point.map((value, axis) => value - origin[axis]!)));
}

/** Markers are drawn over everything else, so that nothing hides them; boxes are not. */
export function markersAddition(markers: Markers): Addition {
  const group = new Group();
  const points = markers.points ?? [];
  const segments = (markers.segments ?? []).flat();
  const triangles = (markers.triangles ?? []).flat();
  const origin = points[0] ?? segments[0] ?? triangles[0] ?? middleOf(markers.boxes?.[0]);
  group.position.set(...origin);
  if (triangles.length > 0) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(flat(triangles, origin), 3));
    const material = new MeshBasicMaterial({
      color: markers.color,
      side: DoubleSide,
      transparent: true,
      opacity: 0.45,
      depthTest: false,
    });
    group.add(new Mesh(geometry, material));
  }
  if (segments.length > 0) {
    const material = new LineMaterial({ color: markers.color, linewidth: 2.5, depthTest: false });
    group.add(new LineSegments2(wideLines(flat(segments, origin), null), material));
  }
  if (points.length > 0) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(flat(points, origin), 3));
    const material = pointMaterial(false);
    material.color.set(markers.color);
    material.size = markers.size ?? 9;
    material.depthTest = false;
    material.transparent = true;
    group.add(new Points(geometry, material));
  }
  for (const child of group.children) {
    child.renderOrder = 10;
    child.frustumCulled = false;
  }
  if (markers.boxes) group.add(boxesOf(markers.boxes, new Vector3(...origin), markers.color));
  return { group, box: new Box3().setFromObject(group), labels: markers.labels };
}

function middleOf(box: Box | undefined): Vec3 {
  if (!box) return [0, 0, 0];
  const [x1, x2, y1, y2, z1, z2] = box;
  return [(x1 + x2) / 2, (y1 + y2) / 2, (z1 + z2) / 2];
}

/** Of a width that is seen well on any ground, unless there are too many for that. */
function boxesOf(
  boxes: readonly Box[],
  origin: Vector3,
  color: string,
): LineSegments<BufferGeometry, LineBasicMaterial> | LineSegments2 {
  const places = new Float32Array(boxLines(boxes.map(toBox3), origin));
  if (places.length / 6 <= kMaxWideSegments) {
    const wide = new LineSegments2(wideLines(places, null), new LineMaterial({ color, linewidth: 1.5 }));
    wide.frustumCulled = false;
    return wide;
  }
  const lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  setLines(lines, places, color);
  lines.frustumCulled = false;
  return lines;
}

/** Shapes such as the limit surface beside its control mesh. */
export function shapesAddition(shapes: readonly Shape[], style: OverlayStyle): Addition {
  const group = new Group();
  const opacity = style.opacity ?? 1;
  const see = { transparent: opacity < 1, opacity, depthWrite: opacity >= 1, depthTest: !style.onTop };
  for (const shape of shapes) {
    const cache = new AttributeCache();
    const part = new Group();
    part.position.set(...shape.translation);
    const faces = primitiveOf(shape, "faces");
    if (faces) {
      const material = new MeshLambertMaterial({
        color: style.color,
        side: DoubleSide,
        flatShading: !faces.normals,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        ...see,
      });
      part.add(new Mesh(geometryOf(faces, cache, sphereOf(shape)), material));
    }
    for (const role of ["edges", "boundary", "nonmanifold", "lines"] as const) {
      const lines = primitiveOf(shape, role);
      if (!lines || (role === "edges" && !style.edges)) continue;
      const material = new LineBasicMaterial({
        color: style.edgeColor ?? style.color,
        depthTest: !style.onTop,
      });
      part.add(new LineSegments(geometryOf(lines, cache, sphereOf(shape)), material));
    }
    const points = primitiveOf(shape, "points");
    if (points) {
      const material = pointMaterial(false);
      material.color.set(style.color);
      material.size = 6;
      part.add(new Points(geometryOf(points, cache, sphereOf(shape)), material));
    }
    group.add(part);
  }
  if (style.onTop) group.traverse((object) => (object.renderOrder = 9));
  return { group, box: new Box3().setFromObject(group), labels: undefined };
}

export function drawLabels(overlay: Overlay, labels: Markers["labels"], theme: SceneTheme): void {
  for (const { at, text } of labels ?? []) overlay.label(text, at, { color: theme.text, plate: theme.plate });
}

export function disposeAddition(addition: Addition): void {
  addition.group.removeFromParent();
  addition.group.traverse((object) => {
    if (!(object instanceof Mesh || object instanceof LineSegments || object instanceof Points)) return;
    (object.geometry as BufferGeometry).dispose();
    (object.material as Material).dispose();
  });
}
