const key = "algebra3d.client";

/** The name by which the server tells this tab from other clients: random, and kept until the tab is closed. */
export function nameOfTab(storage: Pick<Storage, "getItem" | "setItem">): string {
  const kept = storage.getItem(key);
  if (kept) return kept;
  const made = randomName();
  storage.setItem(key, made);
  return made;
}

/** 128 random bits; `crypto.randomUUID` is missing on pages of http that are not on loopback. */
function randomName(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) =>
    byte.toString(16).padStart(2, "0"),
  ).join("");
}
