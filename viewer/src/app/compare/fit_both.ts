import type { Box, CameraState, SceneView, Vec3 } from "../../scene/api";

/** The camera with the same direction that sees all of several boxes. */
export function cameraFor(camera: CameraState, boxes: readonly Box[]): CameraState {
  const limits = (axis: number) => [
    Math.min(...boxes.map((box) => box[axis * 2] ?? 0)),
    Math.max(...boxes.map((box) => box[axis * 2 + 1] ?? 0)),
  ];
  const [x, y, z] = [limits(0), limits(1), limits(2)] as [number[], number[], number[]];
  const middle = ([low = 0, high = 0]: number[]) => (low + high) / 2;
  const extent = ([low = 0, high = 0]: number[]) => high - low;
  const target: Vec3 = [middle(x), middle(y), middle(z)];
  const height = Math.hypot(extent(x), extent(y), extent(z)) || camera.height;
  return { ...camera, target, rest: [0, 0, 0], height };
}

/**
 * Lets two views with a common camera see both their contents, once for each value of `loaded`, which tells what was
 * loaded and is null until that is drawn: later steps must not move the camera.
 */
export function keepBothInSight(a: SceneView, b: SceneView, loaded: () => string | null): () => void {
  let seen = "";
  const look = () => {
    const now = loaded();
    const boxes = [a, b].map((view) => view.shapes().flatMap(({ box }) => (box ? [box] : [])));
    if (now === null || now === seen || boxes.some((list) => list.length === 0)) return;
    seen = now;
    a.setCamera(cameraFor(a.state.camera, boxes.flat()), { animate: false });
  };
  // After each view has decided about its own camera.
  const later = () => queueMicrotask(look);
  const ends = [a.on("shapes", later), b.on("shapes", later)];
  return () => ends.forEach((end) => end());
}
