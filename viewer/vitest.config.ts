import { defineConfig } from "vitest/config";

/** Unit tests; those that need a document start with `// @vitest-environment jsdom`. */
export default defineConfig({
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  test: { include: ["tests/unit/**/*.test.{ts,tsx}"], maxWorkers: 2, minWorkers: 1 },
});
