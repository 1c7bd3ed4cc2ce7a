/** A page with a scene of test solids; not shipped. `?` and a name chooses the scene. */

import { render } from "preact";

import type { Database, ShapeRequest, ShapeSource } from "../../src/scene";
import { createSceneView } from "../../src/scene";
import { SceneModel, SceneKeys, SceneOverlay, ScenePanels, SceneToolbar } from "../../src/scene_panels";
import { buildGlb } from "../unit/scene/support/glb_builder";
import type { TestShape } from "../unit/scene/support/glb_builder";
import { cube, points, sphere, square } from "../unit/scene/support/solids";

export function sourceOf(result: string, make: (triangles: number) => TestShape[]): ShapeSource {
  const count = make(20_000).length;
  return {
    result,
    column: "Solid",
    title: result,
    count,
    attributes: [
      { name: "Size", type: "real" },
      { name: "Kind", type: "string" },
    ],
    load: ({ from, count: wanted, triangles }: ShapeRequest) => {
      const shapes = make(triangles).slice(from, from + wanted);
      const next = from + shapes.length < count ? from + shapes.length : null;
      return Promise.resolve({ bytes: buildGlb(shapes), next });
    },
    values: (attribute, from, wanted) =>
      Promise.resolve(
        Array.from({ length: Math.min(wanted, count - from) }, (_, i) =>
          attribute === "Size" ? (from + i) ** 2 : ["bolt", "nut", "plate"][(from + i) % 3]!,
        ),
      ),
  };
}

const scenes: Record<string, () => ShapeSource[]> = {
  cube: () => [sourceOf("r1", () => [cube(0, 2)])],
  mixed: () => [
    sourceOf("r1", () => [
      cube(0, 2),
      sphere(1, 1.2, 24, [4, 0, 0]),
      square(2, 3, [0, 4, 0]),
      points(
        3,
        Array.from(
          { length: 300 },
          (_, i) => Math.sin(i * 12.9898) * 1.5 + (i % 3 === 0 ? 4 : i % 3 === 1 ? 4 : 0),
        ),
      ),
    ]),
  ],
  many: () => [
    sourceOf("r1", () =>
      Array.from({ length: 2000 }, (_, i) =>
        i % 2
          ? cube(i, 0.7, [i % 45, Math.floor(i / 45), 0])
          : sphere(i, 0.4, 8, [i % 45, Math.floor(i / 45), 0]),
      ),
    ),
  ],
  large: () => [
    sourceOf("r1", (triangles) => {
      const full = 316;
      const rings = triangles === 0 ? full : Math.min(full, Math.floor(Math.sqrt(triangles) / 2));
      return [
        sphere(0, 2, rings, [0, 0, 0], { triangles: 4 * full * (full - 1), tree: rings < 100, edges: [] }),
      ];
    }),
  ],
};

const place = document.querySelector("#scene")!;
place.className = "scene";
const canvas = document.createElement("div");
canvas.className = "scene-canvas";
place.append(canvas);
const view = createSceneView(canvas);
Object.assign(window, { view });

const database: Database = {
  query: (statement) => {
    console.log("query", statement);
    return Promise.resolve({ type: "real", value: 1.5, diagnostics: [], result: null });
  },
  shapes: () => Promise.resolve(buildGlb([square(0, 2)])),
  rows: () => Promise.resolve([]),
  indexes: () => [],
  questions: () => [],
  drop: () => undefined,
  show: (statement) => console.log("show", statement),
};
const over = document.createElement("div");
place.append(over);
render(
  <>
    <SceneToolbar view={view} />
    <SceneOverlay view={view} />
    <SceneKeys view={view} onAction={console.log} onError={console.error} />
  </>,
  over,
);
render(<ScenePanels model={new SceneModel(view, database)} />, document.querySelector("#panels")!);
for (const source of (scenes[location.search.slice(1)] ?? scenes["mixed"]!)()) view.addResult(source);
