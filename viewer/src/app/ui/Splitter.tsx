import type { Signal } from "@preact/signals";
import { draggable } from "./drag";

interface Props {
  /** The size that is changed, in pixels. */
  readonly size: Signal<number>;
  readonly direction: "horizontal" | "vertical";
  /** The panel lies after the splitter, so that moving to the right or down makes it smaller. */
  readonly reverse?: boolean;
  readonly min: number;
  readonly label: string;
}

/** A line between two panels that is dragged, or moved with the arrow keys. */
export function Splitter({ size, direction, reverse, min, label }: Props) {
  const sign = reverse ? -1 : 1;
  const vertical = direction === "vertical";
  const most = () => (vertical ? innerHeight : innerWidth) - 200;
  const set = (value: number) => (size.value = Math.round(Math.min(most(), Math.max(min, value))));
  const onKeyDown = (event: KeyboardEvent) => {
    const forward = vertical ? "ArrowDown" : "ArrowRight";
    const back = vertical ? "ArrowUp" : "ArrowLeft";
    const step = event.key === forward ? 16 : event.key === back ? -16 : 0;
    if (step === 0) return;
    event.preventDefault();
    set(size.value + sign * step);
  };
  return (
    <div
      class={`splitter ${direction}`}
      role="separator"
      tabIndex={0}
      aria-label={label}
      aria-orientation={vertical ? "horizontal" : "vertical"}
      aria-valuenow={size.value}
      aria-valuemin={min}
      onKeyDown={onKeyDown}
      {...draggable(
        () => size.value,
        (start, dx, dy) => set(start + sign * (vertical ? dy : dx)),
      )}
    />
  );
}
