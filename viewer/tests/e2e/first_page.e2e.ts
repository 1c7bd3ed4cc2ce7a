/** What a newcomer sees: the largest relation as a contact sheet, statements to click, and what to do next. */

import { mkdtempSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, expect, test } from "vitest";
import type { Page } from "playwright-core";

import { expectNoErrors, ready, run, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { Server } from "./support/server";

const kParts = [
  "let Few = intstream(1, 3) transformstream extend[Solid: createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))] consume",
  'let Parts = intstream(1, 40) transformstream extend[Name: "part " + num2string(.Elem), Solid: createCylinder(makePoint3D(0, 0, 0), 1 + (.Elem mod 4), 1 + (.Elem mod 7), 24)] consume',
];

let server: Server | undefined;
let browser: Browser | undefined;

async function open(
  statements: readonly string[],
  theme: "dark" | "light" = "light",
  options: readonly string[] = [],
): Promise<Page> {
  server = await Server.start(statements, options);
  browser = await Browser.start({ width: 1280, height: 720, theme });
  const page = await browser.open(server.url, { reducedMotion: "reduce" });
  await ready(page);
  return page;
}

/** The page as if nobody had been there: what was changed in the last half second survives a reload. */
async function reopen(page: Page): Promise<void> {
  await browser!.forget(server!.url);
  await browser!.open(server!.url, { reducedMotion: "reduce" });
  await ready(page);
}

afterEach(async () => {
  expectNoErrors(browser?.errors ?? []);
  await browser?.end();
  await server?.remove();
  server = browser = undefined;
});

test.each(["light", "dark"] as const)(
  "the first page shows the parts of the largest relation (%s)",
  async (theme) => {
    const page = await open(kParts, theme);
    await page.getByTestId("result-tab").waitFor();
    const sheet = await stillScene(page);
    await takePicture(page, `first-page-${theme}`);
    expect(sheet.colors()).toBeGreaterThan(20);
    expect(await page.getByTestId("start").innerText()).toContain("Parts, the largest relation");
    expect(await page.getByTestId("table").getAttribute("aria-rowcount")).toBe("41");
    // What a person runs stands in its place, as it lies in space.
    await run(page, "query Few");
    expect(await page.getByTestId("result-tab").count()).toBe(1);
    expect(await page.getByTestId("start").count()).toBe(0);
    await stillScene(page);
    await page.reload();
    await ready(page);
    expect(await page.getByTestId("result-tab").innerText()).toContain("Few");
  },
);

test("each example can be clicked, and stands in the editor then", async () => {
  const page = await open(kParts);
  for (const place of [0, 1, 2]) {
    await reopen(page);
    const start = page.getByTestId("start");
    const example = start.getByRole("listitem").nth(place).getByRole("button");
    const statement = await example.getAttribute("title");
    await example.click();
    await start.waitFor({ state: "detached" });
    expect(await page.locator(".cm-content").innerText()).toBe(`${statement};`);
    expect(await page.getByTestId("failure").count()).toBe(0);
  }
});

test("an empty database says so and offers a sample, which is stored by a click", async () => {
  const page = await open([], "dark");
  const start = page.getByTestId("start");
  await start.waitFor();
  expect(await start.innerText()).toContain("scratch.db is empty");
  await takePicture(page, "first-page-empty");
  await start.getByRole("button", { name: "Store a sample" }).click();
  await page.getByTestId("objects").getByText("Sample").waitFor();
  for (const name of ["The volume of Sample", "turned by 30", "as a mesh"]) {
    await reopen(page);
    await start.getByRole("button", { name }).click();
    await page.getByTestId("result-tab").waitFor();
    expect(await page.getByTestId("failure").count()).toBe(0);
  }
});

test("Run with an empty editor says what to do", async () => {
  const page = await open(["let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))"]);
  await page.getByTestId("run").click();
  expect(await page.getByTestId("failure").innerText()).toMatch(/The editor is empty[\s\S]*query Cube/);
  await takePicture(page, "first-page-run");
});

test("the tour goes through the page and can be left", async () => {
  const page = await open(kParts);
  await page.getByTestId("start").getByRole("button", { name: "Tour" }).click();
  const tour = page.getByTestId("tour");
  expect(await tour.innerText()).toContain("1 of 6");
  await tour.getByRole("button", { name: "Next" }).click();
  await takePicture(page, "tour");
  await tour.getByRole("button", { name: "Leave" }).click();
  await tour.waitFor({ state: "detached" });
  await page.getByTestId("start").getByRole("button", { name: "Tour" }).click();
  for (let stop = 1; stop < 6; stop++) await tour.getByRole("button", { name: "Next" }).click();
  await tour.getByRole("button", { name: "Done" }).click();
  await tour.waitFor({ state: "detached" });
});

test("files that are dropped together are shown together, each with its result, and become a relation", async () => {
  const page = await open([]);
  const folder = mkdtempSync(join(tmpdir(), "algebra3d-drop-"));
  const corners: Readonly<Record<string, string>> = { a: "0 0 0", b: "6 0 0", c: "0 6 0", d: "0 0 6" };
  const facets = ["acb", "abd", "adc", "bcd"].map(
    (names) =>
      `facet normal 0 0 0\nouter loop\n${Array.from(names, (name) => `vertex ${corners[name] ?? ""}`).join("\n")}\nendloop\nendfacet`,
  );
  const text = `solid tip\n${facets.join("\n")}\nendsolid tip\n`;
  mkdirSync(join(folder, "more"));
  const path = (name: string, content = text) => {
    writeFileSync(join(folder, name), content);
    return join(folder, name);
  };
  try {
    await page
      .getByTestId("file-input")
      .setInputFiles([path("one.stl"), path("two.stl", text.replaceAll("6", "9")), path("x.ply", "ply\n")]);
    const ready2 = page.locator('[data-testid="review"][data-phase="ready"]');
    await expect.poll(() => ready2.count(), { timeout: 30_000 }).toBe(2);
    const ply = page.getByRole("region", { name: "x.ply" });
    expect(await ply.innerText()).toMatch(/PLY is not read\. What is: .*STL/);
    await stillScene(page);
    await takePicture(page, "uploads-together");
    for (const name of ["one.stl", "two.stl"]) {
      const card = page.getByRole("region", { name });
      await card.getByRole("button", { name: `Details of ${name}` }).click();
      expect(
        await card.getByRole("button", { name: "Show As it is in 3D" }).getAttribute("aria-pressed"),
      ).toBe("true");
    }
    await stillScene(page);
    await takePicture(page, "uploads-together");
    const all = page.getByTestId("import-all");
    expect(await all.innerText()).toContain("2 files as a relation");
    await all.getByRole("button", { name: "Import" }).click();
    await page.getByTestId("objects").getByText("Parts").waitFor();
    expect(await server!.run("query Parts feed extend[V: volume(.Solid)] sum[V]")).toMatchObject({
      value: 157.5,
    });
    expect(await server!.run("query Parts feed filter[.Name = 'two'] count")).toMatchObject({ value: 1 });
  } finally {
    rmSync(folder, { recursive: true });
  }
});
