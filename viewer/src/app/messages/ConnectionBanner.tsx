import { useApp } from "../context";
import { Icon } from "../ui/Icon";

/** A bar below the head while the server does not answer. */
export function ConnectionBanner() {
  const { connection } = useApp().store;
  const status = connection.status.value;
  if (status !== "gone") return null;
  return (
    <div class="banner" role="alert" data-testid="server-gone">
      <Icon name="warning" />
      <span class="grow">
        <strong>The server does not answer.</strong> {connection.reason.value} Your statements and settings
        are kept; start <code>algebra3d serve</code> again to go on.{" "}
        <span class="muted">It is asked each second.</span>
      </span>
      <button type="button" class="btn" onClick={() => void connection.check()}>
        Try now
      </button>
    </div>
  );
}
