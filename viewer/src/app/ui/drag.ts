/** Pointer events of a handle that is dragged; `start` is asked once, at the beginning. */
export function draggable<T>(start: () => T, move: (start: T, dx: number, dy: number) => void) {
  return {
    onPointerDown: (down: PointerEvent) => {
      const handle = down.currentTarget as HTMLElement;
      const initial = start();
      const onMove = (event: PointerEvent) =>
        move(initial, event.clientX - down.clientX, event.clientY - down.clientY);
      const onEnd = () => {
        handle.removeEventListener("pointermove", onMove);
        handle.removeEventListener("pointerup", onEnd);
        handle.removeEventListener("pointercancel", onEnd);
      };
      handle.setPointerCapture(down.pointerId);
      handle.addEventListener("pointermove", onMove);
      handle.addEventListener("pointerup", onEnd);
      handle.addEventListener("pointercancel", onEnd);
      down.preventDefault();
    },
  };
}
