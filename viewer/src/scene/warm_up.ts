/** Objects like those that come first to most scenes, so that their shaders can be compiled before they come. */

import { BufferAttribute, BufferGeometry, Group, LineSegments, Mesh, Points } from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";

import { wideLines } from "./geometry";
import type { Style } from "./look";
import { faceMaterial, pointMaterial, styleFaces } from "./materials";
import type { SharedMaterials } from "./materials";

/**
 * Of closed solids and of surfaces, single and merged, with their edges, defects and dots. They are kept, since a shader
 * goes with its last material.
 */
export function usualObjects(shared: SharedMaterials, style: Style): Group {
  const group = new Group();
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(9), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Int8Array(12), 4, true));
  geometry.setAttribute("color", new BufferAttribute(new Uint16Array(12), 4, true));
  // A shader is compiled for each set of attributes.
  const placesAlone = new BufferGeometry();
  placesAlone.setAttribute("position", geometry.attributes["position"]!);
  const colored = placesAlone.clone();
  colored.setAttribute("color", new BufferAttribute(new Float32Array(9), 3));
  for (const isMerged of [false, true])
    for (const closed of [false, true]) {
      const material = faceMaterial(isMerged, shared.place);
      styleFaces(material, style, { closed, hasNormals: true, opacity: 1 });
      group.add(new Mesh(geometry, material));
    }
  const dots = pointMaterial(false);
  dots.vertexColors = true;
  group.add(
    new LineSegments(geometry, shared.edges),
    new LineSegments(placesAlone, shared.edges),
    new LineSegments2(wideLines(new Float32Array(6), null), shared.wideBoundary),
    new Points(colored, dots),
  );
  return group;
}
