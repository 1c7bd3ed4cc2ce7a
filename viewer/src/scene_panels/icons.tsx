/** Icons of the scene's bar, as strokes on a grid of 16. */
const kPaths = {
  home: "M2.5 7.5 8 3l5.5 4.5M4 6.5V13h8V6.5M6.8 13V9.5h2.4V13",
  back: "M6.5 3.5 2.5 7.5l4 4M2.8 7.5h7a3.5 3.5 0 0 1 0 7H8",
  fit: "M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3M5.5 5.5h5v5h-5z",
  isometric: "M8 1.8 13.5 5v6L8 14.2 2.5 11V5zM2.5 5 8 8.2 13.5 5M8 8.2v6",
  front: "M2.5 5.5h8v8h-8zM2.5 5.5l3-3h8v8l-3 3M10.5 5.5l3-3M4 7l5 5M4 12l5-5",
  right: "M2.5 5.5h8v8h-8zM2.5 5.5l3-3h8v8l-3 3M10.5 5.5l3-3M11 7l2-2M11 10l2.3-2.3M11 12.6l2.3-2.3",
  top: "M2.5 5.5h8v8h-8zM2.5 5.5l3-3h8v8l-3 3M10.5 5.5l3-3M5 5.2l2-2.4M7.5 5.2l2-2.4M10 5.2l2-2.4",
  perspective: "M5 6h6l2.5 6.5h-11zM5 6 4 9.5M8 6v6.5M4 9.2h8M11 6l1 3.5",
  orthographic: "M3 3.5h10v9H3zM3 8h10M8 3.5v9",
  section: "M3 13V5l5-2.5L13 5v8M1.5 9.5h13M5 9.5v3M8 9.5v3M11 9.5v3",
  measure: "M2 11.5 11.5 2 14 4.5 4.5 14zM5 8.5l1.3 1.3M7 6.5l1.8 1.8M9 4.5l1.3 1.3",
  inspect: "M8 3 14 13H2zM8 3l.1 0M2 13h.1M14 13h.1M8 9.5h.01",
  edges: "M8 1.8 13.5 5v6L8 14.2 2.5 11V5zM2.5 5 8 8.2 13.5 5M8 8.2v6M8 8.2 2.5 11M8 8.2 13.5 11M8 8.2V1.8",
  camera: "M2.5 5h2.7l1-1.5h3.6l1 1.5h2.7v7.5h-11zM8 6.3a2.4 2.4 0 1 0 0 4.8 2.4 2.4 0 0 0 0-4.8z",
  keys: "M1.5 4.5h13v7h-13zM4 7h.01M6.5 7h.01M9 7h.01M11.8 7h.01M5 9.5h6",
  grid: "M2.5 2.5h11v11h-11zM2.5 6.2h11M2.5 9.8h11M6.2 2.5v11M9.8 2.5v11",
} as const;

export type SceneIconName = keyof typeof kPaths;

export function SceneIcon({ name }: { name: SceneIconName }) {
  return (
    <svg class="icon-svg" viewBox="0 0 16 16" aria-hidden="true">
      <path d={kPaths[name]} />
    </svg>
  );
}
