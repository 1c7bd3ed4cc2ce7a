/** Nested relations in a table: how many rows a cell has, its rows in place, and its solids in the scene. */

import { expect, test } from "vitest";
import { run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import { isWhite, kScene } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({
  statements: [
    "let Cubes = intstream(1, 5) transformstream projectextend[; Kind: .Elem mod 2, No: .Elem, Solid: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))] consume",
  ],
});

const nest = "query Cubes feed sortby[Kind, No] nest[Kind; Parts]";

const cell = (row: number, column: string) =>
  session.page.locator(`[data-row="${row}"] [data-column="${column}"]`);

/** The texts of a nested table, row by row. */
const rowsOf = (table: string) =>
  session.page
    .locator(`${table} > tbody > tr`)
    .evaluateAll((rows) =>
      rows.map((row) => [...row.children].map((each) => (each as HTMLElement).innerText.trim())),
    );

test("a cell tells the number of its rows and opens in place", async () => {
  await run(session.page, `${nest} consume;`);
  expect(await session.page.getByTestId("table").getAttribute("aria-rowcount")).toBe("3");
  expect(await cell(0, "Parts").innerText()).toBe("2 rows");
  expect(await cell(1, "Parts").innerText()).toBe("3 rows");
  await session.page.locator('[data-row="1"]').getByRole("button", { name: "Open Parts" }).click();
  expect(await session.page.locator(".opened-cell .nested-table th").allInnerTexts()).toEqual([
    "No",
    "Solid",
  ]);
  expect(await rowsOf(".opened-cell > .nested-table")).toEqual([
    ["1", "volume3d, 12 triangles"],
    ["3", "volume3d, 12 triangles"],
    ["5", "volume3d, 12 triangles"],
  ]);
  await stillScene(session.page);
  await takePicture(session.page, "nested-opened");
  await session.page.getByRole("button", { name: "Close Parts" }).first().click();
  expect(await session.page.locator(".opened-cell").count()).toBe(0);
});

test("a relation in a nested relation opens in it", async () => {
  await run(session.page, `${nest} extend[One: 1] nest[One; Kinds] consume;`);
  await session.page.locator('[data-row="0"]').getByRole("button", { name: "Open Kinds" }).click();
  await session.page.locator(".opened-cell summary").first().click();
  expect(await rowsOf(".opened-cell details[open] > .nested-table")).toEqual([
    ["2", "volume3d, 12 triangles"],
    ["4", "volume3d, 12 triangles"],
  ]);
});

test("a nested relation alone is one cell", async () => {
  await run(session.page, `${nest} extract[Parts];`);
  expect(await cell(0, "value").innerText()).toBe("2 rows");
  await session.page.locator('[data-row="0"]').getByRole("button", { name: "Open value" }).click();
  expect((await rowsOf(".opened-cell > .nested-table")).map(([number]) => number)).toEqual(["2", "4"]);
});

test("a long nested relation is a number of tuples, and its list is read when it opens", async () => {
  await run(
    session.page,
    "query intstream(1, 1) transformstream extend[R: intstream(1, 2000) transformstream aconsume] consume;",
  );
  expect(await cell(0, "R").innerText()).toBe("arel, 2,000 tuples");
  await session.page.locator('[data-row="0"]').getByRole("button", { name: "Open R" }).click();
  await expect
    .poll(() => session.page.locator(".opened-cell pre").innerText())
    .toMatch(/^\(\(1\) \(2\) \(3\) .* \(2000\)\)$/);
});

// Five cubes of 2 units with gaps of 1, from 3 to 17: in the front view 10 of 14 units in width.
test("the solids in nested relations are drawn, and a click on one selects its row", async () => {
  await session.show(`${nest} consume;`);
  const picture = await stillScene(session.page);
  const middle = Math.floor(picture.height / 2);
  let runs = 0;
  let isInside = false;
  for (let x = 0; x < picture.width; ++x) {
    const isDrawn = !isWhite(picture.at(x, middle));
    if (isDrawn && !isInside) ++runs;
    isInside = isDrawn;
  }
  expect(runs).toBe(5);
  await takePicture(session.page, "nested-drawn");
  // The middle cube is number 3, of the second row.
  await session.page.locator(kScene).click();
  await expect
    .poll(() => session.page.locator('[role="row"][aria-selected="true"]').getAttribute("data-row"))
    .toBe("1");
});
