/**
 * What a movement of the mouse or of fingers does, for the habits of common programs.
 * Sources: the manuals of the programs, sections on navigation. Where a program rotates and selects with the same button,
 * a press without movement selects.
 */

import type { NavigationPreset } from "./api";

export type Motion = "rotate" | "pan" | "zoom" | "roll" | "none";

export type MouseButton = "left" | "middle" | "right";

export interface Modifiers {
  readonly shift: boolean;
  readonly ctrl: boolean;
  readonly alt: boolean;
}

/** A rule applies if exactly these buttons and modifiers are held, e.g. "shift+middle". */
interface Preset {
  readonly title: string;
  readonly rules: Readonly<Record<string, Motion>>;
  /** Turning the wheel towards the person goes closer. */
  readonly wheelTowardsIsCloser: boolean;
  /** What two fingers on a touchpad (a wheel with x and y) do. */
  readonly wheel: "zoom" | "rotate";
}

function preset(title: string, rules: Preset["rules"], more: Partial<Preset> = {}): Preset {
  return { title, rules, wheelTowardsIsCloser: false, wheel: "zoom", ...more };
}

const kPresets: Readonly<Record<NavigationPreset, Preset>> = {
  default: preset("algebra3d", {
    left: "rotate",
    right: "pan",
    middle: "pan",
    "shift+left": "pan",
    "alt+left": "zoom",
    "ctrl+middle": "zoom",
    "shift+right": "roll",
  }),
  blender: preset("Blender", {
    middle: "rotate",
    "shift+middle": "pan",
    "ctrl+middle": "zoom",
    "alt+left": "rotate",
    "shift+alt+left": "pan",
  }),
  freecad: preset("FreeCAD (CAD style)", {
    middle: "pan",
    "left+middle": "rotate",
    "middle+right": "rotate",
    "shift+right": "rotate",
    "ctrl+right": "pan",
    "ctrl+shift+right": "zoom",
  }),
  solidworks: preset(
    "SolidWorks",
    { middle: "rotate", "ctrl+middle": "pan", "shift+middle": "zoom", "alt+middle": "roll" },
    { wheelTowardsIsCloser: true },
  ),
  fusion: preset(
    "Fusion",
    { middle: "pan", "shift+middle": "rotate", "ctrl+shift+middle": "zoom" },
    { wheelTowardsIsCloser: true },
  ),
  onshape: preset("Onshape", {
    right: "rotate",
    middle: "pan",
    "ctrl+right": "pan",
    "shift+middle": "zoom",
    "alt+right": "roll",
  }),
  inventor: preset("Inventor", { middle: "pan", "shift+middle": "rotate", "ctrl+middle": "zoom" }),
  catia: preset("CATIA", {
    middle: "pan",
    "left+middle": "rotate",
    "middle+right": "rotate",
    "ctrl+middle": "zoom",
  }),
  rhino: preset("Rhino", { right: "rotate", "shift+right": "pan", "ctrl+right": "zoom" }),
  maya: preset("Maya", { "alt+left": "rotate", "alt+middle": "pan", "alt+right": "zoom" }),
  f3d: preset("F3D, VTK and ParaView", {
    left: "rotate",
    "shift+left": "pan",
    middle: "pan",
    right: "zoom",
    "ctrl+left": "roll",
  }),
  touchpad: preset(
    "Touchpad",
    { left: "rotate", "shift+left": "pan", "alt+left": "zoom", right: "pan" },
    { wheel: "rotate" },
  ),
};

export const kNavigationPresets: readonly { readonly id: NavigationPreset; readonly title: string }[] = (
  Object.keys(kPresets) as NavigationPreset[]
).map((id) => ({ id, title: kPresets[id].title }));

/** The buttons of PointerEvent.buttons, in the order of the rules. */
export function buttonsOf(bits: number): MouseButton[] {
  const names: MouseButton[] = [];
  if (bits & 1) names.push("left");
  if (bits & 4) names.push("middle");
  if (bits & 2) names.push("right");
  return names;
}

function ruleName(buttons: readonly MouseButton[], modifiers: Modifiers): string {
  const held = [modifiers.ctrl && "ctrl", modifiers.shift && "shift", modifiers.alt && "alt", ...buttons];
  return held.filter((name) => name !== false).join("+");
}

/** What dragging does. */
export function motionOf(
  id: NavigationPreset,
  buttons: readonly MouseButton[],
  modifiers: Modifiers,
): Motion {
  return kPresets[id].rules[ruleName(buttons, modifiers)] ?? "none";
}

export interface WheelTurn {
  readonly x: number;
  readonly y: number;
  /** WheelEvent.deltaMode: 0 pixels, 1 lines, 2 pages. */
  readonly mode: number;
  /** A pinch on a touchpad comes as a wheel with Ctrl. */
  readonly ctrl: boolean;
  readonly shift: boolean;
}

/** What a turn of the wheel does; amounts are in pixels of dragging, for zoom positive is away. */
export function wheelMotion(id: NavigationPreset, turn: WheelTurn): { motion: Motion; x: number; y: number } {
  const unit = turn.mode === 1 ? 18 : turn.mode === 2 ? 400 : 1;
  const [x, y] = [turn.x * unit, turn.y * unit];
  const { wheel, wheelTowardsIsCloser } = kPresets[id];
  if (wheel === "rotate" && !turn.ctrl) return { motion: turn.shift ? "pan" : "rotate", x: -x, y: -y };
  const amount = turn.ctrl ? y * 3 : y;
  return { motion: "zoom", x: 0, y: wheelTowardsIsCloser && !turn.ctrl ? -amount : amount };
}

/** The rules for people: `["left drag", "rotate"]`, ... */
export function describePreset(id: NavigationPreset): (readonly [string, string])[] {
  const { rules, wheel } = kPresets[id];
  const lines = Object.entries(rules).map(
    ([rule, motion]) => [`${rule.split("+").map(capitalized).join(" + ")} drag`, motion] as const,
  );
  return [...lines, ["Wheel", wheel === "zoom" ? "zoom" : "rotate; with Ctrl or a pinch zoom"]];
}

function capitalized(word: string): string {
  return word.charAt(0).toUpperCase() + word.slice(1);
}
