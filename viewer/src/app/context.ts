import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Store } from "../state/store";
import type { Workspace } from "./workspace";

export interface App {
  readonly store: Store;
  readonly workspace: Workspace;
}

export const AppContext = createContext<App | null>(null);

/** The state of the page, and what can be done with it. */
export function useApp(): App {
  const app = useContext(AppContext);
  if (!app) throw new Error("useApp outside of AppContext");
  return app;
}
