import { useApp } from "../context";
import { pendingView } from "../link";
import { restoreView } from "../page_view";
import { Dialog } from "../ui/Dialog";

/** Asks before the statements of a link are run. */
export function LinkDialog() {
  const app = useApp();
  const pending = pendingView.value;
  if (!pending) return null;
  const close = () => (pendingView.value = null);
  const open = () => {
    close();
    void restoreView(app, pending.view, pending.known);
  };
  return (
    <Dialog title="Open the view of this link?" onClose={close} testId="link-dialog">
      <p>
        It runs these statements, which were not run in this browser before. Run them only if you know where
        the link is from.
      </p>
      <pre class="code-block" tabIndex={0}>
        {pending.statements.map(({ text }) => `${text};`).join("\n\n")}
      </pre>
      <div class="row">
        <span class="grow" />
        <button type="button" class="btn" onClick={close}>
          Cancel
        </button>
        <button type="button" class="btn primary" onClick={open}>
          Run and show
        </button>
      </div>
    </Dialog>
  );
}
