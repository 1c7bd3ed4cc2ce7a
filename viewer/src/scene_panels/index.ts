/**
 * The panels of a scene. A page with a scene has, each with the same view:
 * `SceneToolbar` and `SceneOverlay` as children of the element around the scene, `ScenePanels` in a panel beside it
 * (mounted also while it is hidden: the exact section is asked for from there), and one `SceneKeys` for the page.
 */

import "./scene_panels.css";

export { SceneKeys } from "./SceneKeys";
export { SceneOverlay } from "./SceneOverlay";
export { ScenePanels } from "./ScenePanels";
export { SceneToolbar } from "./SceneToolbar";
