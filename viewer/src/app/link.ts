import { signal } from "@preact/signals";
import { isHarmless } from "../state/link_consent";
import { titleOf, type Outcome } from "../state/outcome";
import { encodeView, type LinkStatement, type LinkView } from "../state/permalink";
import type { App } from "./context";
import { knownOutcomes, restoreView, statementsToRun, viewOf } from "./page_view";
import { linkPrefix } from "./view_address";

/** A view that waits for a person's consent, because it has statements that were never run in this browser. */
export interface PendingView {
  readonly view: LinkView;
  readonly known: readonly (Outcome | null)[];
  readonly statements: readonly LinkStatement[];
}

export const pendingView = signal<PendingView | null>(null);

/** Puts a link to the present view into the address and the clipboard. */
export async function copyLink(app: App): Promise<void> {
  const { notices } = app.store;
  const { view, left } = viewOf(app, false);
  const link = new URL(location.href);
  link.hash = linkPrefix + (await encodeView(view));
  const detail = left.length ? `Without ${left.map(({ statement }) => titleOf(statement)).join(", ")}.` : "";
  try {
    await navigator.clipboard.writeText(link.href);
    notices.add("success", "The link to this view is copied.", { detail });
  } catch {
    history.replaceState(null, "", link);
    notices.add("info", "The address of this page is now the link to this view.", { detail });
  }
}

/** Brings the page to a view, or asks first, since a link may come from anyone. Settles when the page is there or asks. */
export async function openView(app: App, view: LinkView): Promise<void> {
  const known = await knownOutcomes(app, view);
  const statements = statementsToRun(view, known);
  if (statements.every((statement) => isKnownHarmless(app, statement))) await restoreView(app, view, known);
  else pendingView.value = { view, known, statements };
}

function isKnownHarmless({ store: { catalogue, history } }: App, statement: LinkStatement): boolean {
  return isHarmless(statement, {
    objects: catalogue.objects.value,
    operators: catalogue.operators.value,
    knows: (text) => history.knows(text),
  });
}
