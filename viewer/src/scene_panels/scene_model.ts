/** A view together with what the database is asked for it: exact cuts and values of measures. One for each view. */

import type { Database, SceneView } from "../scene";
import { MeasureControl } from "./measure_control";
import { SectionControl } from "./section_control";

export class SceneModel {
  readonly cuts: SectionControl;
  readonly measures: MeasureControl;
  private readonly listeners = new Set<() => void>();

  constructor(
    readonly view: SceneView,
    readonly database: Database,
  ) {
    const changed = (): void => {
      for (const listener of [...this.listeners]) listener();
    };
    this.cuts = new SectionControl(view, database, changed);
    this.measures = new MeasureControl(view, database, changed);
  }

  /** Calls `listener` when an answer came or went; returns what ends this. */
  onAnswer(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  dispose(): void {
    this.cuts.dispose();
    this.measures.dispose();
  }
}
