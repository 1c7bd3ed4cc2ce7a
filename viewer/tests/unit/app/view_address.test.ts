import { expect, test } from "vitest";

import { fragmentOf, keepLeaving, takeLeaving, viewOfFragment } from "../../../src/app/view_address";
import type { LinkView } from "../../../src/state/permalink";

function tabStorage(): Storage {
  const values = new Map<string, string>();
  return {
    get length() {
      return values.size;
    },
    key: (index: number) => [...values.keys()][index] ?? null,
    getItem: (key: string) => values.get(key) ?? null,
    setItem: (key: string, value: string) => void values.set(key, value),
    removeItem: (key: string) => void values.delete(key),
    clear: () => values.clear(),
  };
}

const viewWith = (editor: string): LinkView => ({
  version: 1,
  statements: [],
  active: 0,
  editor,
  scene: null,
});

/** A text that does not become shorter. */
function noise(length: number): string {
  let seed = 1;
  return Array.from({ length }, () =>
    String.fromCharCode(33 + ((seed = (seed * 48271) % 2147483647) % 90)),
  ).join("");
}

test("a short view stands in the fragment, a long one in the storage of the tab", async () => {
  const storage = tabStorage();
  const short = await fragmentOf(viewWith("query Cube"), storage);
  expect(short).toMatch(/^#view=/);
  expect(storage.length).toBe(0);
  const view = viewWith(noise(20_000));
  const long = await fragmentOf(view, storage);
  expect(long.length).toBeLessThan(40);
  expect(await viewOfFragment(long, storage)).toEqual(view);
});

test("the oldest stored views give way, and one that is gone is told", async () => {
  const storage = tabStorage();
  const first = await fragmentOf(viewWith(noise(20_000)), storage);
  await new Promise((resolve) => setTimeout(resolve, 5));
  for (let count = 0; count < 40; count++) await fragmentOf(viewWith(noise(20_000 + count)), storage);
  expect(storage.length).toBe(30);
  await expect(viewOfFragment(first, storage)).rejects.toThrow("kept in another tab");
  expect(await viewOfFragment("#other", storage)).toBeNull();
});

test("a page that is left at once leaves its view for its own address, once", () => {
  const storage = tabStorage();
  keepLeaving("#view=a", viewWith("x"), storage);
  expect(takeLeaving("#view=a", storage)).toEqual(viewWith("x"));
  expect(takeLeaving("#view=a", storage)).toBeNull();
  keepLeaving("#view=a", viewWith("x"), storage);
  expect(takeLeaving("#view=b", storage)).toBeNull();
});

test("without storage a long view is a long fragment", async () => {
  const full = tabStorage();
  full.setItem = () => {
    throw new Error("full");
  };
  const view = viewWith(noise(20_000));
  expect(await viewOfFragment(await fragmentOf(view, full), full)).toEqual(view);
});
