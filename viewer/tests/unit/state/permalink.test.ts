import { expect, test } from "vitest";
import { Client } from "../../../src/api/client";
import { makeOutcome, type Parameters } from "../../../src/state/outcome";
import { decodeView, encodeView, makeView, parametersOf } from "../../../src/state/permalink";

const client = new Client({ fetch: () => Promise.reject(new Error("not asked")) });

function outcome(statement: string, id: string, parameters: Parameters = {}) {
  return makeOutcome(client, statement, parameters, {
    type: "volume3d",
    value: { type: "volume3d", triangles: 12 },
    diagnostics: [],
    seconds: 0,
    result: { id, count: 1, columns: [{ name: "value", type: "volume3d", shape: true }] },
  });
}

test("a view survives the way through a link", async () => {
  const a = outcome("query Plate", "r1");
  const b = outcome("query translate($p, $v)", "r2", {
    p: { result: "r1", row: 0, column: "value" },
    v: { type: "vector3d", value: "(1 0 0)" },
  });
  const { view, left } = makeView({
    outcomes: [a, b],
    activeKey: b.key,
    selected: { result: "r1", row: 0, column: "value" },
    editor: "query Plate;",
    scene: { camera: 1 },
  });
  expect(left).toEqual([]);
  const text = await encodeView(view);
  expect(text).toMatch(/^[A-Za-z0-9_-]+$/);
  const read = await decodeView(text);
  expect(read).toEqual(view);
  expect(read.active).toBe(1);
  expect(read.selected).toEqual([0, 0, "value"]);
  expect(read.statements[1] && parametersOf(read.statements[1], ["r7"])).toEqual({
    p: { result: "r7", row: 0, column: "value" },
    v: { type: "vector3d", value: "(1 0 0)" },
  });
});

test("an outcome whose parameters are cells of closed results is left out", () => {
  const orphan = outcome("query volume($p)", "r9", { p: { result: "r8", row: 0, column: "value" } });
  const { view, left } = makeView({
    outcomes: [orphan],
    activeKey: orphan.key,
    selected: null,
    editor: "",
    scene: null,
  });
  expect(view.statements).toEqual([]);
  expect(left).toEqual([orphan]);
});

test("damaged links and those of other versions are refused with a reason", async () => {
  await expect(decodeView("%%%")).rejects.toThrow("The link is damaged");
  await expect(decodeView("AAAA")).rejects.toThrow("The link is damaged");
  const other = await encodeView({ version: 2 } as never);
  await expect(decodeView(other)).rejects.toThrow("another version");
});

test("a link that unpacks to more than 4 MB is refused", async () => {
  const huge = { version: 1, statements: [], active: 0, editor: "x".repeat(5_000_000), scene: null } as const;
  await expect(decodeView(await encodeView(huge))).rejects.toThrow("The link is damaged");
});
