/** Small fields that the panels of the scene are made of. Each has a visible label that names it for screen readers. */

import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";

import type { Vec3 } from "../scene";

interface SectionProps {
  readonly title: string;
  readonly open?: boolean;
  readonly onReset?: () => void;
  readonly children: ComponentChildren;
  readonly testId?: string;
  readonly onToggle?: (open: boolean) => void;
  /** Opens the part when it becomes true, and brings it into sight. */
  readonly inUse?: boolean;
}

/** A part of a panel that folds. */
export function Section({ title, open = true, onReset, children, testId, onToggle, inUse }: SectionProps) {
  const details = useRef<HTMLDetailsElement>(null);
  useEffect(() => {
    if (!inUse || !details.current) return;
    details.current.open = true;
    scrollInPanel(details.current, "nearest");
  }, [inUse]);
  return (
    <details
      ref={details}
      class="panel-section"
      open={open}
      data-testid={testId}
      onToggle={(event) => onToggle?.(event.currentTarget.open)}
    >
      <summary>{title}</summary>
      {children}
      {onReset && (
        <div class="row">
          <button type="button" class="btn quiet small" onClick={onReset}>
            Reset {title.toLowerCase()}
          </button>
        </div>
      )}
    </details>
  );
}

/** Scrolls the panel around an element, and nothing around the panel, so that its beginning, or all of it, is seen. */
export function scrollInPanel(element: HTMLElement, block: "start" | "nearest"): void {
  const panel = element.closest<HTMLElement>(".panel-body");
  if (!panel) return;
  const [inner, outer] = [element.getBoundingClientRect(), panel.getBoundingClientRect()];
  const below = Math.min(inner.bottom - outer.bottom, inner.top - outer.top);
  if (block === "start" || inner.top < outer.top) panel.scrollTop += inner.top - outer.top;
  else if (below > 0) panel.scrollTop += below;
}

interface CheckProps {
  readonly label: string;
  readonly checked: boolean;
  readonly onChange: (checked: boolean) => void;
}

export function Check({ label, checked, onChange }: CheckProps) {
  return (
    <label class="check">
      <input type="checkbox" checked={checked} onChange={(event) => onChange(event.currentTarget.checked)} />
      <span>{label}</span>
    </label>
  );
}

interface ColorProps {
  readonly label: string;
  readonly value: string;
  readonly onChange: (color: string) => void;
  /** Shown while the value differs from the default. */
  readonly onReset?: (() => void) | undefined;
}

export function ColorField({ label, value, onChange, onReset }: ColorProps) {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{label}</label>
      {onReset && (
        <button type="button" class="btn quiet small" aria-label={`Reset ${label}`} onClick={onReset}>
          Reset
        </button>
      )}
      <input
        id={id}
        class="input"
        type="color"
        value={value}
        onInput={(event) => onChange(event.currentTarget.value)}
      />
    </div>
  );
}

interface NumberProps {
  readonly label: string;
  readonly value: number;
  readonly onChange: (value: number) => void;
  readonly min?: number;
  readonly max?: number;
  readonly step?: number | "any";
}

/** Takes over what is typed when it is a number in the range; what is not stays in the field until it is left. */
export function NumberField({ label, value, onChange, min, max, step = "any" }: NumberProps) {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{label}</label>
      <NumberInput id={id} value={value} onChange={onChange} min={min} max={max} step={step} />
    </div>
  );
}

interface NumberInputProps {
  readonly id?: string;
  readonly label?: string;
  readonly value: number;
  readonly onChange: (value: number) => void;
  readonly min?: number | undefined;
  readonly max?: number | undefined;
  readonly step?: number | "any";
}

function NumberInput({ id, label, value, onChange, min, max, step = "any" }: NumberInputProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const take = (text: string): void => {
    setTyped(text);
    const number = Number(text);
    if (text.trim() === "" || !Number.isFinite(number)) return;
    if ((min !== undefined && number < min) || (max !== undefined && number > max)) return;
    onChange(number);
  };
  return (
    <input
      id={id}
      class="input"
      type="number"
      aria-label={label}
      value={typed ?? shortNumber(value)}
      min={min}
      max={max}
      step={step}
      onInput={(event) => take(event.currentTarget.value)}
      onBlur={() => setTyped(null)}
    />
  );
}

/** A number without digits that nobody reads. */
export function shortNumber(value: number): string {
  return String(Number(value.toPrecision(7)));
}

interface VectorProps {
  readonly label: string;
  readonly value: Vec3;
  readonly onChange: (value: Vec3) => void;
}

/** Three numbers X, Y, Z. */
export function VectorField({ label, value, onChange }: VectorProps) {
  const set = (axis: number, part: number): void => {
    const next = [...value];
    next[axis] = part;
    onChange(next as unknown as Vec3);
  };
  return (
    <fieldset class="vector-field">
      <legend>{label}</legend>
      {["X", "Y", "Z"].map((axis, index) => (
        <label key={axis}>
          <span aria-hidden="true">{axis}</span>
          <NumberInput
            label={`${label} ${axis}`}
            value={value[index]!}
            onChange={(part) => set(index, part)}
          />
        </label>
      ))}
    </fieldset>
  );
}

interface SliderProps {
  readonly label: string;
  readonly value: number;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly onChange: (value: number) => void;
  readonly format?: (value: number) => string;
}

export function Slider({ label, value, min, max, step, onChange, format = shortNumber }: SliderProps) {
  const id = useId();
  return (
    <div class="slider-field">
      <label for={id}>{label}</label>
      <output for={id}>{format(value)}</output>
      <input
        id={id}
        type="range"
        min={min}
        max={max}
        step={step}
        value={value}
        onInput={(event) => onChange(Number(event.currentTarget.value))}
      />
    </div>
  );
}

interface ChoiceProps<T extends string> {
  readonly label: string;
  readonly value: T;
  readonly options: readonly { readonly id: T; readonly title: string }[];
  readonly onChange: (value: T) => void;
}

export function Choice<T extends string>({ label, value, options, onChange }: ChoiceProps<T>) {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{label}</label>
      <select
        id={id}
        class="input"
        value={value}
        onChange={(event) => onChange(event.currentTarget.value as T)}
      >
        {options.map((option) => (
          <option key={option.id} value={option.id}>
            {option.title}
          </option>
        ))}
      </select>
    </div>
  );
}

/** One of few, all of them seen. */
export function Segments<T extends string>({ label, value, options, onChange }: ChoiceProps<T>) {
  return (
    <div class="field">
      <span>{label}</span>
      <div class="btn-group" role="group" aria-label={label}>
        {options.map(({ id, title }) => (
          <button
            key={id}
            type="button"
            class="btn small"
            aria-pressed={id === value}
            onClick={() => onChange(id)}
          >
            {title}
          </button>
        ))}
      </div>
    </div>
  );
}
