/** A view in the address of the page: in its fragment, or if that would be too long in the storage of the tab. */

import { decodeView, encodeView, type LinkView } from "../state/permalink";

export const linkPrefix = "#view=";
const storedPrefix = "#kept=";
const storageKey = "algebra3d.view.";
/** Bytes of a fragment. */
const longest = 8192;
/** Views in the storage of the tab, of which the oldest give way. */
const mostStored = 30;

type TabStorage = Pick<Storage, "getItem" | "setItem" | "removeItem" | "key" | "length">;

/** The fragment for a view. Without storage a long one is the link itself. */
export async function fragmentOf(view: LinkView, storage: TabStorage): Promise<string> {
  const link = linkPrefix + (await encodeView(view));
  if (link.length <= longest) return link;
  const key = `${Date.now().toString(36)}${Math.random().toString(36).slice(2, 6)}`;
  try {
    forgetOldest(storage);
    storage.setItem(storageKey + key, link);
    return storedPrefix + key;
  } catch {
    return link;
  }
}

/** The view of a fragment; null if it has none. Rejects with a message for people if it cannot be read. */
export async function viewOfFragment(hash: string, storage: TabStorage): Promise<LinkView | null> {
  if (hash.startsWith(linkPrefix)) return decodeView(hash.slice(linkPrefix.length));
  if (!hash.startsWith(storedPrefix)) return null;
  const link = storage.getItem(storageKey + hash.slice(storedPrefix.length));
  if (link === null) throw new Error("The view of this address was kept in another tab, or too long ago.");
  return decodeView(link.slice(linkPrefix.length));
}

const leavingKey = "algebra3d.leaving";

/** Keeps the view of a page that is being left at once: there is no time to pack it into its address. */
export function keepLeaving(hash: string, view: LinkView, storage: TabStorage): void {
  try {
    storage.setItem(leavingKey, JSON.stringify({ hash, view }));
  } catch {
    // The address has the view of half a second ago.
  }
}

/** The view with which the page of an address was left, if that was the last thing that happened in this tab. */
export function takeLeaving(hash: string, storage: TabStorage): LinkView | null {
  const text = storage.getItem(leavingKey);
  storage.removeItem(leavingKey);
  if (text === null) return null;
  const left = JSON.parse(text) as { readonly hash: string; readonly view: LinkView };
  return left.hash === hash ? left.view : null;
}

function forgetOldest(storage: TabStorage): void {
  const keys = Array.from({ length: storage.length }, (_, index) => storage.key(index) ?? "");
  // The keys begin with the time, in numbers of equal length.
  const stored = keys.filter((key) => key.startsWith(storageKey)).sort();
  for (const key of stored.slice(0, Math.max(0, stored.length - mostStored + 1))) storage.removeItem(key);
}
