import { expect, test } from "vitest";
import { ApiError } from "../../../src/api/errors";
import type { Row } from "../../../src/api/types";
import { RowCache } from "../../../src/state/row_cache";

const makeRows = (from: number, count: number): Row[] =>
  Array.from({ length: count }, (_, index) => ({ N: from + index }));

test("the first rows are there, others are read in pages when they are asked for", async () => {
  const asked: [number, number][] = [];
  const cache = new RowCache(1000, makeRows(0, 200), (from, count) => {
    asked.push([from, count]);
    return Promise.resolve({ from, rows: makeRows(from, count) });
  });
  expect(cache.row(199)).toEqual({ N: 199 });
  expect(asked).toEqual([]);
  expect(cache.row(450)).toBeNull();
  expect(cache.row(451)).toBeNull();
  expect(await cache.rowLater(999)).toEqual({ N: 999 });
  expect(cache.row(450)).toEqual({ N: 450 });
  expect(asked).toEqual([[400, 200], [800, 200]]); // prettier-ignore
  expect(cache.changed.value).toBe(2);
});

test("a page that comes in pieces is put together", async () => {
  const cache = new RowCache(150, [], (from) =>
    Promise.resolve({ from, rows: makeRows(from, Math.min(60, 150 - from)) }),
  );
  expect(await cache.rowLater(149)).toEqual({ N: 149 });
});

test("first rows that end in the middle of a page are read again", async () => {
  const cache = new RowCache(300, makeRows(0, 100), (from, count) =>
    Promise.resolve({ from, rows: makeRows(from, count) }),
  );
  expect(cache.row(5)).toBeNull();
  expect(await cache.rowLater(5)).toEqual({ N: 5 });
});

test("a dropped result is a problem that can be tried again", async () => {
  let gone = true;
  const cache = new RowCache(10, [], (from, count) =>
    gone
      ? Promise.reject(new ApiError(410, { code: "gone", message: "result r1 was dropped" }))
      : Promise.resolve({ from, rows: makeRows(from, count) }),
  );
  expect(await cache.rowLater(0)).toBeNull();
  expect(cache.problem.value).toEqual({ gone: true, message: "result r1 was dropped" });
  gone = false;
  expect(await cache.rowLater(0)).toBeNull();
  cache.retry();
  expect(await cache.rowLater(0)).toEqual({ N: 0 });
});

test("a server that sends no rows is not asked for ever", async () => {
  const cache = new RowCache(10, [], (from) => Promise.resolve({ from, rows: [] }));
  expect(await cache.rowLater(3)).toBeNull();
  expect(cache.problem.value?.message).toBe("The server sent no row 0 of 10.");
});

test("pages are dropped when there are too many, but not the first one", async () => {
  let reads = 0;
  const cache = new RowCache(100_000, makeRows(0, 200), (from, count) => {
    reads++;
    return Promise.resolve({ from, rows: makeRows(from, count) });
  });
  for (let row = 200; row < 60_000; row += 200) await cache.rowLater(row);
  expect(cache.row(0)).toEqual({ N: 0 });
  const before = reads;
  await cache.rowLater(200);
  expect(reads).toBe(before + 1);
});
