/** The split screen with a cube and a ball, for the tests of a file. */

import { afterAll, afterEach, beforeAll, beforeEach, expect } from "vitest";
import type { Page } from "playwright-core";
import { expectNoErrors, ready, stillScene } from "./actions";
import { Browser } from "./browser";
import { Server } from "./server";

export type SideName = "left" | "right";

export const sceneOf = (name: SideName) => `[data-testid="side-${name}"] .scene-canvas`;

export class CompareSession {
  server!: Server;
  browser!: Browser;
  page!: Page;

  constructor() {
    beforeAll(async () => {
      this.server = await Server.start([
        "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
        "let Ball = createSphere(makePoint3D(2, 1, 1), 1, 24)",
      ]);
      this.browser = await Browser.start({ width: 1400, height: 900 });
    });
    afterAll(async () => {
      await this.browser.end();
      await this.server.remove();
    });
    beforeEach(async () => {
      this.page = await this.browser.open(this.server.url);
      await this.page.reload();
      await ready(this.page);
      await this.page.getByRole("button", { name: "Compare" }).click();
    });
    afterEach(() => expectNoErrors(this.browser.errors));
  }

  readonly side = (name: SideName) => this.page.getByTestId(`side-${name}`);

  /** Waits until the steps that made the mesh of a side read like this. */
  readonly expectSteps = async (name: SideName, text: RegExp): Promise<void> => {
    await expect.poll(() => this.stepsOf(name), { timeout: 30_000 }).toMatch(text);
  };

  /** What was done to the mesh of a side up to what is shown: "Cube › subdivide loop". */
  readonly stepsOf = async (name: SideName): Promise<string> => {
    const items = this.side(name).locator('.steps button:not([data-undone="true"])');
    const labels = (await items.allInnerTexts()).map((label) => label.replace(/^\d+\. /, ""));
    const title = await this.side(name).getByTestId("side-title").innerText();
    return labels.length > 0 ? labels.join(" › ") : title;
  };

  readonly load = async (name: SideName, object: string): Promise<void> => {
    await this.side(name).getByLabel("Mesh of this side").selectOption(object);
    await this.expectSteps(name, new RegExp(`(^|› )${object}$`));
    await this.side(name).getByTestId("facts").waitFor();
    await stillScene(this.page, sceneOf(name));
  };

  readonly press = async (name: SideName, button: string): Promise<void> => {
    await this.side(name).getByRole("button", { name: button, exact: true }).click();
  };

  /** Waits until a number of the statistics has a value. */
  readonly expectFact = async (name: SideName, fact: string, value: string): Promise<void> => {
    const place = this.side(name).locator(`[data-fact="${fact}"]`);
    await expect.poll(() => place.innerText(), { timeout: 30_000 }).toBe(value);
  };
}
