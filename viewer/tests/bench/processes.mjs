// The processes that a process started, by /proc of Linux.
import { readFileSync, readdirSync } from "node:fs";

/** Of /proc/stat: the kernel counts in hundredths of a second on every machine that people use. */
const kTicks = 100;

/** Numbers of all descendants of a process whose command line has `word`. */
export function processesOf(root, word = "") {
  const children = new Map();
  for (const entry of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    const parent = parentOf(entry);
    children.set(parent, [...(children.get(parent) ?? []), Number(entry)]);
  }
  const found = [];
  const waiting = [root];
  while (waiting.length > 0) {
    const next = children.get(waiting.pop()) ?? [];
    found.push(...next);
    waiting.push(...next);
  }
  return found.filter((id) => read(`/proc/${id}/cmdline`).includes(word));
}

/** Memory of a process in bytes, what it shares with others divided by their number; 0 if it has ended. */
export function ownBytes(id) {
  return 1024 * Number(/Pss:\s+(\d+)/.exec(read(`/proc/${id}/smaps_rollup`))?.[1] ?? 0);
}

/** Processor seconds of a process so far; 0 if it has ended. */
export function processorSeconds(id) {
  const fields = statOf(id);
  return (Number(fields[11] ?? 0) + Number(fields[12] ?? 0)) / kTicks;
}

/** Processor seconds of all that runs on the machine so far. */
export function machineSeconds() {
  const [user, nice, system, , , irq, softirq] = read("/proc/stat")
    .split("\n")[0]
    .split(/\s+/)
    .slice(1)
    .map(Number);
  return (user + nice + system + irq + softirq) / kTicks;
}

function parentOf(id) {
  return Number(statOf(id)[1]);
}

/** The fields of /proc/ID/stat from the state on. */
function statOf(id) {
  const line = read(`/proc/${id}/stat`);
  // The name before it is in brackets and may have any characters.
  return line.slice(line.lastIndexOf(")") + 2).split(" ");
}

function read(path) {
  try {
    return readFileSync(path, "utf8");
  } catch {
    return "";
  }
}
