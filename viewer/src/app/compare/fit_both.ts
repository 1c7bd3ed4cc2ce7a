import type { Box, SceneView } from "../../scene/api";

/** The smallest box around several boxes, of which there is at least one. */
export function boxAround(boxes: readonly Box[]): Box {
  const least = (i: number) => Math.min(...boxes.map((box) => box[i] ?? 0));
  const most = (i: number) => Math.max(...boxes.map((box) => box[i] ?? 0));
  return [least(0), most(1), least(2), most(3), least(4), most(5)];
}

/**
 * Lets two views with a common camera see both their contents, once for each value of `loaded`, which says what was
 * loaded and is null until that is drawn: later steps must not move the camera.
 */
export function keepBothInSight(a: SceneView, b: SceneView, loaded: () => string | null): () => void {
  let seen = "";
  const look = () => {
    const now = loaded();
    const boxes = [a, b].map((view) => view.shapes().flatMap(({ box }) => (box ? [box] : [])));
    if (now === null || now === seen || boxes.some((list) => list.length === 0)) return;
    seen = now;
    const around = boxAround(boxes.flat());
    const [ofA, ofB] = [a.cameraSeeing(around), b.cameraSeeing(around)];
    a.setCamera(ofA.height > ofB.height ? ofA : ofB, { animate: false });
  };
  // After each view has decided about its own camera.
  const later = () => queueMicrotask(look);
  const ends = [a.on("shapes", later), b.on("shapes", later)];
  return () => ends.forEach((end) => end());
}
