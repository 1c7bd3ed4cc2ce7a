/** The main paths in Firefox. The other tests are those of Chromium. */

import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { Firefox, missingForFirefox } from "./support/firefox";
import { Server } from "./support/server";

if (missingForFirefox)
  console.warn(`firefox.e2e: ${missingForFirefox} is missing; the tests in Firefox were left out`);

describe.skipIf(missingForFirefox !== "")("in Firefox", () => {
  let server: Server;
  let firefox: Firefox;
  const folder = mkdtempSync(join(tmpdir(), "algebra3d-firefox-"));

  beforeAll(async () => {
    server = await Server.start([
      "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
      "let Row = intstream(1, 4) transformstream extend[Solid: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))] consume",
    ]);
    firefox = await Firefox.start();
  });

  afterAll(async () => {
    await firefox.end();
    await server.remove();
    rmSync(folder, { recursive: true });
  });

  beforeEach(async () => {
    await firefox.page.goto("about:blank");
    await firefox.page.goto(server.url);
    await firefox.page.waitForSelector('[aria-label="Connected"]');
  });

  afterEach(() => expect(firefox.errors).toEqual([]));

  test("the first page shows the largest relation", async () => {
    const picture = await firefox.stillScene();
    await firefox.takePicture("firefox-first");
    expect(picture.colors()).toBeGreaterThan(10);
    await firefox.waitForText('[data-testid="start"]', "Row, the largest relation");
  });

  test("a statement is run, its rows are a table, and a click on an object selects its row", async () => {
    await firefox.run("query Row feed head[1] consume");
    await firefox.waitForText('[data-row="0"] [data-column="Elem"]', "1");
    await firefox.stillScene();
    const box = await (await firefox.page.$('[data-testid="scene"]'))?.boundingBox();
    if (!box) throw new Error("the scene has no box");
    await firefox.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await firefox.page.waitForSelector('.table-row[data-row="0"][aria-selected="true"]');
  });

  test("an error is told, and a long statement is stopped", async () => {
    await firefox.run("query Missing");
    await firefox.waitForText('[data-testid="failure"]', "Missing");
    await firefox.write("query intstream(1, 1000000000) transformstream filter[.Elem < 0] count");
    await firefox.begin();
    await firefox.page.locator('[data-testid="stop"]').click();
    await firefox.waitForText('[data-testid="failure"]', "Stopped.");
  });

  test("a section is exact and filled", async () => {
    await firefox.run("query Cube");
    await firefox.stillScene();
    await firefox.page.keyboard.press("Escape");
    await firefox.click("Section plane");
    await firefox.waitForText('[data-testid="section-readout"]', "area 4");
    const isOrange = ([r, g, b]: readonly number[]) => r! > 180 && g! > 80 && g! < 150 && b! < 100;
    expect((await firefox.stillScene()).count(isOrange)).toBeGreaterThan(1000);
    await firefox.takePicture("firefox-section");
  });

  test("a reload keeps what was shown", async () => {
    await firefox.run("query Cube");
    const before = await firefox.stillScene();
    await firefox.page.waitForSelector('.page[data-settled="true"]');
    await firefox.page.reload();
    await firefox.waitForText('[data-testid="result-tab"]', "Cube");
    expect((await firefox.stillScene()).difference(before)).toBeLessThan(0.02);
  });

  test("a file is uploaded, repaired and stored", async () => {
    const path = join(folder, "tip.off");
    // Without its last face.
    writeFileSync(path, "OFF\n4 3 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
    const input = await firefox.page.$('input[data-testid="file-input"]');
    await input?.uploadFile(path);
    await firefox.page.waitForSelector('[data-testid="review"][data-phase="ready"]');
    await firefox.waitForText('[data-testid="review"]', "boundary edges");
    await firefox.click("Store", '[data-testid="review"]');
    await firefox.waitForText('[data-testid="objects"]', "Tip");
  });

  test("the split screen subdivides a mesh", async () => {
    await firefox.click("Compare");
    await firefox.page.select('[data-testid="side-left"] select[aria-label="Mesh of this side"]', "Cube");
    await firefox.waitForText('[data-testid="side-left"] [data-fact="Faces"]', "12");
    await firefox.click("Subdivide", '[data-testid="side-left"]');
    await firefox.waitForText('[data-testid="side-left"] [data-fact="Faces"]', "48");
    expect((await firefox.stillScene('[data-testid="side-left"] .scene-canvas')).colors()).toBeGreaterThan(
      10,
    );
    await firefox.takePicture("firefox-compare");
  });
});
