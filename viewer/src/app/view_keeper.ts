/**
 * Follows the page: its view goes into the address, so that a reload and Back lose nothing, and into the list from which
 * changes are undone.
 */

import { effect, signal, type ReadonlySignal } from "@preact/signals";
import { messageOf } from "../api/errors";
import { tabStorage } from "../state/page_storage";
import type { LinkView } from "../state/permalink";
import { ViewHistory } from "../state/view_history";
import type { App } from "./context";
import { openView, pendingView } from "./link";
import { viewOf } from "./page_view";
import { fragmentOf, keepLeaving, takeLeaving, viewOfFragment } from "./view_address";

/** Milliseconds of rest after which a change counts as made. */
const restTime = 500;

export class ViewKeeper {
  readonly canUndo: ReadonlySignal<boolean>;
  readonly canRedo: ReadonlySignal<boolean>;
  /** The address has the present view: for tests of the page. */
  readonly settled = signal(false);
  readonly #app: App;
  readonly #history = new ViewHistory();
  /** The page is being brought to a view: what changes meanwhile is not a change of a person. */
  #restoring = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** The fragment that this page has written. */
  #fragment = "";

  constructor(app: App) {
    this.#app = app;
    this.canUndo = this.#history.canUndo;
    this.canRedo = this.#history.canRedo;
  }

  /** Brings the page to the view of its address, and follows it from then on. */
  async start(): Promise<void> {
    const left = takeLeaving(location.hash, tabStorage);
    if (left) await this.#open(left, location.hash);
    else await this.#openAddress();
    if (this.#fragment === "") await this.#showFirst();
    addEventListener("hashchange", () => void this.#openAddress());
    addEventListener("pagehide", () => this.#leave());
    const { workspace } = this.#app;
    effect(() => {
      void viewOf(this.#app, true);
      this.#changed();
    });
    for (const scene of [workspace.scene, workspace.sideScenes.left, workspace.sideScenes.right])
      effect(() => scene.value?.view.on("state", () => this.#changed()));
  }

  async undo(): Promise<void> {
    await this.#travel(() => this.#history.undo());
  }

  async redo(): Promise<void> {
    await this.#travel(() => this.#history.redo());
  }

  /** An address without a view: the contact sheet of the largest relation. */
  async #showFirst(): Promise<void> {
    const { store, workspace } = this.#app;
    await store.preview();
    if (store.results.list.value.some(({ isPreview }) => isPreview))
      workspace.scene.value?.view.update({ display: { arrangement: "grid" } });
  }

  #changed(): void {
    if (this.#restoring) return;
    this.settled.value = false;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#settle(), restTime);
  }

  /** The page rests: its view is written down. */
  async #settle(): Promise<void> {
    clearTimeout(this.#timer);
    if (this.#restoring || pendingView.value) return;
    if (this.#isArriving()) {
      this.#changed();
      return;
    }
    const { view } = viewOf(this.#app, true);
    const before = this.#history.present;
    if (this.#history.record(view)) await this.#write(view, before !== null && isNewPlace(before, view));
    this.settled.value = true;
  }

  /** The first shapes of something come: the camera follows them. */
  #isArriving(): boolean {
    const { scene, sideScenes } = this.#app.workspace;
    return [scene, sideScenes.left, sideScenes.right].some((each) =>
      each.value?.view.progress.some(({ phase, rowsLoaded }) => phase === "coarse" && rowsLoaded > 0),
    );
  }

  async #write(view: LinkView, isNew: boolean): Promise<void> {
    const fragment = await fragmentOf(view, tabStorage);
    if (fragment === this.#fragment) return;
    this.#fragment = fragment;
    if (isNew) history.pushState(null, "", fragment);
    else history.replaceState(null, "", fragment);
  }

  /** Goes to the view of the address, unless it is the one that was written there. */
  async #openAddress(): Promise<void> {
    const { hash } = location;
    if (hash === this.#fragment) return;
    let view: LinkView | null;
    try {
      view = await viewOfFragment(hash, tabStorage);
    } catch (error) {
      this.#app.store.notices.add("error", messageOf(error));
      return;
    }
    if (view) await this.#open(view, hash);
  }

  async #open(view: LinkView, hash: string): Promise<void> {
    this.#fragment = hash;
    await this.#restore(view);
    if (pendingView.value) return;
    const { view: now } = viewOf(this.#app, true);
    this.#history.record(now);
    await this.#write(now, false);
    this.settled.value = true;
  }

  /** What was changed in the last half second is not in the address yet. */
  #leave(): void {
    if (!this.settled.value && !this.#restoring && !pendingView.value)
      keepLeaving(location.hash, viewOf(this.#app, true).view, tabStorage);
  }

  async #travel(step: () => LinkView | null): Promise<void> {
    if (this.#restoring) return;
    await this.#settle();
    const view = step();
    if (!view) return;
    await this.#restore(view);
    // Results that were made since stay beside those of the view.
    const { view: now } = viewOf(this.#app, true);
    this.#history.amend(now);
    await this.#write(now, false);
    this.settled.value = true;
  }

  async #restore(view: LinkView): Promise<void> {
    this.#restoring = true;
    try {
      await openView(this.#app, view);
    } finally {
      this.#restoring = false;
    }
  }
}

/** Whether a view is another place to come back to: something was run, or the scene or the panels changed. */
function isNewPlace(before: LinkView, view: LinkView): boolean {
  const placeOf = ({ statements, compare, layout }: LinkView) =>
    JSON.stringify([statements.map(({ text, shown }) => [text, shown]), compare !== undefined, layout]);
  return placeOf(before) !== placeOf(view);
}
