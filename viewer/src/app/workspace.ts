import { computed, signal, type ReadonlySignal } from "@preact/signals";
import type { CellRef } from "../scene/api";
import { scrollInPanel, type SceneModel } from "../scene_panels";
import { Uploads } from "../state/uploads";
import type { RowQuestion } from "../state/row_questions";
import { Workbench, type SideName } from "../state/workbench";
import type { Store } from "../state/store";
import type { Editor } from "./editor/editor";

/** What exists only while the page is shown: the editor and the scene, and requests from one part to another. */
export class Workspace {
  readonly store: Store;
  readonly editor = signal<Editor | null>(null);
  /** The scene of the results. */
  readonly scene = signal<SceneModel | null>(null);
  /** The object whose properties are shown. */
  readonly opened = signal<CellRef | null>(null);
  /** The side of the split screen that was used last. */
  readonly keySide = signal<SideName>("left");
  /** The scene that gets the keys and whose settings are shown. */
  readonly keyScene: ReadonlySignal<SceneModel | null>;
  /** A cell that is to be stored as an object, while a person is asked for its name. */
  readonly naming = signal<CellRef | null>(null);
  /** The scenes of the split screen, while it is shown. */
  readonly sideScenes = {
    left: signal<SceneModel | null>(null),
    right: signal<SceneModel | null>(null),
  };
  /** Its cameras move together. */
  readonly sameCamera = signal(true);
  readonly workbench: Workbench;
  readonly uploads: Uploads;

  constructor(store: Store) {
    this.store = store;
    this.keyScene = computed(() =>
      store.mode.value === "compare" ? this.sideScenes[this.keySide.value].value : this.scene.value,
    );
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
    this.#showSettings();
  }

  #showSettings(): void {
    const { layout } = this.store;
    layout.sideOpen.value = true;
    layout.sideTab.value = "view";
    layout.sheet.value = "view";
  }

  /** Shows the part of the settings of the view for a tool. */
  readonly openSettings = (part: "section" | "measure" | "inspect"): void => {
    this.#showSettings();
    requestAnimationFrame(() => {
      const panel = document.querySelector<HTMLDetailsElement>(`[data-testid="${part}-panel"]`);
      if (!panel) return;
      panel.open = true;
      scrollInPanel(panel, "start");
    });
  };

  /** Colours the objects by the values of a column. */
  colourBy(attribute: string): void {
    this.scene.value?.view.update({
      appearance: { scheme: { by: "attribute", attribute, palette: "viridis" } },
    });
  }

  compareObject(side: SideName, name: string): void {
    this.store.mode.value = "compare";
    void this.workbench.side(side).loadObject(name);
  }

  /** Runs a question about the rows of a result. */
  async ask({ statement, parameters, column }: RowQuestion): Promise<void> {
    const outcome = await this.store.run(statement, { parameters });
    if (outcome && column !== undefined) this.colourBy(column);
  }

  /** Puts a name at the cursor of the editor. */
  insert(text: string): void {
    this.editor.value?.insert(text);
  }

  /** Opens the browser's choice of files; the chosen ones are uploaded. */
  chooseFiles: () => void = () => undefined;
  /** Opens the choice of a folder; all that is in it is uploaded. */
  chooseFolder: () => void = () => undefined;

  /** Runs a statement that is offered, and puts it into the editor, where it can be changed. */
  async tryStatement(statement: string): Promise<void> {
    this.editor.value?.setText(`${statement};`);
    await this.store.run(statement);
  }

  /** Runs a statement from a list, and puts it into the editor if this is empty. */
  async query(statement: string): Promise<void> {
    const { editor, store } = { editor: this.editor.value, store: this.store };
    if (editor?.text.trim() === "") editor.setText(`${statement};`);
    await store.run(statement);
  }
}
