import { useEffect, useState } from "preact/hooks";

import { keyName, shortcutOf } from "../scene";
import type { SceneView } from "../scene";
import { CheatSheet } from "./CheatSheet";
import { messageOf } from "./hooks";

interface Props {
  readonly view: SceneView;
  /** The name of a picture without its ending. */
  readonly pictureName?: string;
  /** Carries out what concerns the page and not the view. */
  readonly onAction: (action: string) => void;
  readonly onError: (message: string) => void;
}

/** Carries out the shortcuts of the page, and those actions that need the page: screenshots and the cheat sheet. */
export function SceneKeys({ view, pictureName = "algebra3d", onAction, onError }: Props) {
  const [sheet, setSheet] = useState(false);
  useEffect(() => {
    const onKey = (event: KeyboardEvent): void => {
      if (event.defaultPrevented || isTyping(event)) return;
      const shortcut = shortcutOf(keyName(event));
      if (!shortcut) return;
      event.preventDefault();
      view.act(shortcut.action);
    };
    document.addEventListener("keydown", onKey);
    const end = view.on("action", (action) => {
      if (action === "shortcuts") setSheet(true);
      onAction(action);
      if (!action.startsWith("screenshot")) return;
      const transparent = action === "screenshot.transparent";
      view.screenshot({ transparent }).then(
        (picture) => save(picture, `${pictureName}.png`),
        (error: unknown) => onError(messageOf(error)),
      );
    });
    return () => {
      document.removeEventListener("keydown", onKey);
      end();
    };
  }, [view, pictureName]);
  if (!sheet) return null;
  return <CheatSheet onClose={() => setSheet(false)} onAct={(action) => view.act(action)} />;
}

/** Keys that belong to a field, a list, a dialog or an editor do not belong to the scene. */
function isTyping(event: KeyboardEvent): boolean {
  const target = event.target;
  if (!(target instanceof Element)) return false;
  if (
    target.closest(
      "input, textarea, select, [contenteditable], dialog, [role=menu], [role=separator], [role=grid]",
    )
  ) {
    return true;
  }
  if (target.closest(".scene-canvas")) return false;
  // Enter and the arrows work the button, tab or link that has the focus.
  return event.key.length > 1 && target.closest("button, a, summary, [tabindex]") !== null;
}

function save(picture: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(picture);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
