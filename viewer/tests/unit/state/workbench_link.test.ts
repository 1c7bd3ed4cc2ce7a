import { expect, test } from "vitest";

import { decodeView, encodeView, makeView, sceneOf } from "../../../src/state/permalink";
import { foreignSteps, linkOf, restoreSides } from "../../../src/state/workbench_link";
import {
  dual,
  isWorkbenchStatement,
  limit,
  limitSchemes,
  schemes,
  setOperation,
  simplification,
  subdivision,
  variantsOf,
  vertexMove,
} from "../../../src/state/workbench_operations";
import { workbench } from "./workbench_fake";

test.each([
  "query $a",
  `query ${subdivision("volume3d", "loop").expression}`,
  `query ${limit("surface3d", "catmull-clark", 3).expression}`,
  `query ${simplification("mesh3d", 0.25).expression}`,
  `query ${dual("volume3d").expression}`,
  `query ${setOperation("minus", "mesh3d", "volume3d").expression}`,
  `query ${vertexMove("mesh3d", 7, [0.5, -1e-20, 3e25]).expression}`,
])("%s is an operation of the split screen", (statement) => {
  expect(isWorkbenchStatement(statement)).toBe(true);
});

test("so are all schemes with all variants", () => {
  expect(schemes).toContain("sqrt3");
  expect(limitSchemes).toContain("doo-sabin");
  for (const scheme of schemes)
    for (const variant of ["", ...variantsOf(scheme)])
      expect(isWorkbenchStatement(`query ${subdivision("volume3d", scheme, variant).expression}`)).toBe(true);
  expect(subdivision("mesh3d", "doo-sabin", "mean").expression).toBe('subdivide($a, "doo-sabin", 1)');
  expect(subdivision("mesh3d", "doo-sabin", "open").expression).toBe('subdivide($a, "doo-sabin", 1, "open")');
  expect(limit("mesh3d", "loop", 2, "warren").expression).toBe(
    'limitPosition(subdivide(triangulate($a), "loop", 2, "warren"), "loop", "warren")',
  );
});

test.each([
  "query Parts",
  "query Parts feed Parts deletedirect count",
  "query $a; delete Parts",
  "delete Parts",
  "let x = $a",
  "query importSTL('a.stl')",
  "query $a exportSTL[\"x\", 'a.stl', TRUE]",
  // Where a string ends, the language and a simple look do not agree.
  String.raw`query ("\"" = "") or (R feed R deletedirect count > 0) or ("" = "")`,
  String.raw`query ('"' = '') or (R feed R deletedirect count > 0) or ('"' = '')`,
  'query <text>"</text---> = (R feed R deletedirect count > 0) = ""',
])("%s is none", (statement) => {
  expect(isWorkbenchStatement(statement)).toBe(false);
});

test("the sides are made again in an order in which each mesh has what it needs", async () => {
  const { bench } = workbench();
  await bench.left.loadObject("Cube");
  await bench.right.loadObject("Ball");
  await bench.right.apply(dual);
  await bench.left.apply((type) => setOperation("minus", type, "volume3d"), bench.right.step.value);
  await bench.left.apply(dual, null, 2);
  const link = linkOf(bench, () => null, { left: { l: 1 }, right: { r: 1 }, sameCamera: false });
  expect(link).not.toBeNull();
  expect(foreignSteps(link!).map(({ statement }) => statement)).toEqual(["query Cube", "query Ball"]);
  const { view } = makeView({ outcomes: [], activeKey: null, selected: null, editor: "", scene: null });
  const read = (await decodeView(await encodeView({ ...view, compare: link! }))).compare!;
  expect(read).toEqual(link);

  const other = workbench();
  expect(await restoreSides(other.bench, read, [])).toBe(true);
  const labels = (side: "left" | "right") => other.bench.side(side).steps.value.map(({ label }) => label);
  expect(labels("left")).toEqual(["Cube", "minus with the other side", "dual", "dual"]);
  expect(labels("right")).toEqual(["Ball", "dual"]);
  // Every parameter is the result of a statement before.
  other.asked.forEach(({ parameters }, index) => {
    for (const { result } of Object.values(parameters as Record<string, { result: string }>)) {
      expect(Number(result.slice(1))).toBeLessThanOrEqual(index);
    }
  });
});

test("the limit surface keeps its control mesh", async () => {
  const { bench } = workbench();
  await bench.right.loadObject("Cube");
  await bench.showLimit("right", "loop", 2);
  const link = linkOf(bench, () => null, { left: null, right: null, sameCamera: true })!;
  const other = workbench();
  await restoreSides(other.bench, link, []);
  expect(other.bench.left.control.value).not.toBeNull();
  expect(other.bench.left.control.value?.result).toBe(other.bench.right.step.value?.outcome.resultId);
});

test("a mesh of a result that is not in the link cannot be linked, one that is can", async () => {
  const { bench } = workbench();
  await bench.left.load({ result: "r77", row: 3, column: "Solid" });
  const more = { left: null, right: null, sameCamera: true };
  expect(linkOf(bench, () => null, more)).toBeNull();
  const link = linkOf(bench, (result) => (result === "r77" ? 1 : null), more)!;
  const other = workbench();
  await restoreSides(other.bench, link, ["r1", "r5"]);
  expect(other.asked[0]?.parameters).toEqual({ a: { result: "r5", row: 3, column: "Solid" } });
});

test("colours of single objects go with their statements", () => {
  const scene = {
    overrides: [{ cell: { result: "0", row: 2, column: "S" }, color: "#ff0000" }],
    camera: { height: 3 },
  };
  expect(sceneOf(scene, ["r9"])).toEqual({
    overrides: [{ cell: { result: "r9", row: 2, column: "S" }, color: "#ff0000" }],
    camera: { height: 3 },
  });
  expect(sceneOf(scene, [null])).toEqual({ overrides: [], camera: { height: 3 } });
});

test("measures go with their objects, and only if all of them are there", () => {
  const hit = (result: string) => ({ cell: { result, row: 0, column: "S" }, point: [0, 0, 0] });
  const scene = {
    tools: {
      measures: [
        { id: 1, kind: "distance", hits: [hit("0"), hit("0")] },
        { id: 2, kind: "distance", hits: [hit("0"), hit("1")] },
      ],
      inspected: hit("1"),
    },
    focus: { hidden: [hit("0").cell, hit("1").cell] },
  };
  const { tools, focus } = sceneOf(scene, ["r9", null]) as typeof scene;
  expect(tools.measures).toEqual([{ id: 1, kind: "distance", hits: [hit("r9"), hit("r9")] }]);
  expect("inspected" in tools).toBe(false);
  expect(focus.hidden).toEqual([hit("r9").cell]);
});
