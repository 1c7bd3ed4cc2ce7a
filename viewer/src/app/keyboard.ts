import { keyName, shortcutOf } from "../scene";
import type { SceneView } from "../scene/api";

/**
 * Gives the shortcuts of scenes to the view that `target` names: keys count when a scene has the focus, or nothing has.
 * Returns what ends this.
 */
export function bindShortcuts(target: () => SceneView | null): () => void {
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.defaultPrevented || !isForScene(event)) return;
    const shortcut = shortcutOf(keyName(event));
    if (shortcut && target()?.act(shortcut.action)) event.preventDefault();
  };
  addEventListener("keydown", onKeyDown);
  return () => removeEventListener("keydown", onKeyDown);
}

function isForScene(event: KeyboardEvent): boolean {
  if (document.querySelector("dialog[open]")) return false;
  const element = event.target;
  return (
    element === document.body || (element instanceof Element && element.closest(".scene-canvas") !== null)
  );
}
