import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

export interface MenuItem {
  readonly label: string;
  readonly run: () => void;
}

const open = signal<{ x: number; y: number; items: readonly MenuItem[]; from: HTMLElement } | null>(null);

/** Opens a menu below an element; Escape and a click elsewhere close it. */
export function openMenu(from: HTMLElement, items: readonly MenuItem[]): void {
  const { left, bottom } = from.getBoundingClientRect();
  open.value = { x: left, y: bottom + 4, items, from };
}

/** The place of the one menu that may be open. */
export function MenuHost() {
  const menu = open.value;
  const element = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!menu || !element.current) return;
    const box = element.current.getBoundingClientRect();
    element.current.style.left = `${Math.max(4, Math.min(menu.x, innerWidth - box.width - 4))}px`;
    element.current.style.top = `${Math.max(4, Math.min(menu.y, innerHeight - box.height - 4))}px`;
    element.current.querySelector("button")?.focus();
    const close = (event: Event) => {
      if (!element.current?.contains(event.target as Node)) open.value = null;
    };
    document.addEventListener("pointerdown", close);
    return () => document.removeEventListener("pointerdown", close);
  }, [menu]);
  if (!menu) return null;
  const close = () => {
    open.value = null;
    menu.from.focus();
  };
  return (
    <div ref={element} class="menu fixed" role="menu" onKeyDown={(event) => moveInMenu(event, close)}>
      {menu.items.map(({ label, run }) => (
        <button
          key={label}
          type="button"
          role="menuitem"
          onClick={() => {
            close();
            run();
          }}
        >
          {label}
        </button>
      ))}
    </div>
  );
}

function moveInMenu(event: KeyboardEvent, close: () => void): void {
  const buttons = [...(event.currentTarget as HTMLElement).querySelectorAll("button")];
  const place = buttons.indexOf(document.activeElement as HTMLButtonElement);
  if (event.key === "Escape" || event.key === "Tab") close();
  else if (event.key === "ArrowDown") buttons[(place + 1) % buttons.length]?.focus();
  else if (event.key === "ArrowUp") buttons[(place - 1 + buttons.length) % buttons.length]?.focus();
  else return;
  event.preventDefault();
  event.stopPropagation();
}
