/**
 * The panels of a scene. A page with a scene has, each with the same view:
 * `SceneToolbar`, `SceneOverlay` and `SectionReadout` as children of the element around the scene, `ScenePanels` in a
 * panel beside it, and one `SceneKeys` for the page. The exact section is asked for while one of its two is mounted.
 */

import "./scene_panels.css";

export { SceneKeys } from "./SceneKeys";
export { SceneOverlay } from "./SceneOverlay";
export { ScenePanels } from "./ScenePanels";
export { SceneToolbar } from "./SceneToolbar";
export { SectionReadout } from "./SectionReadout";
