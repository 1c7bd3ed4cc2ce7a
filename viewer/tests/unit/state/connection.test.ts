import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Client } from "../../../src/api/client";
import { Connection } from "../../../src/state/connection";
import { json } from "../api/fake_server";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const info = {
  name: "algebra3d",
  version: "1",
  database: "parts.db",
  readOnly: false,
  uploadLimit: 1,
  statementLimit: 1,
};

test("a server that is gone is asked again each second, and its return is told", async () => {
  let up = true;
  let asked = 0;
  const connection = new Connection(
    new Client({
      fetch: () => {
        asked++;
        return up ? Promise.resolve(json(info)) : Promise.reject(new TypeError("Failed to fetch"));
      },
    }),
  );
  let returned = 0;
  connection.onOnline = () => void returned++;
  await connection.check();
  expect([connection.status.value, returned]).toEqual(["online", 1]);
  up = false;
  await vi.advanceTimersByTimeAsync(10_000);
  expect(connection.status.value).toBe("gone");
  asked = 0;
  await vi.advanceTimersByTimeAsync(7_000);
  expect(asked).toBe(7);
  up = true;
  await vi.advanceTimersByTimeAsync(1_000);
  expect([connection.status.value, returned]).toEqual(["online", 2]);
  connection.stop();
});

test("an answer to anything else tells that the server is back", async () => {
  let up = false;
  const client = new Client({
    fetch: () => (up ? Promise.resolve(json(info)) : Promise.reject(new TypeError("Failed to fetch"))),
  });
  const connection = new Connection(client);
  client.onAnswer = () => connection.answered();
  await connection.check();
  expect(connection.status.value).toBe("gone");
  up = true;
  await client.objects();
  await vi.advanceTimersByTimeAsync(0);
  expect(connection.status.value).toBe("online");
  connection.stop();
});

test("without a token nothing is asked until there is one", async () => {
  const refused = () => json({ error: { code: "unauthorized", message: "token needed" } }, 401);
  const client = new Client({
    fetch: (_, init) =>
      Promise.resolve(new Headers(init?.headers).has("Authorization") ? json(info) : refused()),
  });
  const connection = new Connection(client);
  await connection.check();
  expect(connection.status.value).toBe("unauthorized");
  expect(vi.getTimerCount()).toBe(0);
  client.token = "secret";
  await connection.check();
  expect(connection.status.value).toBe("online");
  connection.stop();
});
