/**
 * Ends this process when the one that started it is gone, however that ended; with it go the browser and the servers
 * that it has started. Loaded by vitest itself and by its workers.
 */

const starter = process.ppid;
const interval = 500;

setInterval(() => {
  if (process.ppid === starter) return;
  process.emit("exit", 1); // Playwright and the servers end theirs; vitest's workers refuse process.exit.
  process.kill(process.pid, "SIGKILL");
}, interval).unref();

export {};
