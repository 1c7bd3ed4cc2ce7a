import { options, render } from "preact";
import { Client, isLoopback } from "./api/client";
import { nameOfTab } from "./api/tab_name";
import { takeToken } from "./api/token";
import { Page } from "./app/Page";
import { ViewKeeper } from "./app/view_keeper";
import { Workspace } from "./app/workspace";
import { siteStorage, tabStorage } from "./state/page_storage";
import { Store } from "./state/store";
import { makeTheme } from "./state/theme";

// Effects run before the next event, not after the next frame: a key or press that follows a change at once must find the
// listeners and tools of the new state, also where a frame takes long.
options.requestAnimationFrame = queueMicrotask;

const client = new Client({ compressesShapes: !isLoopback(location.hostname) });
client.name = nameOfTab(tabStorage);
client.token = takeToken({
  hash: location.hash,
  storage: tabStorage,
  replaceHash: (hash) => history.replaceState(null, "", `${location.pathname}${location.search}${hash}`),
});
const store = new Store(client, makeTheme(siteStorage), siteStorage, tabStorage);
const workspace = new Workspace(store);
const root = document.getElementById("app");
if (!root) throw new Error("index.html has no element #app.");
const app = { store, workspace };
const keeper = new ViewKeeper(app);
render(<Page app={app} keeper={keeper} />, root);
void store.connection.check();
void store.loaded.then(() => keeper.start());
addEventListener("focus", () => void store.refreshObjects());
