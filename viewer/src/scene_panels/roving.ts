import type { RefObject } from "preact";
import { useEffect } from "preact/hooks";

/** Makes the buttons of a bar one stop of the Tab key; the arrow keys, Home and End go from one to another. */
export function useRoving(bar: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const element = bar.current;
    if (!element) return;
    const buttons = (): HTMLButtonElement[] =>
      [...element.querySelectorAll<HTMLButtonElement>("button:not([aria-hidden])")].filter(
        (button) => !button.disabled && button.offsetParent !== null,
      );
    const setStop = (stop: HTMLElement | undefined): void => {
      for (const button of element.querySelectorAll("button")) button.tabIndex = button === stop ? 0 : -1;
    };
    const refresh = (): void => {
      const all = buttons();
      setStop(all.find(({ tabIndex }) => tabIndex === 0) ?? all[0]);
    };
    const onFocus = ({ target }: FocusEvent): void => setStop(target as HTMLElement);
    const onKey = (event: KeyboardEvent): void => {
      const all = buttons();
      const at = all.indexOf(document.activeElement as HTMLButtonElement);
      const places: Readonly<Record<string, number>> = {
        ArrowRight: at + 1,
        ArrowLeft: at - 1,
        Home: 0,
        End: all.length - 1,
      };
      const place = places[event.key];
      if (at < 0 || place === undefined) return;
      event.preventDefault();
      all[(place + all.length) % all.length]?.focus();
    };
    // Buttons that come later would be stops of their own.
    const observer = new MutationObserver(refresh);
    observer.observe(element, { childList: true, subtree: true, attributeFilter: ["disabled"] });
    refresh();
    element.addEventListener("focusin", onFocus);
    element.addEventListener("keydown", onKey);
    return () => {
      observer.disconnect();
      element.removeEventListener("focusin", onFocus);
      element.removeEventListener("keydown", onKey);
    };
  }, []);
}
