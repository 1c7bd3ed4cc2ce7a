import { expect, test } from "vitest";
import { Client, isLoopback } from "../../../src/api/client";
import { ApiError, ServerGone } from "../../../src/api/errors";
import { events, fakeServer, json } from "./fake_server";

const answer = { type: "int", value: 2, diagnostics: [], seconds: 0.001 };

test("a query is a POST of JSON with the token", async () => {
  const server = fakeServer(() => json(answer));
  const client = new Client({ fetch: server.fetch });
  client.token = "secret";
  client.name = "tab-7";
  const parameters = { a: { result: "r1", row: 0, column: "value" } };
  expect(await client.query({ statement: "query volume($a)", parameters })).toEqual(answer);
  expect(server.seen).toEqual([
    {
      method: "POST",
      url: "api/query",
      headers: {
        Authorization: "Bearer secret",
        "X-Algebra3d-Client": "tab-7",
        "Content-Type": "application/json",
      },
      body: { statement: "query volume($a)", parameters },
    },
  ]);
});

test("parameters of a path are escaped", async () => {
  const server = fakeServer(() => json({ from: 0, rows: [] }));
  const client = new Client({ fetch: server.fetch });
  await client.cell("r1", 3, "A&B");
  await client.operator("<=");
  expect(server.seen.map((request) => request.url)).toEqual([
    "api/results/r1/cell?row=3&column=A%26B",
    "api/operators/%3C%3D",
  ]);
});

test("shapes are compressed where the network is slower than that", async () => {
  const server = fakeServer(() => new Response("glTF"));
  for (const compressesShapes of [true, false])
    await new Client({ fetch: server.fetch, compressesShapes }).shapes("r1", {
      column: "A",
      from: 0,
      count: 1,
    });
  expect(server.seen.map((request) => request.url)).toEqual([
    "api/results/r1/shapes?column=A&from=0&count=1&encoding=gzip",
    "api/results/r1/shapes?column=A&from=0&count=1",
  ]);
  const hosts = ["localhost", "127.0.0.1", "127.9.8.7", "[::1]", "parts.example", "10.0.0.1", "127.example"];
  expect(hosts.filter(isLoopback)).toEqual(hosts.slice(0, 4));
});

test("an error of the server keeps its code, place and remedy", async () => {
  const error = {
    code: "unknown_name",
    message: "unknown name 'Part'",
    remedy: "Check it.",
    line: 1,
    column: 7,
  };
  const client = new Client({ fetch: fakeServer(() => json({ error }, 422)).fetch });
  const failure = await client.query({ statement: "query Part" }).catch((reason: unknown) => reason);
  expect(failure).toBeInstanceOf(ApiError);
  expect(failure).toMatchObject({
    status: 422,
    code: "unknown_name",
    message: "unknown name 'Part'",
    remedy: "Check it.",
    place: { line: 1, column: 7 },
  });
});

test("an answer that is not of this API is told with its status and beginning", async () => {
  const client = new Client({
    fetch: fakeServer(() => new Response("<h1>Bad gateway</h1>", { status: 502 })).fetch,
  });
  await expect(client.objects()).rejects.toMatchObject({
    code: "unexpected_answer",
    message: "The server answered with status 502: <h1>Bad gateway</h1>.",
  });
});

test("no answer is ServerGone", async () => {
  const client = new Client({ fetch: () => Promise.reject(new TypeError("Failed to fetch")) });
  await expect(client.objects()).rejects.toBeInstanceOf(ServerGone);
});

test("a stream gives progress and then the value", async () => {
  const progress = { text: "42 % (Parts)", seconds: 3.1 };
  const stream = events(["started", { id: "q-1" }], ["progress", progress], ["result", answer]);
  const client = new Client({ fetch: fakeServer(() => stream).fetch });
  const texts: string[] = [];
  expect(await client.run({ statement: "query 2", id: "q-1" }, (p) => texts.push(p.text))).toEqual(answer);
  expect(texts).toEqual(["42 % (Parts)"]);
});

test.each([
  ["with the member error", { error: { code: "interrupted", message: "interrupted", status: 409 } }],
  ["without it", { code: "interrupted", message: "interrupted", status: 409 }],
])("the error of a stream, %s, is an ApiError", async (_, body) => {
  const client = new Client({ fetch: fakeServer(() => events(["error", body])).fetch });
  await expect(client.run({ statement: "query 2" }, () => undefined)).rejects.toMatchObject({
    code: "interrupted",
    status: 409,
  });
});

test("a stream that ends without a value is ServerGone", async () => {
  const client = new Client({ fetch: fakeServer(() => events(["started", { id: "q-1" }])).fetch });
  await expect(client.run({ statement: "query 2" }, () => undefined)).rejects.toBeInstanceOf(ServerGone);
});

test("dropping a result that is gone is no error, but being refused is", async () => {
  const gone = new Client({
    fetch: fakeServer(() => json({ error: { code: "gone", message: "gone" } }, 410)).fetch,
  });
  await expect(gone.drop("r1")).resolves.toBeUndefined();
  const refused = new Client({
    fetch: fakeServer(() => json({ error: { code: "unauthorized", message: "token" } }, 401)).fetch,
  });
  await expect(refused.drop("r1")).rejects.toMatchObject({ status: 401 });
});

test("the notes of a mesh file are read from its header", async () => {
  const headers = { "X-Algebra3d-Diagnostics": '["exportSTL: rounded by 1e-9"]' };
  const client = new Client({ fetch: fakeServer(() => new Response("solid", { headers })).fetch });
  const { blob, diagnostics } = await client.file("r1", 0, "Solid", "stl");
  expect(await blob.text()).toBe("solid");
  expect(diagnostics).toEqual(["exportSTL: rounded by 1e-9"]);
});

test("an aborted request rejects with an AbortError", async () => {
  const client = new Client({ fetch: fakeServer(() => json([])).fetch });
  await expect(client.query({ statement: "query 1" }, AbortSignal.abort())).rejects.toMatchObject({
    name: "AbortError",
  });
});
