import { useEffect, useState } from "preact/hooks";

import type { Database, IndexInfo, SceneView } from "../scene";
import { Choice, Section, Slider } from "./fields";
import { messageOf, useSceneEvents, useSceneState } from "./hooks";
import { levelsOf, nodeBoxes } from "./index_boxes";
import type { NodeBoxes } from "./index_boxes";

interface Props {
  readonly view: SceneView;
  readonly database: Database;
}

const kNone = "";
const kMarkers = "index boxes";
const kColor = "#e0803a";

/** The boxes of the nodes of an R-tree of the database, one level at a time. */
export function IndexPanel({ view, database }: Props) {
  useSceneEvents(view, "shapes");
  const indexes = ofShownFirst(database.indexes(), view);
  const { index } = useSceneState(view, "index");
  // That of a link may be gone.
  const name = indexes.some((known) => known.name === index.name) ? index.name : kNone;
  const { levels, boxes, error } = useIndexBoxes(view, database, name, index.level);
  if (indexes.length === 0) return null;
  const level = Math.min(index.level, Math.max(0, levels - 1));
  return (
    <Section title="Index boxes" open={false} testId="index-panel" inUse={name !== kNone}>
      <Choice
        label="R-tree"
        value={name}
        options={[
          { id: kNone, title: "none" },
          ...indexes.map((index) => ({ id: index.name, title: titleOf(index) })),
        ]}
        onChange={(next) => view.update({ index: { name: next, level: 0 } })}
      />
      {name !== kNone && levels > 1 && (
        <Slider
          label="Level"
          value={level}
          min={0}
          max={levels - 1}
          step={1}
          format={(value) => (value === 0 ? "root" : value === levels - 1 ? "leaves" : String(value))}
          onChange={(next) => view.update({ index: { level: next } })}
        />
      )}
      {name !== kNone && (
        <p class="muted" role="status" data-testid="index-facts">
          {boxes ? factsOf(boxes, levels) : error || "reading the index"}
        </p>
      )}
    </Section>
  );
}

function titleOf({ name, relation }: IndexInfo): string {
  return relation ? `${name} of ${relation}` : name;
}

/** Indexes of relations that are shown come before the others. */
function ofShownFirst(indexes: readonly IndexInfo[], view: SceneView): readonly IndexInfo[] {
  const shown = new Set<string | null>(view.results.map(({ title }) => title));
  return [...indexes].sort((a, b) => Number(shown.has(b.relation)) - Number(shown.has(a.relation)));
}

function factsOf({ boxes, count, members }: NodeBoxes, levels: number): string {
  const nodes = `${count} ${count === 1 ? "node" : "nodes"} of ${levels} ${levels === 1 ? "level" : "levels"}`;
  if (members === null) return `${nodes}; the first ${boxes.length} are drawn`;
  return `${nodes}, with ${members} ${members === 1 ? "member" : "members"}`;
}

/** Reads the boxes of a level and draws them as long as the panel is there. */
function useIndexBoxes(
  view: SceneView,
  database: Database,
  name: string,
  level: number,
): { levels: number; boxes: NodeBoxes | null; error: string } {
  const [levels, setLevels] = useState(0);
  const [boxes, setBoxes] = useState<NodeBoxes | null>(null);
  const [error, setError] = useState("");
  useEffect(() => {
    if (name === kNone) return;
    const abort = new AbortController();
    setError("");
    const read = async (): Promise<void> => {
      const count = await levelsOf(database, name, abort.signal);
      setLevels(count);
      const known = Math.min(level, Math.max(0, count - 1)); // the tree of a link may have become lower
      setBoxes(await nodeBoxes(database, name, known, abort.signal));
    };
    read().catch((failure: unknown) => {
      if (!abort.signal.aborted) setError(messageOf(failure));
    });
    return () => {
      abort.abort();
      setBoxes(null);
    };
  }, [database, name, level]);
  useEffect(() => {
    if (!boxes) return;
    view.setMarkers(kMarkers, { boxes: boxes.boxes, color: kColor });
    return () => view.setMarkers(kMarkers, null);
  }, [view, boxes]);
  return { levels, boxes, error };
}
