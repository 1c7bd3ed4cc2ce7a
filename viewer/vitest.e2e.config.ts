import { defineConfig } from "vitest/config";

import "./tests/e2e/support/end_with_parent";

/** End-to-end tests: one browser at a time; started by tests/e2e/run.mjs, which says where the program is. */
export default defineConfig({
  test: {
    include: ["tests/e2e/**/*.e2e.ts"],
    setupFiles: ["tests/e2e/support/end_with_parent.ts"],
    fileParallelism: false,
    testTimeout: 180_000,
    hookTimeout: 120_000,
  },
});
