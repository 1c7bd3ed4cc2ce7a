import { useEffect, useState } from "preact/hooks";
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
        are kept; start <code>algebra3d serve</code> again to go on. <NextTry at={connection.nextTry.value} />
      </span>
      <button type="button" class="btn" onClick={() => void connection.check()}>
        Try now
      </button>
    </div>
  );
}

/** Counts down to the next attempt. */
function NextTry({ at }: { at: number | null }) {
  const [, tick] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => tick((count) => count + 1), 500);
    return () => clearInterval(timer);
  }, []);
  if (at === null) return <span class="muted">Trying…</span>;
  return <span class="muted">Next attempt in {Math.max(0, Math.ceil((at - Date.now()) / 1000))} s.</span>;
}
