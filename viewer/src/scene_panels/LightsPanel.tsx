import { useEffect } from "preact/hooks";

import { newLight } from "../scene";
import type { GlobalLight, LightsState, PointLightState, SceneView } from "../scene";
import { Check, ColorField, NumberField, Section, Slider, VectorField } from "./fields";
import { useSceneState } from "./hooks";

const times = (value: number): string => `${value.toFixed(2)}×`;

/** The global light and any number of individual ones. Their markers are in the scene while the panel is open. */
export function LightsPanel({ view }: { view: SceneView }) {
  const { lights } = useSceneState(view, "lights");
  const set = (change: Partial<LightsState>): void => view.update({ lights: change });
  const setGlobal = (change: Partial<GlobalLight>): void => set({ global: { ...lights.global, ...change } });
  useEffect(() => () => view.update({ lights: { markers: false } }), [view]);
  const add = (): void => {
    const light = newLight(lights, view.state.camera);
    set({ lights: [...lights.lights, light], selected: light.id });
  };
  const selected = lights.lights.find(({ id }) => id === lights.selected);
  return (
    <Section
      title="Lights"
      open={false}
      testId="lights-panel"
      onReset={() => view.reset("lights")}
      onToggle={(markers) => set({ markers })}
    >
      <Check label="Global light" checked={lights.global.on} onChange={(on) => setGlobal({ on })} />
      <ColorField label="Colour" value={lights.global.color} onChange={(color) => setGlobal({ color })} />
      <Slider
        label="Brightness"
        value={lights.global.brightness}
        min={0}
        max={3}
        step={0.05}
        format={times}
        onChange={(brightness) => setGlobal({ brightness })}
      />
      <ul class="list" aria-label="Individual lights">
        {lights.lights.map((light, index) => (
          <LightItem key={light.id} view={view} light={light} name={`Light ${index + 1}`} />
        ))}
      </ul>
      <div class="row">
        <button type="button" class="btn small" onClick={add}>
          Add light
        </button>
        <button
          type="button"
          class="btn small"
          disabled={lights.lights.length === 0}
          onClick={() => set({ lights: [], selected: null })}
        >
          Delete all
        </button>
      </div>
      {selected && <LightFields view={view} light={selected} />}
    </Section>
  );
}

function changeLight(view: SceneView, id: number, change: Partial<PointLightState>): void {
  const { lights } = view.state.lights;
  view.update({
    lights: { lights: lights.map((light) => (light.id === id ? { ...light, ...change } : light)) },
  });
}

function LightItem({ view, light, name }: { view: SceneView; light: PointLightState; name: string }) {
  const { lights } = view.state;
  const remove = (): void =>
    view.update({
      lights: {
        lights: lights.lights.filter(({ id }) => id !== light.id),
        selected: lights.selected === light.id ? null : lights.selected,
      },
    });
  return (
    <li class="field">
      <input
        type="checkbox"
        aria-label={`${name} on`}
        checked={light.on}
        onChange={(event) => changeLight(view, light.id, { on: event.currentTarget.checked })}
      />
      <button
        type="button"
        class="btn quiet small grow"
        aria-pressed={lights.selected === light.id}
        onClick={() => view.update({ lights: { selected: light.id } })}
      >
        {name}
      </button>
      <button type="button" class="btn quiet small" aria-label={`Delete ${name}`} onClick={remove}>
        Delete
      </button>
    </li>
  );
}

function LightFields({ view, light }: { view: SceneView; light: PointLightState }) {
  const set = (change: Partial<PointLightState>): void => changeLight(view, light.id, change);
  return (
    <>
      <ColorField label="Colour" value={light.color} onChange={(color) => set({ color })} />
      <Slider
        label="Brightness"
        value={light.brightness}
        min={0}
        max={5}
        step={0.05}
        format={times}
        onChange={(brightness) => set({ brightness })}
      />
      <NumberField label="Reach" value={light.reach} min={1e-9} onChange={(reach) => set({ reach })} />
      <VectorField label="Position" value={light.position} onChange={(position) => set({ position })} />
      <p class="muted">Drag its marker in the scene, or drag with Ctrl anywhere.</p>
    </>
  );
}
