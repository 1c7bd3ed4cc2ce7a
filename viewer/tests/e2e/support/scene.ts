/** What tests of the scene have in common: settings by their labels, and counts of pixels. */

import type { Page } from "playwright-core";

import { stillScene } from "./actions";
import type { Picture, Rgb } from "./picture";

export const kScene = '[data-testid="scene"]';

/** A field of the settings of the view, by its label within a part. */
export function field(page: Page, part: string, label: string) {
  return page.getByTestId(`${part}-panel`).getByLabel(label, { exact: true });
}

/** Opens the panel of settings, if it is not open, and all of its parts. */
export async function openSettings(page: Page): Promise<void> {
  const button = page.getByRole("button", { name: "Settings of the view" });
  if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
  await page.locator(".scene-panels details").evaluateAll((parts) => {
    for (const part of parts) (part as HTMLDetailsElement).open = true;
  });
}

export async function setColor(page: Page, part: string, label: string, color: string): Promise<void> {
  await field(page, part, label).fill(color);
}

/** Chooses one of the buttons of a group. */
export async function choose(page: Page, part: string, group: string, title: string): Promise<void> {
  await page
    .getByTestId(`${part}-panel`)
    .getByRole("group", { name: group, exact: true })
    .getByRole("button", { name: title, exact: true })
    .click();
}

/** Presses a shortcut of the scene: the focus must not be in a field. */
export async function press(page: Page, key: string): Promise<void> {
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  await page.keyboard.press(key);
}

/** White background, no axes and scale: every other pixel belongs to an object. */
export async function plainScene(page: Page): Promise<void> {
  await openSettings(page);
  await setColor(page, "appearance", "Background colour", "#ffffff");
  await field(page, "display", "Axes").setChecked(false);
  await field(page, "display", "Scale bar").setChecked(false);
}

/** The front view without perspective, in which sizes are known. */
export async function frontView(page: Page): Promise<void> {
  await choose(page, "navigation", "Projection", "Orthographic");
  await press(page, "1");
  await stillScene(page);
}

export const isWhite = ([r, g, b]: Rgb): boolean => r > 250 && g > 250 && b > 250;
export const isReddish = ([r, g, b]: Rgb): boolean => r > 90 && r > 3 * g && r > 3 * b;
export const isGreenish = ([r, g, b]: Rgb): boolean => g > 90 && g > 2.5 * r && g > 2.5 * b;
export const isBluish = ([r, g, b]: Rgb): boolean => b > 90 && b > 2.5 * r && b > 2.5 * g;
export const isNear =
  (color: Rgb, reach = 12) =>
  (pixel: Rgb): boolean =>
    pixel.every((part, i) => Math.abs(part - color[i]!) <= reach);

/** Pixels that are no background. */
export function covered(picture: Picture): number {
  return picture.count((color) => !isWhite(color));
}

type MouseButton = "left" | "middle" | "right";

/** Drags on the scene by pixels from a place, with one or two buttons and keys held. */
export async function drag(
  page: Page,
  from: readonly [number, number],
  by: readonly [number, number],
  options: {
    readonly button?: MouseButton;
    readonly and?: MouseButton;
    readonly keys?: readonly string[];
  } = {},
): Promise<void> {
  const box = await page.locator(kScene).boundingBox();
  if (!box) throw new Error("the scene has no box");
  const [x, y] = [box.x + from[0], box.y + from[1]];
  for (const key of options.keys ?? []) await page.keyboard.down(key);
  await page.mouse.move(x, y);
  await page.mouse.down({ button: options.button ?? "left" });
  if (options.and) await page.mouse.down({ button: options.and });
  await page.mouse.move(x + by[0] / 2, y + by[1] / 2, { steps: 4 });
  await page.mouse.move(x + by[0], y + by[1], { steps: 4 });
  if (options.and) await page.mouse.up({ button: options.and });
  await page.mouse.up({ button: options.button ?? "left" });
  for (const key of options.keys ?? []) await page.keyboard.up(key);
  await page.mouse.move(2, 2); // so that no coordinates are shown
}

/** Size of the scene in pixels. */
export async function sceneSize(page: Page): Promise<{ width: number; height: number }> {
  const box = await page.locator(kScene).boundingBox();
  if (!box) throw new Error("the scene has no box");
  return box;
}

/** Clicks at a place of the scene, in pixels from its middle. */
export async function clickAt(page: Page, dx: number, dy: number, options = {}): Promise<void> {
  const { width, height } = await sceneSize(page);
  await page.locator(kScene).click({ position: { x: width / 2 + dx, y: height / 2 + dy }, ...options });
}

/** Half the side of a cube in pixels that fills the front view without perspective. */
export function halfSide({ width, height }: { width: number; height: number }): number {
  return Math.min(width, height) / 1.08 / 2;
}
