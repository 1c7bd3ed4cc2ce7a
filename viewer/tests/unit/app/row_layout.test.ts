import { expect, test } from "vitest";
import { RowLayout } from "../../../src/app/table/row_layout";

test("rows lie one below the other, opened ones have a part below them", () => {
  const layout = new RowLayout(100, 28, new Map([[3, 220]]));
  expect(layout.height).toBe(100 * 28 + 220);
  expect([layout.topOf(3), layout.topOf(4)]).toEqual([84, 84 + 28 + 220]);
  expect([layout.rowAt(0), layout.rowAt(83), layout.rowAt(84), layout.rowAt(331), layout.rowAt(332)]).toEqual(
    [0, 2, 3, 3, 4],
  );
  expect(layout.rowAt(1e9)).toBe(99);
  expect(new RowLayout(0, 28).rowAt(0)).toBe(0);
});

test("a short table is scrolled as it is", () => {
  const layout = new RowLayout(1000, 28);
  expect(layout.offsetOfScroll(500, 300)).toBe(500);
  expect(layout.scrollOfOffset(500, 300)).toBe(500);
});

test("ten million rows are scrolled by a factor, and both ends are reached", () => {
  const layout = new RowLayout(10_000_000, 28);
  const end = layout.scrollHeight - 300;
  expect(layout.scrollHeight).toBeLessThanOrEqual(12_000_000);
  expect(layout.offsetOfScroll(0, 300)).toBe(0);
  expect(layout.offsetOfScroll(end, 300)).toBeCloseTo(layout.height - 300, 3);
  expect(layout.rowAt(layout.offsetOfScroll(end, 300) + 299)).toBe(9_999_999);
  const offset = layout.topOf(7_654_321);
  expect(layout.offsetOfScroll(layout.scrollOfOffset(offset, 300), 300)).toBeCloseTo(offset, 3);
});
