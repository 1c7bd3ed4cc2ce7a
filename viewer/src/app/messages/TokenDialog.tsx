import { useState } from "preact/hooks";
import { useApp } from "../context";
import { Dialog } from "../ui/Dialog";

/** Asks for the token of the server if this demands one. */
export function TokenDialog() {
  const { store } = useApp();
  const [token, setToken] = useState("");
  if (store.connection.status.value !== "unauthorized") return null;
  return (
    <Dialog title="Token" testId="token-dialog">
      <form
        class="dialog-body"
        onSubmit={(event) => {
          event.preventDefault();
          void store.useToken(token.trim());
        }}
      >
        <p>
          This server answers only with its token: the content of the file given with{" "}
          <code>--token-file</code>, or of the variable <code>ALGEBRA3D_TOKEN</code>.
        </p>
        {store.tokenRefused.value && <p class="error-text">The server did not accept the token.</p>}
        <input
          class="input"
          type="password"
          autocomplete="off"
          aria-label="Token"
          value={token}
          onInput={(event) => setToken(event.currentTarget.value)}
        />
        <div class="row">
          <span class="grow" />
          <button type="submit" class="btn primary" disabled={!token.trim()}>
            Connect
          </button>
        </div>
      </form>
    </Dialog>
  );
}
