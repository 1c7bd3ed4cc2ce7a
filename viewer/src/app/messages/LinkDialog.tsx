import { useApp } from "../context";
import { pendingLink, restoreView, statementsOf } from "../link";
import { Dialog } from "../ui/Dialog";

/** Asks before the statements of a link are run. */
export function LinkDialog() {
  const app = useApp();
  const view = pendingLink.value;
  if (!view) return null;
  const close = () => (pendingLink.value = null);
  return (
    <Dialog title="Open the view of this link?" onClose={close} testId="link-dialog">
      <p>
        It runs these statements, which were not run in this browser before. Run them only if you know where
        the link is from.
      </p>
      <pre class="code-block" tabIndex={0}>
        {statementsOf(view)
          .map((text) => `${text};`)
          .join("\n\n")}
      </pre>
      <div class="row">
        <span class="grow" />
        <button type="button" class="btn" onClick={close}>
          Cancel
        </button>
        <button type="button" class="btn primary" onClick={() => void restoreView(app, view)}>
          Run and show
        </button>
      </div>
    </Dialog>
  );
}
