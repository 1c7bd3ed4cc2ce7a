/** The colours of the page that the scene takes over, from the custom properties of styles/tokens.css. */

export interface SceneTheme {
  readonly background: string;
  readonly text: string;
  readonly muted: string;
  readonly grid: string;
  readonly plate: string;
  readonly accent: string;
}

export function themeOf(element: Element): SceneTheme {
  const style = getComputedStyle(element);
  const read = (name: string, fallback: string): string => style.getPropertyValue(name).trim() || fallback;
  return {
    background: read("--scene", read("--ground", "#ffffff")),
    text: read("--text", "#1c2430"),
    muted: read("--muted", "#5f6b7a"),
    grid: read("--line-strong", "#bfc7d2"),
    plate: read("--panel", "#ffffff"),
    accent: read("--accent", "#1f66d6"),
  };
}
