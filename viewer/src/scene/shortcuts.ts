/**
 * Keyboard shortcuts: one table for the keys, the cheat sheet and the menus. Keys are those of F3D where it has the
 * function. Actions of the group "Application" are emitted by the view as events and carried out by the application.
 */

export interface Shortcut {
  readonly action: string;
  /** As KeyboardEvent.key, letters in lower case, with "Shift+", "Ctrl+", "Alt+" before; several separated by a blank. */
  readonly keys: string;
  readonly title: string;
  readonly group: "Camera" | "Display" | "Objects" | "Tools" | "Application";
  /** Other words by which a person may look for it. */
  readonly words?: string;
}

export const kShortcuts: readonly Shortcut[] = [
  { action: "view.front", keys: "1", title: "Front view", group: "Camera" },
  { action: "view.back", keys: "Ctrl+1", title: "Back view", group: "Camera" },
  { action: "view.right", keys: "3", title: "Right view", group: "Camera" },
  { action: "view.left", keys: "Ctrl+3", title: "Left view", group: "Camera" },
  { action: "view.top", keys: "7", title: "Top view", group: "Camera" },
  { action: "view.bottom", keys: "Ctrl+7", title: "Bottom view", group: "Camera" },
  { action: "view.isometric", keys: "9", title: "Isometric view", group: "Camera" },
  { action: "turn.up", keys: "2", title: "Turn up by 90°", group: "Camera", words: "elevation roll" },
  { action: "turn.down", keys: "8", title: "Turn down by 90°", group: "Camera", words: "elevation roll" },
  { action: "roll.left", keys: "4", title: "Roll left by 90°", group: "Camera" },
  { action: "roll.right", keys: "6", title: "Roll right by 90°", group: "Camera" },
  { action: "projection", keys: "5", title: "Orthographic or perspective", group: "Camera" },
  {
    action: "home",
    keys: "Enter",
    title: "Standard view: see everything",
    group: "Camera",
    words: "reset home centre",
  },
  {
    action: "back",
    keys: "Backspace",
    title: "Back to the view before",
    group: "Camera",
    words: "return previous",
  },
  { action: "fit", keys: "Home", title: "Fit everything", group: "Camera", words: "zoom all auto-fit" },
  {
    action: "fit.selection",
    keys: ".",
    title: "Fit the selection",
    group: "Camera",
    words: "zoom focus centre",
  },
  { action: "orbit.left", keys: "ArrowLeft", title: "Rotate left", group: "Camera" },
  { action: "orbit.right", keys: "ArrowRight", title: "Rotate right", group: "Camera" },
  { action: "orbit.up", keys: "ArrowUp", title: "Rotate up", group: "Camera" },
  { action: "orbit.down", keys: "ArrowDown", title: "Rotate down", group: "Camera" },
  { action: "pan.left", keys: "Shift+ArrowLeft", title: "Move left", group: "Camera" },
  { action: "pan.right", keys: "Shift+ArrowRight", title: "Move right", group: "Camera" },
  { action: "pan.up", keys: "Shift+ArrowUp", title: "Move up", group: "Camera" },
  { action: "pan.down", keys: "Shift+ArrowDown", title: "Move down", group: "Camera" },
  { action: "zoom.in", keys: "+ =", title: "Closer", group: "Camera", words: "zoom in" },
  { action: "zoom.out", keys: "-", title: "Farther", group: "Camera", words: "zoom out" },
  { action: "trackball", keys: "k", title: "Turntable or trackball", group: "Camera" },

  {
    action: "edges",
    keys: "e",
    title: "Edges: none, of the shape, all",
    group: "Display",
    words: "wireframe grid",
  },
  { action: "faces", keys: "w", title: "Faces on or off", group: "Display", words: "wireframe solid" },
  { action: "vertices", keys: "Shift+v", title: "Vertices on or off", group: "Display", words: "points" },
  {
    action: "shading",
    keys: "f",
    title: "Shading: smooth, flat, without light",
    group: "Display",
    words: "lighting unlit",
  },
  { action: "axes", keys: "x", title: "Axes", group: "Display", words: "trihedron" },
  { action: "grid", keys: "g", title: "Grid", group: "Display" },
  { action: "boxes", keys: "Shift+x", title: "Bounding boxes", group: "Display" },
  { action: "scale", keys: "Shift+g", title: "Scale bar", group: "Display" },
  { action: "legend", keys: "b", title: "Legend of colours", group: "Display", words: "scalar bar" },
  {
    action: "coloring",
    keys: "s",
    title: "Next colouring",
    group: "Display",
    words: "attribute gradient position",
  },
  { action: "boundary", keys: "o", title: "Boundary edges", group: "Display", words: "holes defects" },
  { action: "nonmanifold", keys: "Shift+o", title: "Non-manifold edges", group: "Display", words: "defects" },
  { action: "opacity.more", keys: "Ctrl+p", title: "More opaque", group: "Display", words: "transparency" },
  { action: "opacity.less", keys: "Shift+p", title: "More transparent", group: "Display", words: "opacity" },
  { action: "light.more", keys: "l", title: "Brighter light", group: "Display" },
  { action: "light.less", keys: "Shift+l", title: "Dimmer light", group: "Display" },
  {
    action: "explode",
    keys: "d",
    title: "Explode or join the objects",
    group: "Display",
    words: "components",
  },

  {
    action: "sheet",
    keys: "Shift+d",
    title: "Contact sheet, or the objects in their places",
    group: "Display",
    words: "grid arrange overview",
  },

  { action: "hide", keys: "h", title: "Hide the selection", group: "Objects" },
  { action: "isolate", keys: "i", title: "Show only the selection", group: "Objects" },
  {
    action: "ghost",
    keys: "Shift+i",
    title: "Ghost all but the selection",
    group: "Objects",
    words: "transparent context",
  },
  { action: "show.all", keys: "Shift+h", title: "Show all objects", group: "Objects" },
  { action: "select.none", keys: "Escape", title: "Select nothing, end the tool", group: "Objects" },
  { action: "select.next", keys: "n", title: "Select the next object", group: "Objects" },
  { action: "select.previous", keys: "p", title: "Select the previous object", group: "Objects" },

  { action: "section", keys: "c", title: "Section plane", group: "Tools", words: "clip cut slice" },
  {
    action: "section.forward",
    keys: "PageUp",
    title: "Move the section forwards",
    group: "Tools",
    words: "slice",
  },
  {
    action: "section.back",
    keys: "PageDown",
    title: "Move the section back",
    group: "Tools",
    words: "slice",
  },
  { action: "measure", keys: "m", title: "Measure", group: "Tools", words: "distance angle ruler" },
  { action: "inspect", keys: "v", title: "Inspect triangles and vertices", group: "Tools" },

  { action: "undo", keys: "Ctrl+z", title: "Undo", group: "Application", words: "back" },
  { action: "redo", keys: "Ctrl+Shift+z Ctrl+y", title: "Redo", group: "Application", words: "again" },
  {
    action: "screenshot",
    keys: "F12",
    title: "Screenshot as PNG",
    group: "Application",
    words: "picture image",
  },
  {
    action: "screenshot.transparent",
    keys: "Ctrl+F12",
    title: "Screenshot with transparent background",
    group: "Application",
  },
  {
    action: "shortcuts",
    keys: "?",
    title: "This list of shortcuts",
    group: "Application",
    words: "help keys",
  },
];

/** The name of a pressed key as in the table. */
export function keyName(
  event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">,
): string {
  const { key } = event;
  const named = key.length > 1;
  const letter = /^[a-z]$/i.test(key);
  const parts: string[] = [];
  if (event.ctrlKey || event.metaKey) parts.push("Ctrl");
  if (event.altKey) parts.push("Alt");
  // Of other characters Shift is already a part.
  if (event.shiftKey && (named || letter)) parts.push("Shift");
  parts.push(letter ? key.toLowerCase() : key);
  return parts.join("+");
}

export function shortcutOf(name: string): Shortcut | undefined {
  return kShortcuts.find(({ keys }) => keys.split(" ").includes(name));
}

/** The shortcuts that have all words of a text in their title, group, keys or other words. */
export function searchShortcuts(text: string): Shortcut[] {
  const wanted = text.toLowerCase().split(/\s+/).filter(Boolean);
  return kShortcuts.filter((shortcut) => {
    const all = [shortcut.title, shortcut.group, shortcut.keys, shortcut.words ?? ""].join(" ").toLowerCase();
    return wanted.every((word) => all.includes(word));
  });
}
