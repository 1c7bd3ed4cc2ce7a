import { expect, test } from "vitest";
import { Client } from "../../../src/api/client";
import { makeOutcome, summaryOf, titleOf } from "../../../src/state/outcome";
import { Results } from "../../../src/state/results";
import { fakeServer } from "../api/fake_server";

function setUp() {
  const server = fakeServer(() => new Response(null, { status: 204 }));
  const client = new Client({ fetch: server.fetch });
  const outcome = (statement: string, id: string) =>
    makeOutcome(
      client,
      statement,
      {},
      {
        type: "(rel (tuple ((Name string) (Solid volume3d))))",
        value: [{ Name: "bolt", Solid: { type: "volume3d", triangles: 320 } }],
        diagnostics: [],
        seconds: 0,
        result: {
          id,
          count: 1,
          columns: [
            { name: "Name", type: "string", shape: false },
            { name: "Solid", type: "volume3d", shape: true },
          ],
        },
      },
    );
  return { server, results: new Results(client), outcome };
}

test("a new result hides earlier ones in 3D unless they are overlaid", () => {
  const { results, outcome } = setUp();
  const [a, b, c] = [outcome("query A", "r1"), outcome("query B", "r2"), outcome("query C", "r3")];
  results.add(a);
  results.add(b);
  expect([...a.shown.value]).toEqual([]);
  expect([...b.shown.value]).toEqual(["Solid"]);
  results.overlay.value = true;
  results.add(c);
  expect([...b.shown.value]).toEqual(["Solid"]);
  expect(results.active.value).toBe(c);
});

test("the same statement again replaces its result, which is dropped on the server", () => {
  const { results, outcome, server } = setUp();
  results.add(outcome("query A", "r1"));
  results.add(outcome(" query A ", "r2"));
  expect(results.list.value.map(({ resultId }) => resultId)).toEqual(["r2"]);
  expect(server.seen.map(({ method, url }) => `${method} ${url}`)).toEqual(["DELETE api/results/r1"]);
});

test("closing brings the neighbour to the front, and selecting a cell its table", () => {
  const { results, outcome } = setUp();
  const [a, b] = [outcome("query A", "r1"), outcome("query B", "r2")];
  results.add(a);
  results.add(b);
  results.select({ result: "r1", row: 0, column: "Solid" });
  expect(results.active.value).toBe(a);
  results.close(a);
  expect(results.active.value).toBe(b);
  expect(results.selected.value).toBeNull();
  results.closeAll();
  expect(results.active.value).toBeNull();
});

test.each([
  ["query Parts", "Parts"],
  ["# all\nquery  `Parts`", "Parts"],
  ["query Parts feed count", "Parts feed count"],
  ["let a = 1", "let a = 1"],
])("the title of %j is %j", (statement, title) => {
  expect(titleOf(statement)).toBe(title);
});

test("summaries of geometry are readable", () => {
  expect(summaryOf({ type: "volume3d", triangles: 2371, box: [0, 4, 0, 4, 0, 12] })).toEqual({
    type: "volume3d",
    count: "2,371 triangles",
    box: [0, 4, 0, 4, 0, 12],
  });
  expect(summaryOf({ type: "mesh3d", vertices: 1, faces: 12 })?.count).toBe("1 vertex, 12 faces");
  expect(summaryOf([1, 2, 3])).toBeNull();
  expect(summaryOf(null)).toBeNull();
});
