import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";

interface Stop {
  /** The part of the page that is told of. */
  readonly place: string;
  readonly title: string;
  readonly text: string;
}

const kStops: readonly Stop[] = [
  {
    place: '[data-testid="scene"]',
    title: "The scene",
    text: "Drag to turn, with the right button to move, and turn the wheel to come closer. Click an object to select it; its row is selected with it.",
  },
  {
    place: '[data-testid="editor"]',
    title: "Statements",
    text: "Each table comes from a statement. Write one and press Ctrl+Enter; Ctrl+Space completes names. What it brings is shown in the scene and in the table.",
  },
  {
    place: '[data-testid="objects"]',
    title: "Objects and operators",
    text: "What is in the database; a click shows it. Beside it is the list of operators with examples, and what was run before.",
  },
  {
    place: ".results-panel",
    title: "Results",
    text: "Rows of the table are objects of the scene. The button in the head of a column colours them by its values; the eye shows and hides geometry.",
  },
  {
    place: '[data-testid="scene-tools"]',
    title: "Tools",
    text: "Cut with a plane, measure, and look at single triangles: the numbers are exact, and each is shown with its query. Objects stand in place, on a contact sheet, or apart.",
  },
  {
    place: 'button[aria-label="Copy link"]',
    title: "Nothing is lost",
    text: "The address always has the present view: a reload, Back and a copied link bring it again. Ctrl+Z takes back a change of the view.",
  },
];

const at = signal<number | null>(null);

export function startTour(): void {
  at.value = 0;
}

/** Tells of the parts of the page, one after the other; it can be left at any time. */
export function Tour() {
  const stop = at.value === null ? undefined : kStops[at.value];
  const box = useBoxOf(stop?.place);
  if (!stop || at.value === null) return null;
  const number = at.value;
  const go = (to: number) => (at.value = to < kStops.length ? Math.max(0, to) : null);
  return (
    <>
      {box && (
        <div
          class="tour-frame"
          aria-hidden="true"
          style={{
            left: `${box.x}px`,
            top: `${box.y}px`,
            width: `${box.width}px`,
            height: `${box.height}px`,
          }}
        />
      )}
      <section
        class="tour"
        role="dialog"
        aria-label="Tour"
        data-testid="tour"
        onKeyDown={(event) => event.key === "Escape" && (at.value = null)}
      >
        <strong>{stop.title}</strong>
        <p role="status">{stop.text}</p>
        <div class="row">
          <span class="muted grow">
            {number + 1} of {kStops.length}
          </span>
          <button type="button" class="btn quiet" onClick={() => (at.value = null)}>
            Leave
          </button>
          {number > 0 && (
            <button type="button" class="btn" onClick={() => go(number - 1)}>
              Back
            </button>
          )}
          <button type="button" class="btn primary" autofocus onClick={() => go(number + 1)}>
            {number + 1 < kStops.length ? "Next" : "Done"}
          </button>
        </div>
      </section>
    </>
  );
}

/** Where an element stands on the page; null if it is not seen. */
function useBoxOf(place: string | undefined): DOMRect | null {
  const [box, setBox] = useState<DOMRect | null>(null);
  useEffect(() => {
    const look = () => {
      const found = place ? document.querySelector(place)?.getBoundingClientRect() : null;
      setBox(found && found.width > 0 ? found : null);
    };
    look();
    addEventListener("resize", look);
    return () => removeEventListener("resize", look);
  }, [place]);
  return box;
}
