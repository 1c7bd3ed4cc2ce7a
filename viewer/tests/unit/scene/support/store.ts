/** A store with test shapes, and a camera that looks at them, without WebGL. */

import type { CameraState, ShapeSource, StandardView } from "../../../../src/scene/api";
import { fitted, looking } from "../../../../src/scene/camera";
import { Dots } from "../../../../src/scene/dots";
import type { Look } from "../../../../src/scene/look";
import { SharedMaterials } from "../../../../src/scene/materials";
import { Picker } from "../../../../src/scene/picking";
import { Projector } from "../../../../src/scene/projection";
import { ShapeStore } from "../../../../src/scene/shape_store";
import type { Column } from "../../../../src/scene/shape_store";
import { kDefaultCamera } from "../../../../src/scene/state";
import { decodeShapes } from "../../../../src/glb/shapes";
import { buildGlb } from "./glb_builder";
import type { TestShape } from "./glb_builder";

/** What is drawn without a look of its own. */
export const kWhite: Look = {
  color: "#ffffff",
  opacity: 1,
  pointSize: 4,
  selected: false,
  offset: [0, 0, 0],
  elements: null,
};

export const kSize = { width: 1000, height: 800 };

export function sourceOf(result: string, count: number): ShapeSource {
  return {
    result,
    column: "Solid",
    title: result,
    count,
    attributes: [],
    load: () => Promise.reject(new Error("not asked for in this test")),
    values: () => Promise.resolve([]),
  };
}

export interface TestScene {
  readonly store: ShapeStore;
  readonly column: Column;
  readonly projector: Projector;
  readonly picker: Picker;
  readonly dots: Dots;
  readonly camera: CameraState;
}

export function sceneOf(shapes: readonly TestShape[], view: StandardView = "top"): TestScene {
  const store = new ShapeStore(new SharedMaterials());
  const column = store.addColumn(sourceOf("r1", shapes.length));
  for (const record of store.addShapes(column, decodeShapes(buildGlb(shapes)))) store.setLook(record, kWhite);
  const projector = new Projector();
  projector.size = kSize;
  const standard: CameraState = { ...looking(kDefaultCamera, view), projection: "orthographic" };
  const camera = fitted(standard, store.box(), kSize.width / kSize.height);
  projector.camera(camera, store.box());
  const dots = new Dots();
  dots.setRecords(store.visibleRecords());
  return {
    store,
    column,
    projector,
    camera,
    dots,
    picker: new Picker(
      store,
      projector,
      () => dots.dots(camera, kSize.height),
      () => undefined,
    ),
  };
}
