// npm run e2e -- --program PATH [--pages FOLDER] [--artifacts FOLDER] [--chromium PATH] [--name TEST] [FILE...]
// Runs the end-to-end tests with the given algebra3d and its pages, or with those of a folder such as dist.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { parseArgs } from "node:util";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    program: { type: "string" },
    pages: { type: "string" },
    name: { type: "string" },
    artifacts: { type: "string", default: "tests/e2e/artifacts" },
    chromium: { type: "string", default: "/usr/bin/chromium" },
  },
});
if (!values.program || !existsSync(values.program)) {
  console.error(`e2e: --program PATH of algebra3d is needed, got ${values.program ?? "none"}`);
  process.exit(2);
}
if (!existsSync(values.chromium)) {
  console.error(`e2e: there is no ${values.chromium}; install chromium, or give its place with --chromium`);
  process.exit(2);
}
const vitest = spawn(
  process.execPath,
  [
    "node_modules/vitest/vitest.mjs",
    "run",
    "--config",
    "vitest.e2e.config.ts",
    ...(values.name ? ["-t", values.name] : []),
    ...positionals,
  ],
  {
    stdio: "inherit",
    env: {
      ...process.env,
      ALGEBRA3D_PROGRAM: resolve(values.program),
      ALGEBRA3D_ARTIFACTS: resolve(values.artifacts),
      ALGEBRA3D_PAGES: values.pages ? resolve(values.pages) : "",
      ALGEBRA3D_CHROMIUM: values.chromium,
    },
  },
);
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(signal, () => vitest.kill(signal));
vitest.on("exit", (status) => process.exit(status ?? 1));
