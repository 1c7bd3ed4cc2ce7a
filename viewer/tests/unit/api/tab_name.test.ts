import { expect, test } from "vitest";
import { nameOfTab } from "../../../src/api/tab_name";
import { usable } from "../../../src/state/page_storage";

test("a tab keeps its name, and another has another", () => {
  const [one, other] = [0, 1].map(() => usable(() => null as unknown as Storage)) as [Storage, Storage];
  const name = nameOfTab(one);
  expect(name).toMatch(/^[0-9a-f]{32}$/);
  expect(nameOfTab(one)).toBe(name);
  expect(nameOfTab(other)).not.toBe(name);
});
