import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Store } from "../state/store";
import type { ViewKeeper } from "./view_keeper";
import type { Workspace } from "./workspace";

export interface App {
  readonly store: Store;
  readonly workspace: Workspace;
}

/** Undoing and redoing what was changed on the page. */
export const KeeperContext = createContext<ViewKeeper | null>(null);

export function useKeeper(): ViewKeeper {
  const keeper = useContext(KeeperContext);
  if (!keeper) throw new Error("useKeeper outside of KeeperContext");
  return keeper;
}

export const AppContext = createContext<App | null>(null);

/** The state of the page, and what can be done with it. */
export function useApp(): App {
  const app = useContext(AppContext);
  if (!app) throw new Error("useApp outside of AppContext");
  return app;
}
