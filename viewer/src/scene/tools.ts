/** What tools do to the state of a view, and what leaves it with an object. */

import type { CellRef, DragState, Hit, ScenePatch, SceneState, ToolsState, TransformMode, Vec3 } from "./api";
import { measureInfo } from "./measures";

/** The state of the tools after a click on a place: one more for the measure, or the place that is inspected. */
export function picked(tools: ToolsState, hit: Hit): Partial<ToolsState> {
  if (tools.tool === "inspect") return { inspected: hit };
  if (tools.tool !== "measure") return {};
  const hits = [...tools.picks, hit];
  if (hits.length < measureInfo(tools.kind).picks) return { picks: hits };
  const id = 1 + Math.max(0, ...tools.measures.map((measure) => measure.id));
  return { picks: [], measures: [...tools.measures, { id, kind: tools.kind, hits }] };
}

/** A hit with the coordinates of the database, of an object that is drawn beside its place by an offset. */
export function inOwnPlace(hit: Hit, offset: Vec3): Hit {
  const back = (place: Vec3): Vec3 => [place[0] - offset[0], place[1] - offset[1], place[2] - offset[2]];
  const { triangle, edge } = hit;
  return {
    ...hit,
    point: back(hit.point),
    triangle: triangle && {
      ...triangle,
      corners: [back(triangle.corners[0]), back(triangle.corners[1]), back(triangle.corners[2])],
    },
    edge: edge && [back(edge[0]), back(edge[1])],
  };
}

/** Takes everything out of a state that belongs to objects that are gone. */
export function withoutObjects(state: SceneState, isGone: (cell: CellRef) => boolean): ScenePatch {
  const stays = ({ cell }: { readonly cell: CellRef }): boolean => !isGone(cell);
  const { tools, focus, overrides } = state;
  return {
    overrides: overrides.filter(stays),
    tools: {
      picks: tools.picks.filter(stays),
      measures: tools.measures.filter(({ hits }) => hits.every(stays)),
      inspected: tools.inspected && stays(tools.inspected) ? tools.inspected : null,
      drag: tools.drag && stays(tools.drag) ? tools.drag : null,
    },
    focus: {
      hidden: focus.hidden.filter((cell) => !isGone(cell)),
      cells: focus.cells.filter((cell) => !isGone(cell)),
    },
  };
}

type VertexDrag = DragState & { readonly how: "normal" | "plane" };
type HandleDrag = DragState & { readonly how: TransformMode };

/** The object whose vertices are dragged. */
export function vertexTarget({ tools: { tool, drag } }: SceneState): VertexDrag | null {
  const isVertex = tool === "drag" && (drag?.how === "normal" || drag?.how === "plane");
  return isVertex ? (drag as VertexDrag) : null;
}

/** The object with a handle by which it is moved, turned or scaled. */
export function handleTarget({ tools: { tool, drag } }: SceneState): HandleDrag | null {
  const isHandle = tool === "drag" && drag && drag.how !== "normal" && drag.how !== "plane";
  return isHandle ? (drag as HandleDrag) : null;
}
