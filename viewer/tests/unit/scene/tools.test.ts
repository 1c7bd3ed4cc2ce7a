import { expect, test } from "vitest";

import type { Hit, SceneState } from "../../../src/scene/api";
import { facingEye } from "../../../src/scene/section";
import { Owners } from "../../../src/scene/owners";
import type { Column } from "../../../src/scene/shape_store";
import { kDefaultState, patched, stateToJson } from "../../../src/scene/state";
import { stateFromJson } from "../../../src/scene/state_json";
import { handleTarget, inOwnPlace, picked, vertexTarget, withoutObjects } from "../../../src/scene/tools";

function hitOn(result: string, x = 0): Hit {
  return {
    cell: { result, row: 0, column: "Solid" },
    point: [x, 0, 0],
    snap: "vertex",
    face: 1,
    vertex: 2,
    triangle: null,
    edge: null,
    deviation: 0,
  };
}

const withTools = (change: Partial<SceneState["tools"]>): SceneState =>
  patched(kDefaultState, { tools: change }).state;

test("clicks are collected until the kind of measure has enough of them", () => {
  let { tools } = withTools({ tool: "measure", kind: "angle" });
  for (const result of ["r1", "r2", "r3"]) tools = { ...tools, ...picked(tools, hitOn(result)) };
  expect(tools.picks).toEqual([]);
  expect(tools.measures.map(({ id, kind, hits }) => [id, kind, hits.length])).toEqual([[1, "angle", 3]]);
  tools = { ...tools, ...picked(tools, hitOn("r1")) };
  expect(tools.picks.length).toBe(1);
  expect(picked({ ...tools, tool: "select" }, hitOn("r1"))).toEqual({});
});

test("with an object goes all that belongs to it", () => {
  const state = patched(kDefaultState, {
    tools: {
      tool: "measure",
      picks: [hitOn("r1"), hitOn("r2")],
      measures: [
        { id: 1, kind: "distance", hits: [hitOn("r1"), hitOn("r2")] },
        { id: 2, kind: "area", hits: [hitOn("r2")] },
      ],
      inspected: hitOn("r1"),
      drag: { cell: hitOn("r1").cell, how: "rotate" },
    },
    focus: { hidden: [hitOn("r1").cell, hitOn("r2").cell], cells: [hitOn("r1").cell] },
    overrides: [{ cell: hitOn("r1").cell, color: "#ff0000" }],
  }).state;
  const { state: left } = patched(
    state,
    withoutObjects(state, ({ result }) => result === "r1"),
  );
  expect(left.tools.picks.map(({ cell }) => cell.result)).toEqual(["r2"]);
  expect(left.tools.measures.map(({ id }) => id)).toEqual([2]);
  expect([left.tools.inspected, left.tools.drag]).toEqual([null, null]);
  expect(left.focus.hidden.map(({ result }) => result)).toEqual(["r2"]);
  expect(left.focus.cells).toEqual([]);
  expect(left.overrides).toEqual([]);
});

test("measures go to JSON and back, and those that would be parts of other statements are refused", () => {
  const state = withTools({ measures: [{ id: 4, kind: "distance", hits: [hitOn("r1"), hitOn("r1", 2)] }] });
  const json = JSON.parse(JSON.stringify(stateToJson(state))) as unknown;
  const { patch, rejected } = stateFromJson(json);
  expect(rejected).toEqual([]);
  expect(patched(kDefaultState, patch).state.tools.measures).toEqual(state.tools.measures);
  const bad = { ...hitOn("r1"), vertex: "0] extract[Position]); delete Parts" };
  for (const measures of [
    [{ id: 1, kind: "area", hits: [bad] }],
    [{ id: 1, kind: "distance", hits: [hitOn("r1")] }],
  ])
    expect(stateFromJson({ tools: { measures } }).rejected).toEqual(["tools.measures"]);
});

test("what is dragged is a fact of the tool", () => {
  const cell = hitOn("r1").cell;
  const drag = { cell, how: "normal" } as const;
  expect(vertexTarget(withTools({ tool: "drag", drag }))).toEqual(drag);
  expect(vertexTarget(withTools({ tool: "measure", drag }))).toBeNull();
  expect(handleTarget(withTools({ tool: "drag", drag }))).toBeNull();
  expect(handleTarget(withTools({ tool: "drag", drag: { cell, how: "scale" } }))?.how).toBe("scale");
});

test("a hit on an object that is drawn beside its place has the coordinates of the database", () => {
  expect(inOwnPlace(hitOn("r1", 12), [10, 0, 0]).point).toEqual([2, 0, 0]);
});

test("the cut turns to the eye", () => {
  expect(facingEye([0, 1, 0], [0.5, -0.7, 0.5])).toEqual([0, -1, 0]);
  expect(facingEye([1, 0, 0], [0.5, -0.7, 0.5])).toEqual([1, 0, 0]);
  expect(facingEye([1, 0, 0], [0, -1, 0])).toEqual([1, 0, 0]);
});

test("a view belongs to what it was made for", () => {
  const column = (title: string) => ({ source: { title, column: "Solid" } }) as unknown as Column;
  const owners = new Owners();
  owners.take([column("A")]);
  expect(owners.take([column("A"), column("B")])).toBe(true);
  expect(owners.take([column("B")])).toBe(true);
  expect(owners.take([])).toBe(true);
  expect(owners.take([column("C")])).toBe(false);
  expect(owners.take([column("C")])).toBe(true);
  owners.forget();
  expect(owners.take([column("D")])).toBe(true);
});
