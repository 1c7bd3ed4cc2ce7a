import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium, type BrowserContext, type Page } from "playwright-core";
import { readPng, type Picture } from "./picture";

const flags = [
  "--headless=new",
  "--no-sandbox",
  // Software rendering, which headless Chromium does not take by itself.
  "--enable-unsafe-swiftshader",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  // Text and buttons are drawn faster without it. Not --disable-gpu-compositing, which shows old frames of WebGL.
  "--disable-gpu-rasterization",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  // Else a process draws pages of the browser itself.
  "--disable-features=PreloadTopChromeWebUI",
  "--disable-component-update",
  "--disable-sync",
];

export interface BrowserOptions {
  readonly width?: number;
  readonly height?: number;
  readonly theme?: "dark" | "light";
  readonly touch?: boolean;
  /** Flags that replace those of software rendering, to see a page without WebGL. */
  readonly withoutWebGl?: boolean;
}

/** A browser with a profile of its own, and the errors of its pages. */
export class Browser {
  readonly context: BrowserContext;
  /** Messages of the console of the kind error, and uncaught errors. */
  readonly errors: string[] = [];
  readonly #profile: string;

  private constructor(context: BrowserContext, profile: string) {
    this.context = context;
    this.#profile = profile;
  }

  static async start(options: BrowserOptions = {}): Promise<Browser> {
    const profile = mkdtempSync(join(tmpdir(), "algebra3d-chromium-"));
    const context = await chromium.launchPersistentContext(profile, {
      executablePath: process.env["ALGEBRA3D_CHROMIUM"] ?? "/usr/bin/chromium",
      headless: true,
      viewport: { width: options.width ?? 1280, height: options.height ?? 720 },
      colorScheme: options.theme ?? "dark",
      hasTouch: options.touch ?? false,
      acceptDownloads: true,
      ignoreDefaultArgs: ["--headless"],
      args: options.withoutWebGl
        ? ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-3d-apis", "--disable-sync"]
        : flags,
    });
    context.setDefaultTimeout(60_000);
    const browser = new Browser(context, profile);
    context.on("weberror", (error) => browser.errors.push(String(error.error())));
    context.on("console", (message) => {
      // Answers such as 410 and 422 are for the page, which shows them.
      const refused = message
        .text()
        .startsWith("Failed to load resource: the server responded with a status of 4");
      if (message.type() === "error" && !refused) browser.errors.push(message.text());
    });
    return browser;
  }

  async open(url: string, media: Parameters<Page["emulateMedia"]>[0] = {}): Promise<Page> {
    const page = await this.#firstPage();
    await page.emulateMedia(media);
    await page.goto(url);
    return page;
  }

  /** What pages of this address have stored is forgotten, as if nobody had been there. */
  async forget(url: string): Promise<void> {
    const page = await this.#firstPage();
    await page.goto("about:blank");
    const session = await this.context.newCDPSession(page);
    await session.send("Storage.clearDataForOrigin", {
      origin: new URL(url).origin,
      storageTypes: "local_storage,session_storage,indexeddb",
    });
    await session.detach();
  }

  async #firstPage(): Promise<Page> {
    return this.context.pages()[0] ?? (await this.context.newPage());
  }

  async end(): Promise<void> {
    await this.context.close();
    rmSync(this.#profile, { recursive: true, force: true });
  }
}

/** A picture of the page as a person sees it, kept among the artifacts. */
export async function takePicture(page: Page, name: string): Promise<Picture> {
  const folder = process.env["ALGEBRA3D_ARTIFACTS"] ?? "tests/e2e/artifacts";
  mkdirSync(folder, { recursive: true });
  return readPng(await page.screenshot({ path: join(folder, `${name}.png`) }));
}

/** A picture of one element. */
export async function takeElement(page: Page, selector: string, name: string): Promise<Picture> {
  const folder = process.env["ALGEBRA3D_ARTIFACTS"] ?? "tests/e2e/artifacts";
  mkdirSync(folder, { recursive: true });
  return readPng(
    await page
      .locator(selector)
      .first()
      .screenshot({ path: join(folder, `${name}.png`) }),
  );
}
