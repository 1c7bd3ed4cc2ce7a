import { defineConfig } from "vite";

/** Address of a running `algebra3d serve`, for `npm run dev`. */
const server = process.env["ALGEBRA3D_URL"] ?? "http://127.0.0.1:8737";

export default defineConfig({
  base: "./",
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  build: {
    target: "es2022",
    outDir: "dist",
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1500,
    rollupOptions: {
      output: {
        manualChunks: (id) => {
          if (id.includes("node_modules/three")) return "three";
          if (id.includes("codemirror") || id.includes("@lezer")) return "editor";
          return undefined;
        },
      },
    },
  },
  server: {
    proxy: {
      "/api": {
        target: server,
        changeOrigin: true,
        // The server accepts only its own origin.
        headers: { origin: server },
      },
    },
  },
});
