import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { launch, type Browser, type ElementHandle, type Page } from "puppeteer-core";
import { readPng, type Picture } from "./picture";

const program = process.env["ALGEBRA3D_FIREFOX"] ?? "firefox-esr";

const isThere = (name: string) => spawnSync("sh", ["-c", `command -v ${name}`]).status === 0;

/** What is missing for a test in Firefox; "" if nothing is. Without a display it has no WebGL, so it gets one. */
export const missingForFirefox = [program, "Xvfb"].filter((name) => !isThere(name)).join(" and ");

/** Firefox on a display of its own, driven by WebDriver BiDi. */
export class Firefox {
  readonly page: Page;
  /** Messages of the console of the kind error, and uncaught errors. */
  readonly errors: string[] = [];
  readonly #browser: Browser;
  readonly #display: ChildProcess;

  private constructor(browser: Browser, page: Page, display: ChildProcess) {
    this.#browser = browser;
    this.page = page;
    this.#display = display;
    page.on("pageerror", (error) => this.errors.push(String(error)));
    page.on("console", (message) => message.type() === "error" && this.errors.push(message.text()));
  }

  static async start(): Promise<Firefox> {
    const display = spawn("Xvfb", ["-displayfd", "1", "-screen", "0", "1400x900x24", "-nolisten", "tcp"]);
    process.once("exit", () => display.kill("SIGKILL"));
    const number = await firstLine(display);
    const browser = await launch({
      browser: "firefox",
      executablePath: spawnSync("sh", ["-c", `command -v ${program}`], { encoding: "utf8" }).stdout.trim(),
      headless: false,
      env: { ...process.env, DISPLAY: `:${number}` },
      // The graphics of the display are those of the processor.
      extraPrefsFirefox: { "webgl.force-enabled": true, "ui.prefersReducedMotion": 1 },
      protocolTimeout: 120_000,
    });
    const page = (await browser.pages())[0] ?? (await browser.newPage());
    await page.setViewport({ width: 1280, height: 720 });
    page.setDefaultTimeout(60_000);
    return new Firefox(browser, page, display);
  }

  async end(): Promise<void> {
    await this.#browser.close();
    this.#display.kill();
  }

  /** Waits until everything is loaded and drawn, and takes a picture of the scene. */
  async stillScene(selector = '[data-testid="scene"]'): Promise<Picture> {
    const changing =
      '[data-testid="scene-loading"], [aria-busy="true"] > canvas, canvas[data-drawn="changing"]';
    const scene = await this.page.waitForSelector(selector);
    if (!scene) throw new Error(`${selector} is not on the page`);
    let last: Uint8Array | null = null;
    for (let attempt = 0; attempt < 100; attempt++) {
      await this.page.waitForFunction((busy) => !document.querySelector(busy), {}, changing);
      const next: Uint8Array = await scene.screenshot();
      if (last && Buffer.from(next).equals(last)) return readPng(Buffer.from(next));
      last = next;
    }
    throw new Error("the scene does not stand still");
  }

  async takePicture(name: string): Promise<void> {
    const folder = process.env["ALGEBRA3D_ARTIFACTS"] ?? "tests/e2e/artifacts";
    mkdirSync(folder, { recursive: true });
    await this.page.screenshot({ path: join(folder, `${name}.png`) });
  }

  /** Writes a statement into the editor and runs it, and waits until it has ended. */
  async run(statement: string): Promise<void> {
    await this.write(statement);
    const ended = () => this.page.$eval(".page", (page) => page.getAttribute("data-ended"));
    const before = await ended();
    await this.#pressWith("Control", "Enter");
    await this.page.waitForFunction(
      (old) => document.querySelector(".page")?.getAttribute("data-ended") !== old,
      {},
      before,
    );
  }

  async write(statement: string): Promise<void> {
    await this.page.click(".cm-content");
    await this.#pressWith("Control", "a");
    await this.page.keyboard.type(statement);
    await this.page.keyboard.press("Escape");
  }

  /** Runs what is in the editor, without waiting. */
  async begin(): Promise<void> {
    await this.#pressWith("Control", "Enter");
  }

  async #pressWith(modifier: "Control", key: "a" | "Enter"): Promise<void> {
    await this.page.keyboard.down(modifier);
    await this.page.keyboard.press(key);
    await this.page.keyboard.up(modifier);
  }

  /** Clicks on the first button that is seen and has this name. */
  async click(name: string, within = "body"): Promise<void> {
    const button = await this.page.waitForFunction(
      (place, wanted) =>
        [...document.querySelectorAll<HTMLElement>(`${place} button`)].find(
          (each) =>
            (each.getAttribute("aria-label") ?? each.innerText).trim() === wanted &&
            each.getClientRects().length > 0,
        ),
      {},
      within,
      name,
    );
    await (button as ElementHandle<HTMLElement>).click();
  }

  /** Waits for a text within an element. */
  async waitForText(selector: string, text: string): Promise<void> {
    await this.page.waitForFunction(
      (place, wanted) =>
        [...document.querySelectorAll<HTMLElement>(place)].some(({ innerText }) =>
          innerText.includes(wanted),
        ),
      {},
      selector,
      text,
    );
  }
}

function firstLine(child: ChildProcess): Promise<string> {
  return new Promise((resolve, reject) => {
    child.once("error", reject);
    child.once("exit", (status) => reject(new Error(`Xvfb ended with ${status}`)));
    child.stdout?.once("data", (data: Buffer) => resolve(data.toString().trim()));
  });
}
