/** The state of a scene view in components. */

import { useEffect, useState } from "preact/hooks";

import type { SceneEvents, SceneState, SceneView } from "../scene";
import type { SceneModel } from "./scene_model";

/** Renders the component anew at each of these events of the view. */
export function useSceneEvents(view: SceneView, ...events: readonly (keyof SceneEvents)[]): void {
  const [, setCount] = useState(0);
  const names = events.join(" ");
  useEffect(() => {
    const again = (): void => setCount((count) => count + 1);
    const ends = events.map((event) => view.on(event, again));
    again(); // something may have happened before
    return () => ends.forEach((end) => end());
  }, [view, names]);
}

/** The state of the view; the component is rendered anew when one of these parts changes. */
export function useSceneState(view: SceneView, ...parts: readonly (keyof SceneState)[]): SceneState {
  const [, setCount] = useState(0);
  const names = parts.join(" ");
  useEffect(
    () =>
      view.on("state", (change) => {
        if (change.parts.some((part) => parts.includes(part))) setCount((count) => count + 1);
      }),
    [view, names],
  );
  return view.state;
}

/** Renders the component anew when an answer of the database for this view came or went. */
export function useAnswers(model: SceneModel): void {
  const [, setCount] = useState(0);
  useEffect(() => model.onAnswer(() => setCount((count) => count + 1)), [model]);
}

/** The text of an error for people. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
