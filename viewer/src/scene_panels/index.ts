/**
 * The panels of a scene. A page with a scene makes a `SceneModel` of it, and has for it `SceneToolbar`, `SceneOverlay`,
 * `SectionReadout` and `ToolReadout` as children of the element around the scene, `ScenePanels` in a panel beside it,
 * and one `SceneKeys` for the page.
 */

import "./scene_panels.css";

export { scrollInPanel } from "./fields";
export { useRoving } from "./roving";
export { SceneReader } from "./SceneReader";
export { useSceneState } from "./hooks";
export { SceneKeys } from "./SceneKeys";
export { SceneModel } from "./scene_model";
export { SceneOverlay } from "./SceneOverlay";
export { ScenePanels } from "./ScenePanels";
export { SceneToolbar } from "./SceneToolbar";
export { SectionReadout } from "./SectionReadout";
export { ToolReadout } from "./ToolReadout";
