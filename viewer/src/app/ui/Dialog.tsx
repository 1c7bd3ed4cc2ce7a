import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

interface Props {
  readonly title: string;
  /** Called when a person closes it with Escape; without it, it stays. */
  readonly onClose?: () => void;
  readonly children: ComponentChildren;
  readonly testId?: string;
}

/** A modal dialog, shown as long as it is rendered; the browser keeps the focus in it. */
export function Dialog({ title, onClose, children, testId }: Props) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const dialog = element.current;
    dialog?.showModal();
    return () => dialog?.close();
  }, []);
  return (
    <dialog
      ref={element}
      class="dialog"
      aria-label={title}
      data-testid={testId}
      onCancel={(event) => {
        event.preventDefault();
        onClose?.();
      }}
    >
      <div class="panel-head">
        <h2 class="panel-title">{title}</h2>
      </div>
      <div class="dialog-body">{children}</div>
    </dialog>
  );
}
