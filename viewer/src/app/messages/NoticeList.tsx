import { useApp } from "../context";
import { IconButton } from "../ui/controls";

/** Short messages at the lower edge. */
export function NoticeList() {
  const { notices } = useApp().store;
  return (
    <div class="notices" role="status" aria-live="polite">
      {notices.list.value.map(({ key, kind, text, detail, action }) => (
        <div key={key} class={`notice ${kind}`} data-testid="notice">
          <div class="grow">
            <div>{text}</div>
            {detail && <div class="notice-detail muted">{detail}</div>}
          </div>
          {action && (
            <button
              type="button"
              class="btn small"
              onClick={() => {
                notices.close(key);
                action.run();
              }}
            >
              {action.label}
            </button>
          )}
          <IconButton small icon="close" label="Close" onClick={() => notices.close(key)} />
        </div>
      ))}
    </div>
  );
}
