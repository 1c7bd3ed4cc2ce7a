import type { Database, SceneView } from "../scene";
import { AppearancePanel } from "./AppearancePanel";
import { IndexPanel } from "./IndexPanel";
import { InspectPanel } from "./InspectPanel";
import { LightsPanel } from "./LightsPanel";
import { MeasurePanel } from "./MeasurePanel";
import { ObjectPanel } from "./ObjectPanel";
import { SectionPanel } from "./SectionPanel";
import { DisplayPanel, NavigationPanel } from "./ViewPanel";

interface Props {
  readonly view: SceneView;
  readonly database: Database;
}

/** All settings and tools of a scene, as sections that fold. */
export function ScenePanels({ view, database }: Props) {
  return (
    <div class="scene-panels">
      <ObjectPanel view={view} database={database} />
      <AppearancePanel view={view} />
      <DisplayPanel view={view} />
      <IndexPanel view={view} database={database} />
      <SectionPanel view={view} database={database} />
      <MeasurePanel view={view} database={database} />
      <InspectPanel view={view} database={database} />
      <LightsPanel view={view} />
      <NavigationPanel view={view} />
    </div>
  );
}
