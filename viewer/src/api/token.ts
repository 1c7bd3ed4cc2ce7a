const key = "algebra3d.token";

/** What `rememberToken` needs of a page, so that it can be tested without one. */
export interface TokenPlace {
  readonly hash: string;
  readonly storage: Pick<Storage, "getItem" | "setItem" | "removeItem">;
  /** Replaces the fragment of the address, so that the token is neither shown nor kept in the history. */
  replaceHash(hash: string): void;
}

/** The token from `#token=...`, which is moved from the address to the storage of this tab, or the one kept there; else "". */
export function takeToken(place: TokenPlace): string {
  const parts = place.hash.replace(/^#/, "").split("&");
  const given = parts.find((part) => part.startsWith("token="));
  if (given === undefined) return place.storage.getItem(key) ?? "";
  const token = decodeURIComponent(given.slice("token=".length));
  place.storage.setItem(key, token);
  const others = parts.filter((part) => part !== given).join("&");
  place.replaceHash(others ? `#${others}` : "");
  return token;
}

/** Keeps a token that a person has typed for the life of this tab. */
export function keepToken(token: string, storage: TokenPlace["storage"]): void {
  if (token) storage.setItem(key, token);
  else storage.removeItem(key);
}
