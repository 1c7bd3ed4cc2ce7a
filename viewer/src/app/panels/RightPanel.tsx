import { useApp } from "../context";

/** The settings of the scene. */
export function RightPanel() {
  const { scene } = useApp().workspace;
  if (!scene.value) return null;
  return <aside class="panel right-panel" aria-label="Settings of the view" />;
}
