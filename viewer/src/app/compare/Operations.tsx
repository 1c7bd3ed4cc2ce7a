import { useState } from "preact/hooks";
import type { SceneView } from "../../scene/api";
import { cellOf, type Side } from "../../state/workbench";
import {
  dual,
  isLimitScheme,
  limitSchemes,
  schemes,
  setOperation,
  setOperations,
  simplification,
  subdivision,
  triangulation,
  variantsOf,
  type Scheme,
  type SetOperation,
} from "../../state/workbench_operations";
import { useSceneState } from "../../scene_panels";
import { useApp } from "../context";

interface Props {
  readonly side: Side;
  readonly view: SceneView;
}

/** What can be done with the mesh of a side. */
export function Operations({ side, view }: Props) {
  const off = side.step.value === null || side.busy.value !== "";
  return (
    <fieldset class="operations" disabled={off} aria-label="Operations">
      <Subdivide side={side} />
      <Simplify side={side} />
      <SetOperations side={side} />
      <div class="row">
        <button type="button" class="btn" onClick={() => void side.apply(dual)}>
          Dual
        </button>
        <button type="button" class="btn" onClick={() => void side.apply(triangulation)}>
          Triangulate
        </button>
        <Drags side={side} view={view} />
      </div>
    </fieldset>
  );
}

function Subdivide({ side }: { side: Side }) {
  const { workbench } = useApp().workspace;
  const [scheme, setScheme] = useState<Scheme>("loop");
  const [variant, setVariant] = useState("");
  const [steps, setSteps] = useState(1);
  const hasLimit = isLimitScheme(scheme);
  const variants = variantsOf(scheme);
  return (
    <div class="row">
      <select
        class="input"
        aria-label="Scheme"
        value={scheme}
        onChange={(event) => {
          setScheme(event.currentTarget.value as Scheme);
          setVariant("");
        }}
      >
        {schemes.map((each) => (
          <option key={each}>{each}</option>
        ))}
      </select>
      {variants.length > 0 && (
        <select
          class="input"
          aria-label="Variant"
          value={variant || variants[0]}
          onChange={(event) => setVariant(event.currentTarget.value)}
        >
          {variants.map((each) => (
            <option key={each}>{each}</option>
          ))}
        </select>
      )}
      <WholeNumber label="Steps" value={steps} most={8} onValue={setSteps} />
      <button
        type="button"
        class="btn"
        onClick={() => void side.apply((type) => subdivision(type, scheme, variant), null, steps)}
      >
        Subdivide
      </button>
      <button
        type="button"
        class="btn"
        disabled={!hasLimit}
        title={
          hasLimit
            ? "Limit surface on the other side, with this mesh over it"
            : `Known for ${limitSchemes.join(", ")}`
        }
        onClick={() => {
          if (hasLimit) void workbench.showLimit(side.name, scheme, Math.max(2, steps), variant);
        }}
      >
        Limit beside
      </button>
    </div>
  );
}

interface WholeNumberProps {
  readonly label: string;
  readonly value: number;
  readonly most: number;
  readonly onValue: (value: number) => void;
}

/** A field of a whole number from 1 to `most`; another number gives way to the nearest of these, which is shown. */
function WholeNumber({ label, value, most, onValue }: WholeNumberProps) {
  const nearest = (text: string) => Math.min(most, Math.max(1, Math.round(Number(text) || 1)));
  return (
    <input
      class="input steps-input"
      type="number"
      min={1}
      max={most}
      aria-label={label}
      title={`${label}, 1 to ${most}`}
      value={value}
      onInput={({ currentTarget }) => currentTarget.value && onValue(nearest(currentTarget.value))}
      onChange={({ currentTarget }) => {
        const taken = currentTarget.value ? nearest(currentTarget.value) : value;
        // By hand: nothing is drawn anew if the value is the one before.
        currentTarget.value = String(taken);
        onValue(taken);
      }}
    />
  );
}

function Simplify({ side }: { side: Side }) {
  const [percent, setPercent] = useState(50);
  return (
    <div class="row">
      <WholeNumber label="Percentage of triangles that stay" value={percent} most={99} onValue={setPercent} />
      <span class="muted">%</span>
      <button
        type="button"
        class="btn"
        onClick={() => void side.apply((type) => simplification(type, percent / 100))}
      >
        Simplify
      </button>
    </div>
  );
}

const titles: Readonly<Record<SetOperation, string>> = {
  union: "What is in this mesh or in that of the other side",
  intersection: "What is in both meshes",
  minus: "What is in this mesh and not in that of the other side",
  either: "What is in one of both meshes only: the symmetric difference",
};

function SetOperations({ side }: { side: Side }) {
  const { workbench } = useApp().workspace;
  const other = workbench.other(side.name).step.value;
  const apply = (operation: SetOperation) => {
    if (other) void side.apply((type) => setOperation(operation, type, other.type), other);
  };
  return (
    <div class="btn-group" role="group" aria-label="With the other side">
      {setOperations.map((operation) => (
        <button
          key={operation}
          type="button"
          class="btn"
          disabled={!other}
          title={titles[operation]}
          onClick={() => apply(operation)}
        >
          {operation}
        </button>
      ))}
    </div>
  );
}

const drags = [
  { id: "normal", of: "Vertex ", label: "↕ normal", title: "Drag a vertex along its normal" },
  { id: "plane", of: "Vertex ", label: "↔ plane", title: "Drag a vertex in the plane of its normal" },
  { id: "translate", of: "", label: "Move", title: "Drag arrows that move the mesh" },
  { id: "rotate", of: "", label: "Turn", title: "Drag rings that turn the mesh about its middle" },
  { id: "scale", of: "", label: "Scale", title: "Drag boxes that scale the mesh about its middle" },
] as const;
type Drag = (typeof drags)[number]["id"];

/** What is dragged in the scene: vertices, or the whole mesh by a handle. */
function Drags({ side, view }: Props) {
  const { tools } = useSceneState(view, "tools");
  const drag = tools.tool === "drag" ? tools.drag?.how : undefined;
  const step = side.step.value;
  const choose = (how: Drag): void => {
    if (!step) return;
    const isEnd = drag === how;
    view.update({
      tools: { tool: isEnd ? "select" : "drag", drag: isEnd ? null : { cell: cellOf(step), how } },
    });
  };
  return (
    <div class="btn-group" role="group" aria-label="Drag in the scene">
      {drags.map(({ id, of, label, title }) => (
        <button
          key={id}
          type="button"
          class="btn"
          aria-pressed={drag === id}
          aria-label={of + label}
          title={title}
          onClick={() => choose(id)}
        >
          {of && <span class="in-wide-side">{of}</span>}
          {label}
        </button>
      ))}
    </div>
  );
}
