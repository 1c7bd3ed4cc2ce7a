import { spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { startFront } from "./front";
import { setTimeout as sleep } from "node:timers/promises";

const program = process.env["ALGEBRA3D_PROGRAM"] ?? "";
/** Pages that are shown in place of those in the program. */
const pages = process.env["ALGEBRA3D_PAGES"] ?? "";

/** `algebra3d serve` on a database in a folder of its own. */
export class Server {
  readonly folder: string;
  readonly port: number;
  /** Of the command line; may be changed before `begin`. */
  readonly options: string[];
  readonly #env: NodeJS.ProcessEnv;
  #process: ChildProcess | null = null;
  #front: Awaited<ReturnType<typeof startFront>> | null = null;
  #output = "";

  private constructor(port: number, options: readonly string[], env: Readonly<Record<string, string>>) {
    this.folder = mkdtempSync(join(tmpdir(), "algebra3d-e2e-"));
    this.port = port;
    this.options = [...options];
    this.#env = { ...process.env, ...env };
  }

  /** Starts a server with an empty database and runs `statements`, each of which must succeed. */
  static async start(
    statements: readonly string[] = [],
    options: readonly string[] = [],
    env: Readonly<Record<string, string>> = {},
  ): Promise<Server> {
    const server = new Server(await freePort(), options, env);
    await server.begin();
    if (pages) server.#front = await startFront(pages, server.port);
    for (const statement of statements) await server.run(statement);
    return server;
  }

  /** The address of the page. */
  get url(): string {
    return `http://127.0.0.1:${this.#front?.port ?? this.port}/`;
  }

  /** Starts the program, also again after `end`. */
  async begin(): Promise<void> {
    const creation = this.options.includes("--read-only") ? [] : ["--create"];
    const args = ["serve", "--db", "scratch.db", ...creation, "--port", String(this.port), ...this.options];
    const child = spawn(program, args, { cwd: this.folder, env: this.#env });
    this.#process = child;
    const killed = () => child.kill("SIGKILL");
    process.once("exit", killed);
    child.once("exit", () => process.off("exit", killed));
    child.stdout.on("data", (data: Buffer) => (this.#output += data.toString()));
    child.stderr.on("data", (data: Buffer) => (this.#output += data.toString()));
    for (let attempt = 0; attempt < 200; attempt++) {
      if (child.exitCode !== null) throw new Error(`serve ended with ${child.exitCode}:\n${this.#output}`);
      if (await this.#answers()) return;
      await sleep(50);
    }
    throw new Error(`serve does not answer on ${this.url}:\n${this.#output}`);
  }

  /** Runs a statement by the API, in the name of a client. */
  async run(statement: string, client?: string): Promise<{ value: unknown }> {
    const response = await fetch(`http://127.0.0.1:${this.port}/api/query`, {
      method: "POST",
      headers: { "Content-Type": "application/json", ...(client && { "X-Algebra3d-Client": client }) },
      body: JSON.stringify({ statement }),
    });
    const text = await response.text();
    if (!response.ok) throw new Error(`${statement}\n${response.status} ${text}`);
    return JSON.parse(text) as { value: unknown };
  }

  /** Ends the program, but keeps the database. */
  async end(): Promise<void> {
    const child = this.#process;
    this.#process = null;
    if (child?.exitCode !== null) return;
    const ended = new Promise((resolve) => child.once("exit", resolve));
    child.kill("SIGTERM");
    await Promise.race([ended, sleep(3000).then(() => child.kill("SIGKILL"))]);
  }

  async remove(): Promise<void> {
    await this.end();
    this.#front?.end();
    rmSync(this.folder, { recursive: true, force: true });
  }

  async #answers(): Promise<boolean> {
    try {
      const response = await fetch(`http://127.0.0.1:${this.port}/api/server`);
      // With a token it answers 401.
      return response.ok || response.status === 401;
    } catch {
      return false;
    }
  }
}

function freePort(): Promise<number> {
  return new Promise((resolve, reject) => {
    const probe = createServer();
    probe.once("error", reject);
    probe.listen(0, "127.0.0.1", () => {
      const address = probe.address();
      const port = typeof address === "object" && address ? address.port : 0;
      probe.close(() => resolve(port));
    });
  });
}
