import { signal } from "@preact/signals";
import { messageOf } from "../api/errors";
import { isQuery, titleOf, type Outcome } from "../state/outcome";
import { decodeView, encodeView, makeView, parametersOf, type LinkView } from "../state/permalink";
import type { App } from "./context";

const prefix = "#view=";

/** A view that waits for a person's consent, because its statements were never run in this browser. */
export const pendingLink = signal<LinkView | null>(null);

/** Puts a link to the present view into the address and the clipboard. */
export async function copyLink({ store, workspace }: App): Promise<void> {
  const { results, notices } = store;
  const { view, left } = makeView(
    results.list.value,
    results.activeKey.value,
    results.selected.value,
    workspace.editor.value?.text ?? "",
    workspace.scene.value?.toJSON() ?? null,
  );
  const hash = prefix + (await encodeView(view));
  history.replaceState(null, "", hash);
  const detail = left.length ? `Without ${left.map(({ statement }) => titleOf(statement)).join(", ")}.` : "";
  try {
    await navigator.clipboard.writeText(location.href);
    notices.add("success", "The link to this view is copied.", { detail });
  } catch {
    notices.add("info", "The address of this page is now the link to this view.", { detail });
  }
}

/** Restores the view of a link. Statements that were never run here wait for consent, since a link may come from anyone. */
export async function openLink(app: App, hash: string): Promise<void> {
  if (!hash.startsWith(prefix)) return;
  let view: LinkView;
  try {
    view = await decodeView(hash.slice(prefix.length));
  } catch (error) {
    app.store.notices.add("error", messageOf(error));
    return;
  }
  if (view.statements.every(({ text }) => isHarmless(app, text))) await restoreView(app, view);
  else pendingLink.value = view;
}

/** A query that a person has run here before, or that only shows an object. */
function isHarmless({ store }: App, text: string): boolean {
  const name = /^\s*query\s+`?(\w+)`?\s*$/.exec(text)?.[1];
  if (name && store.catalogue.objects.value.some((object) => object.name === name)) return true;
  return isQuery(text) && store.history.knows(text);
}

/** Runs the statements of a view and brings back what was shown. */
export async function restoreView({ store, workspace }: App, view: LinkView): Promise<void> {
  const { results } = store;
  pendingLink.value = null;
  results.closeAll();
  if (view.editor) workspace.editor.value?.setText(view.editor);
  const outcomes: (Outcome | null)[] = [];
  for (const statement of view.statements) {
    const ids = outcomes.map((outcome) => outcome?.resultId ?? null);
    outcomes.push(await store.run(statement.text, { parameters: parametersOf(statement, ids) }));
  }
  outcomes.forEach((outcome, index) => {
    if (outcome) outcome.shown.value = new Set(view.statements[index]?.shown ?? []);
  });
  const active = outcomes[view.active];
  if (active) results.activeKey.value = active.key;
  const [place, row, column] = view.selected ?? [];
  const result = place === undefined ? null : outcomes[place]?.resultId;
  if (result && row !== undefined) results.selected.value = { result, row, column: column ?? null };
  const ignored = view.scene === null ? [] : (workspace.scene.value?.restore(view.scene) ?? []);
  if (ignored.length)
    store.notices.add("info", "Parts of the view are unknown here.", { detail: ignored.join(", ") });
}
