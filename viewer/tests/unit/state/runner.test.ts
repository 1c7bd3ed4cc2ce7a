import { expect, test } from "vitest";
import { Client } from "../../../src/api/client";
import { Runner, isFailure } from "../../../src/state/runner";
import { events, fakeServer, json } from "../api/fake_server";

const answer = { type: "int", value: 2, diagnostics: [], seconds: 0.001 };

test("an outcome has its table, and nothing runs afterwards", async () => {
  const runner = new Runner(new Client({ fetch: fakeServer(() => events(["result", answer])).fetch }));
  const outcome = await runner.run("query 1 + 1");
  if (isFailure(outcome)) throw new Error(outcome.message);
  expect(outcome.table?.columns).toEqual([{ name: "value", type: "int", shape: false }]);
  expect(outcome.table?.rows.row(0)).toEqual({ value: 2 });
  expect(runner.running.value).toEqual([]);
});

test("a failure keeps message, remedy and place", async () => {
  const error = {
    code: "unknown_name",
    message: "unknown name",
    remedy: "Look.",
    line: 1,
    column: 7,
    status: 422,
  };
  const runner = new Runner(new Client({ fetch: fakeServer(() => events(["error", { error }])).fetch }));
  expect(await runner.run("query x")).toEqual({
    statement: "query x",
    code: "unknown_name",
    message: "unknown name",
    remedy: "Look.",
    place: { line: 1, column: 7 },
  });
});

test("stopping ends the request and tells the server", async () => {
  const server = fakeServer((request) => {
    if (request.method === "DELETE") return new Response(null, { status: 204 });
    return new Promise<Response>(() => undefined);
  });
  const abortable: typeof fetch = (input, init) =>
    new Promise((resolve, reject) => {
      init?.signal?.addEventListener("abort", () => reject(new DOMException("aborted", "AbortError")));
      void server.fetch(input, init).then(resolve, reject);
    });
  const runner = new Runner(new Client({ fetch: abortable }));
  const outcome = runner.run("query 1");
  const [running] = runner.running.value;
  running?.stop();
  expect(await outcome).toMatchObject({ code: "interrupted", message: "Stopped." });
  expect(server.seen.map(({ method, url }) => `${method} ${url}`)).toEqual([
    "POST api/query",
    `DELETE api/statements/${running?.id ?? ""}`,
  ]);
  expect(runner.running.value).toEqual([]);
});

test("no answer is a failure without a place", async () => {
  const runner = new Runner(new Client({ fetch: () => Promise.reject(new TypeError("Failed to fetch")) }));
  expect(await runner.run("query 1")).toMatchObject({ code: "no_answer", place: null });
});

test("commands without a value have no table", async () => {
  const nothing = { type: null, value: null, diagnostics: [], seconds: 0 };
  const runner = new Runner(new Client({ fetch: fakeServer(() => json(nothing)).fetch }));
  const outcome = await runner.run("let a = 1");
  expect(isFailure(outcome) ? outcome.message : outcome.table).toBeNull();
});
