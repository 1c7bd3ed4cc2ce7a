/** Contact sheet and exploded picture; what is selected is outlined, and the others are ghosted or hidden. */

import { expect, test } from "vitest";

import { run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import { choose, clickAt, field, openSettings, plainScene, press, setColor } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({
  statements: [
    // Eight blocks in the same place, the n-th of height n.
    'let Stack = intstream(1, 8) transformstream extend[Name: "block " + num2string(.Elem), Height: 9 - .Elem, Solid: createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, .Elem))] consume',
    "let Many = intstream(1, 40) transformstream extend[Solid: createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))] consume",
  ],
});

const isOutline = ([r, g, b]: readonly number[]) => r! > 230 && g! > 130 && g! < 190 && b! < 60;
const isFace = ([r, g, b]: readonly number[]) => b! > r! + 15 && b! < 235 && g! > 60;

/** Into how many pieces of a line of pixels a test divides the picture. */
function pieces(line: readonly boolean[]): number {
  return line.filter((value, index) => value && !line[index - 1]).length;
}

test("on the contact sheet each part has a cell of its own, in the order of a column, and all are seen", async () => {
  const { page } = session;
  await run(page, "query Stack");
  await plainScene(page);
  await stillScene(page);
  await choose(page, "display", "Objects", "Contact sheet");
  const sheet = await stillScene(page);
  await takePicture(page, "sheet-light");
  const columns = Array.from({ length: sheet.width }, (_, x) =>
    Array.from({ length: sheet.height - 60 }, (_, y) => sheet.at(x, y + 60)).some(isFace),
  );
  expect(pieces(columns)).toBeGreaterThanOrEqual(3);
  for (const x of [2, sheet.width - 3]) expect(columns[x]).toBe(false);
  await field(page, "display", "Sorted by").selectOption("Height");
  const other = await stillScene(page);
  expect(other.difference(sheet)).toBeGreaterThan(0.02);
  await field(page, "display", "Largest first").setChecked(true);
  // Height falls with the number of the row, so that the largest first is the order of the rows.
  await expect.poll(async () => (await stillScene(page)).difference(sheet)).toBeLessThan(0.002);
});

test("a measure on the contact sheet is that of the database", async () => {
  const { page } = session;
  await run(page, "query Many");
  await openSettings(page);
  await choose(page, "display", "Objects", "Contact sheet");
  await stillScene(page);
  await press(page, "m");
  await field(page, "measure", "What").selectOption("volume");
  const scene = await stillScene(page);
  // Somewhere inside of one of the objects, below what the tool tells.
  const isInside = (x: number, y: number) => [0, 8].every((by) => isFace(scene.at(x + by, y + by)));
  const places = Array.from({ length: scene.height - 200 }, (_, y) => y + 160).flatMap((y) =>
    Array.from({ length: scene.width - 20 }, (_, x) => [x, y] as const),
  );
  const [x, y] = places.find((place) => isInside(...place))!;
  await clickAt(page, x + 4 - scene.width / 2, y + 4 - scene.height / 2);
  await expect.poll(() => page.getByTestId("measure-value").innerText(), { timeout: 20_000 }).toBe("8");
});

test("the selected object is outlined and keeps its colour, also among others in the same place", async () => {
  const { page } = session;
  await session.show("query Many");
  await choose(page, "appearance", "Edges", "None");
  const before = await stillScene(page);
  await page.locator('[data-row="3"] [data-column="Elem"]').click();
  await page.mouse.move(2, 2);
  const after = await stillScene(page);
  await takePicture(page, "sheet-selected");
  expect(after.count(isOutline)).toBeGreaterThan(300);
  const [x, y] = [Math.round(after.width / 2) + 20, Math.round(after.height / 2) + 40];
  expect(
    after
      .at(x, y)
      .map((part, i) => Math.abs(part - before.at(x, y)[i]!))
      .every((d) => d < 6),
  ).toBe(true);
});

test("the others are ghosted, hidden, and shown again", async () => {
  const { page } = session;
  await session.show("query Stack");
  await choose(page, "appearance", "Edges", "None");
  await choose(page, "display", "Objects", "Contact sheet");
  const solid = (await stillScene(page)).count(isFace);
  await page.locator('[data-row="0"] [data-column="Name"]').click();
  await press(page, "Home");
  await press(page, "Shift+i");
  await page.mouse.move(2, 2);
  const ghosted = await stillScene(page);
  await takePicture(page, "sheet-ghosted");
  expect(ghosted.count(isFace)).toBeLessThan(0.3 * solid);
  const pale = ghosted.count(([r, g, b]) => r > 200 && r < 252 && b >= r && g > 200);
  expect(pale).toBeGreaterThan(0.3 * solid);
  await press(page, "i");
  expect((await stillScene(page)).count(([r, g, b]) => r > 200 && r < 252 && b >= r && g > 200)).toBeLessThan(
    0.1 * pale,
  );
  await press(page, "Shift+h");
  await press(page, "Home");
  expect((await stillScene(page)).count(isFace)).toBeGreaterThan(0.9 * solid);
});

test("edges are seen in both themes, on faces and without them", async () => {
  const { page } = session;
  const contrast = async (): Promise<number> => {
    const picture = await stillScene(page);
    const ground = luminance(picture.at(4, picture.height - 4));
    let most = 1;
    for (let x = 0; x < picture.width; x += 1)
      for (const y of [Math.round(picture.height * 0.45), Math.round(picture.height * 0.6)]) {
        const here = luminance(picture.at(x, y));
        const ratio = (Math.max(here, ground) + 0.05) / (Math.min(here, ground) + 0.05);
        most = Math.max(most, ratio);
      }
    return most;
  };
  for (const scheme of ["light", "dark"] as const) {
    await page.emulateMedia({ colorScheme: scheme, reducedMotion: "reduce" });
    await run(page, "query Stack");
    await stillScene(page);
    await press(page, "w");
    expect(await contrast()).toBeGreaterThan(3);
    await takePicture(page, `wireframe-${scheme}`);
    await press(page, "w");
  }
  await openSettings(page);
  await setColor(page, "appearance", "Edge colour", "#ff0000");
  expect((await stillScene(page)).count(([r, g, b]) => r > 150 && g < 60 && b < 60)).toBeGreaterThan(50);
});

function luminance([r, g, b]: readonly number[]): number {
  const linear = [r!, g!, b!].map((part) => {
    const share = part / 255;
    return share <= 0.03928 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * linear[0]! + 0.7152 * linear[1]! + 0.0722 * linear[2]!;
}
