import { AppearancePanel } from "./AppearancePanel";
import { IndexPanel } from "./IndexPanel";
import { InspectPanel } from "./InspectPanel";
import { LightsPanel } from "./LightsPanel";
import { MeasurePanel } from "./MeasurePanel";
import { ObjectPanel } from "./ObjectPanel";
import type { SceneModel } from "./scene_model";
import { SectionPanel } from "./SectionPanel";
import { DisplayPanel, NavigationPanel } from "./ViewPanel";

/** All settings and tools of a scene, as sections that fold. */
export function ScenePanels({ model }: { model: SceneModel }) {
  const { view, database } = model;
  return (
    <div class="scene-panels">
      <ObjectPanel view={view} database={database} />
      <AppearancePanel view={view} />
      <DisplayPanel view={view} />
      <IndexPanel view={view} database={database} />
      <SectionPanel model={model} />
      <MeasurePanel model={model} />
      <InspectPanel model={model} />
      <LightsPanel view={view} />
      <NavigationPanel view={view} />
    </div>
  );
}
