/** For everyone: no findings of axe-core, the scene within five stops of the Tab key, and told to screen readers. */

import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import type { Page } from "playwright-core";

import { run, stillScene } from "./support/actions";
import { clickAt, openSettings, press } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({
  statements: [
    'let Parts = intstream(1, 12) transformstream extend[Name: "part " + num2string(.Elem), Solid: createCube(makePoint3D(3 * .Elem, 0, 0), makePoint3D(3 * .Elem + 2, 2, 2))] consume',
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
  ],
});

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Findings that are worse than minor, as `rule: elements`. */
async function findings(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    const { violations } = await (
      window as unknown as {
        axe: {
          run: () => Promise<{
            violations: { id: string; impact: string; nodes: { target: string[] }[] }[];
          }>;
        };
      }
    ).axe.run();
    return violations
      .filter(({ impact }) => impact !== "minor")
      .map(
        ({ id, impact, nodes }) =>
          `${impact} ${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`,
      );
  });
}

test.each(["light", "dark"] as const)("axe-core finds nothing above minor (%s)", async (colorScheme) => {
  const { page } = session;
  await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
  expect(await findings(page)).toEqual([]);
  await run(page, "query Parts");
  await stillScene(page);
  await openSettings(page);
  await press(page, "c");
  await press(page, "m");
  await page.getByTestId("cuts").waitFor();
  expect(await findings(page)).toEqual([]);
  await page.getByRole("button", { name: "Compare" }).click();
  await page.getByTestId("compare").waitFor();
  expect(await findings(page)).toEqual([]);
});

test("the scene is within five stops of the Tab key, and the first leads to it", async () => {
  const { page } = session;
  await stillScene(page);
  const isScene = () => page.evaluate(() => document.activeElement?.classList.contains("scene-canvas"));
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  let stops = 0;
  while (!(await isScene()) && stops < 12) {
    await page.keyboard.press("Tab");
    stops++;
  }
  expect(stops).toBeLessThanOrEqual(5);
  await page.reload();
  await stillScene(page);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  expect(await isScene()).toBe(true);
});

test("bars are one stop each, and the arrow keys go through them", async () => {
  const { page } = session;
  await page.getByRole("button", { name: "Import" }).focus();
  await page.keyboard.press("ArrowRight");
  expect(await page.evaluate(() => document.activeElement?.getAttribute("aria-label"))).toBe("Compare");
  await page.keyboard.press("End");
  expect(await page.evaluate(() => document.activeElement?.getAttribute("aria-label"))).toBe("Theme");
});

test("the objects of the scene are listed, and what is picked is told", async () => {
  const { page } = session;
  await run(page, "query Parts");
  await stillScene(page);
  const list = page.getByRole("list", { name: "12 objects in the scene" });
  expect(await list.getByRole("listitem").first().innerText()).toContain("part 1, volume3d, 12 triangles");
  await page.locator('[data-row="2"] [data-column="Name"]').click();
  await expect.poll(() => page.getByTestId("announcement").innerText()).toBe("part 3, row 3, is selected.");
  await run(page, "query Cube");
  await stillScene(page);
  await press(page, "v");
  await clickAt(page, 0, 20);
  await expect
    .poll(() => page.getByTestId("tool-readout").getByRole("status").innerText())
    .toMatch(/(Triangle|Vertex) \d+ of row 1, at/);
});
