import { signal } from "@preact/signals";
import type { CellRef, SceneView } from "../scene/api";
import { Uploads } from "../state/uploads";
import { Workbench, type SideName } from "../state/workbench";
import type { Store } from "../state/store";
import type { Editor } from "./editor/editor";

/** What exists only while the page is shown: the editor and the scene, and requests from one part to another. */
export class Workspace {
  readonly store: Store;
  readonly editor = signal<Editor | null>(null);
  /** The scene of the results. */
  readonly scene = signal<SceneView | null>(null);
  /** The object whose properties are shown. */
  readonly opened = signal<CellRef | null>(null);

  /** The scene that gets the keys; that of the results unless a side of the split screen was used last. */
  readonly keyScene = signal<SceneView | null>(null);
  /** A cell that is to be stored as an object, while a person is asked for its name. */
  readonly naming = signal<CellRef | null>(null);
  /** The scenes of the split screen, while it is shown. */
  readonly sideScenes = { left: signal<SceneView | null>(null), right: signal<SceneView | null>(null) };
  /** Its cameras move together. */
  readonly sameCamera = signal(true);
  readonly workbench: Workbench;
  readonly uploads: Uploads;

  constructor(store: Store) {
    this.store = store;
    this.workbench = new Workbench(store);
    this.uploads = new Uploads(store);
  }

  askName(cell: CellRef): void {
    this.naming.value = cell;
  }

  /** Puts the mesh of a cell on a side of the split screen. */
  compare(side: SideName, cell: CellRef): void {
    this.store.mode.value = "compare";
    void this.workbench.side(side).load(cell);
  }

  /** Shows the properties of an object: its colour, size and opacity. */
  openProperties(cell: CellRef): void {
    this.opened.value = cell;
    this.store.layout.rightOpen.value = true;
    this.store.layout.sheet.value = "view";
  }

  /** Shows the part of the settings of the view for a tool. */
  openSettings(part: "section"): void {
    this.store.layout.rightOpen.value = true;
    this.store.layout.sheet.value = "view";
    requestAnimationFrame(() =>
      document.querySelector(`[data-testid="${part}-panel"]`)?.scrollIntoView({ block: "start" }),
    );
  }

  /** Colours the objects by the values of a column. */
  colourBy(attribute: string): void {
    this.scene.value?.update({ appearance: { scheme: { by: "attribute", attribute, palette: "viridis" } } });
  }

  compareObject(side: SideName, name: string): void {
    this.store.mode.value = "compare";
    void this.workbench.side(side).loadObject(name);
  }

  /** Puts a name at the cursor of the editor. */
  insert(text: string): void {
    this.editor.value?.insert(text);
  }

  /** Opens the browser's choice of files; the chosen ones are uploaded. */
  chooseFiles: () => void = () => undefined;

  /** Runs a statement from a list, and puts it into the editor if this is empty. */
  async query(statement: string): Promise<void> {
    const { editor, store } = { editor: this.editor.value, store: this.store };
    if (editor?.text.trim() === "") editor.setText(`${statement};`);
    await store.run(statement);
  }
}
