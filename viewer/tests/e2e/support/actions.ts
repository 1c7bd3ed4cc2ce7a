import { expect } from "vitest";
import type { Page } from "playwright-core";
import { readPng, type Picture } from "./picture";

/** Puts a text into the editor, in place of what was there. */
export async function write(page: Page, text: string): Promise<void> {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText(text);
  await page.keyboard.press("Escape");
}

/** Writes a statement, runs it and waits until nothing runs. */
export async function run(page: Page, statement: string): Promise<void> {
  await write(page, statement);
  const ended = () => page.locator(".page").getAttribute("data-ended");
  const before = await ended();
  await page.keyboard.press("Control+Enter");
  await expect.poll(ended, { timeout: 30_000, interval: 50 }).not.toBe(before);
}

/** Waits until the server answers and the lists are there. */
export async function ready(page: Page): Promise<void> {
  await page.getByRole("img", { name: "Connected" }).waitFor();
  await page.getByTestId("editor").locator(".cm-content").waitFor();
}

/** The row of the table that is selected; null if none is. */
export async function selectedRow(page: Page): Promise<number | null> {
  const row = page.locator('.table-row[aria-selected="true"]');
  return (await row.count()) === 0 ? null : Number(await row.getAttribute("data-row"));
}

/** Of scenes whose shapes are on their way, or whose last frame in full quality is not drawn yet. */
const kChangingScene =
  '[data-testid="scene-loading"], [aria-busy="true"] > canvas, canvas[data-drawn="changing"]';

/** The scene after everything is loaded, it stands still, and its last frame is drawn in full quality. */
export async function stillScene(page: Page, selector = '[data-testid="scene"]'): Promise<Picture> {
  const scene = page.locator(selector).first();
  const changing = async () => (await page.locator(kChangingScene).count()) > 0;
  // A screenshot takes longer than a look at the page, and holds up what draws.
  for (let attempt = 0; attempt < 100 && (await changing()); attempt++) await page.waitForTimeout(50);
  let last = await scene.screenshot();
  for (let attempt = 0; attempt < 60; attempt++) {
    await page.waitForTimeout(150);
    const next = await scene.screenshot();
    if (!(await changing()) && next.equals(last)) return readPng(next);
    last = next;
  }
  throw new Error("the scene does not stand still");
}

type Box = Readonly<Record<"x" | "y" | "width" | "height", number>>;

/** Where the first element of a selector stands on the page. */
export async function boxOf(page: Page, selector: string): Promise<Box> {
  const box = await page.locator(selector).first().boundingBox();
  if (!box) throw new Error(`${selector} has no box`);
  return box;
}

/** A click into the middle of the scene. */
export async function clickMiddle(page: Page, selector = '[data-testid="scene"]'): Promise<void> {
  const box = await boxOf(page, selector);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
}

/** Fails with the texts if the page reported errors. */
export function expectNoErrors(errors: readonly string[]): void {
  expect(errors).toEqual([]);
}

/** The link that the button copies. */
export async function copiedLink(page: Page): Promise<string> {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.getByText("The link to this view is copied.").waitFor();
  return page.evaluate(() => navigator.clipboard.readText());
}

/** Waits until the address has the present view. */
export async function settled(page: Page): Promise<void> {
  await page.locator('.page[data-settled="true"]').waitFor();
}
