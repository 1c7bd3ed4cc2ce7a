import { expect, test } from "vitest";

import { copiedLink, ready, run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import { choose, field, frontView, isNear, openSettings, plainScene } from "./support/scene";
import { Session } from "./support/session";

// 64 cubes in a square that is seen from the front: more than a leaf holds.
const session = new Session({
  statements: [
    "let Parts = intstream(1, 64) transformstream extend[Solid: createCube(makePoint3D(.Elem mod 8 * 3, 0, .Elem div 8 * 3), makePoint3D(.Elem mod 8 * 3 + 2, 2, .Elem div 8 * 3 + 2))] consume",
    "let Parts_Solid = Parts creatertree[Solid]",
    "let Other = Parts feed filter[.Elem < 3] consume",
    "let Other_Solid = Other creatertree[Solid]",
  ],
});

const isBox = isNear([224, 128, 58], 40);

test("the boxes of an index are drawn, one level at a time", async () => {
  const { page } = session;
  await run(page, "query Parts");
  await plainScene(page);
  await frontView(page);
  const none = await stillScene(page);
  expect(none.count(isBox)).toBe(0);
  const choice = field(page, "index", "R-tree");
  expect(await choice.locator("option").allInnerTexts()).toEqual([
    "none",
    "Parts_Solid of Parts",
    "Other_Solid of Other",
  ]);
  await choice.selectOption("Parts_Solid");
  const facts = page.getByTestId("index-facts");
  await expect.poll(() => facts.innerText()).toMatch(/^1 node of 2 levels, with \d+ members$/);
  const root = (await stillScene(page)).count(isBox);
  expect(root).toBeGreaterThan(300);
  await field(page, "index", "Level").fill("1");
  await expect.poll(() => facts.innerText()).toMatch(/^\d+ nodes of 2 levels, with 64 members$/);
  const leaves = await stillScene(page);
  await takePicture(page, "index-boxes");
  // The edges of leaves stand between the cubes, too.
  expect(leaves.count(isBox)).toBeGreaterThan(root * 1.3);
  await choice.selectOption("none");
  expect((await stillScene(page)).difference(none)).toBeLessThan(0.001);
});

test("a tree of one leaf has no level to choose", async () => {
  const { page } = session;
  await run(page, "query Other");
  await plainScene(page);
  await choose(page, "appearance", "Edges", "None");
  await field(page, "index", "R-tree").selectOption("Other_Solid");
  await expect
    .poll(() => page.getByTestId("index-facts").innerText())
    .toBe("1 node of 1 level, with 2 members");
  expect(await field(page, "index", "Level").count()).toBe(0);
});

test("a link restores the index, its level and its boxes", async () => {
  const { page, server } = session;
  await run(page, "query Parts");
  await plainScene(page);
  await frontView(page);
  await field(page, "index", "R-tree").selectOption("Parts_Solid");
  await field(page, "index", "Level").fill("1");
  const facts = () => page.getByTestId("index-facts");
  await expect.poll(() => facts().innerText()).toMatch(/^\d+ nodes of 2 levels, with 64 members$/);
  const before = await stillScene(page);
  const link = await copiedLink(page);
  await page.goto(`${server.url}#`);
  await page.reload();
  await ready(page);
  expect(await facts().count()).toBe(0);
  await page.goto(link);
  await page.getByTestId("table").waitFor();
  await openSettings(page);
  await expect.poll(() => facts().innerText()).toMatch(/^\d+ nodes of 2 levels, with 64 members$/);
  expect(await field(page, "index", "R-tree").inputValue()).toBe("Parts_Solid");
  expect(await field(page, "index", "Level").inputValue()).toBe("1");
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.01);
});
