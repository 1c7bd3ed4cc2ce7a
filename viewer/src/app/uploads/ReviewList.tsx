import { useEffect, useRef, useState } from "preact/hooks";
import type { Json, Row } from "../../api/types";
import type { Outcome } from "../../state/outcome";
import { summaryOf } from "../../state/outcome";
import { objectName, type Review } from "../../state/uploads";
import { useApp } from "../context";
import { bytesText, shortNumber } from "../table/format";
import { IconButton } from "../ui/controls";
import { Icon } from "../ui/Icon";
import { useNameForm } from "../ui/name_form";
import { NameField } from "../ui/NameField";

/** The dropped files that are being looked at. */
export function ReviewList() {
  const reviews = useApp().workspace.uploads.reviews.value;
  const place = useRef<HTMLDivElement>(null);
  // The newest one is the first.
  useEffect(() => place.current?.scrollTo(0, 0), [reviews[0]]);
  return (
    <div class="reviews" ref={place}>
      <ImportLine reviews={reviews} />
      {reviews.map((review) => (
        <ReviewCard key={review.key} review={review} />
      ))}
    </div>
  );
}

const phases = {
  sending: "Sending",
  reading: "Reading the file",
  repairing: "Repairing",
  ready: "",
  failed: "",
} as const;

function ReviewCard({ review }: { review: Review }) {
  const { uploads } = useApp().workspace;
  const phase = review.phase.value;
  // On a narrow page the card lies over the scene, which is what a person wants to see first.
  const [open, setOpen] = useState(() => !review.isOfMany && !matchMedia("(max-width: 760px)").matches);
  const shown = open || phase === "failed";
  return (
    <section
      class="review"
      aria-label={review.fileName}
      data-testid="review"
      data-phase={phase}
      data-open={shown}
    >
      <div class="panel-head">
        <IconButton
          small
          icon={shown ? "chevronDown" : "chevronRight"}
          expanded={shown}
          label={`Details of ${review.fileName}`}
          onClick={() => setOpen(!shown)}
        />
        <h3 class="panel-title ellipsis grow">{review.fileName}</h3>
        <span class="muted">{shown ? bytesText(review.bytes) : verdictOf(review)}</span>
        <IconButton
          small
          icon="close"
          label={`Close ${review.fileName}`}
          onClick={() => uploads.close(review)}
        />
      </div>
      <div class="review-body" hidden={!shown}>
        {phase === "failed" && <p class="error-text">{review.problem.value}</p>}
        {phases[phase] && (
          <div>
            <div class="row">
              <div class="muted grow">{phases[phase]}…</div>
              <button type="button" class="btn small danger" onClick={review.stop}>
                <Icon name="stop" /> Stop
              </button>
            </div>
            <div class={`progress${phase === "sending" ? "" : " unknown"}`}>
              <div style={phase === "sending" ? { width: `${review.sent.value * 100}%` } : undefined} />
            </div>
          </div>
        )}
        {review.asIs.value && <ShownLine label="As it is" outcome={review.asIs.value} />}
        {review.repaired.value && <ShownLine label="Repaired" outcome={review.repaired.value} />}
        <ChangesLine review={review} />
        {review.report.value && <Report outcome={review.report.value} isEmpty={hasNoTriangles(review)} />}
        {phase === "ready" && <SideBySide review={review} />}
        {phase === "ready" && <StoreLine review={review} />}
      </div>
    </section>
  );
}

/** The outcome in a word or two. */
function verdictOf(review: Review): string {
  const phase = review.phase.value;
  if (phases[phase]) return `${phases[phase]}…`;
  const rows = (review.report.value?.answer.value ?? []) as readonly Row[];
  const found = rows.filter(({ Phase }) => Phase === "found").length;
  if (found > 0) return found === 1 ? "1 kind of defect" : `${found} kinds of defects`;
  return hasNoTriangles(review) ? "no faces" : "no defects";
}

/** A form of the mesh with its size, shown or hidden in 3D. */
function ShownLine({ label, outcome }: { label: string; outcome: Outcome }) {
  const { results } = useApp().store;
  const shown = outcome.shown.value.size > 0;
  const summary = summaryOf(outcome.answer.value);
  return (
    <div class="review-line">
      <IconButton
        small
        icon={shown ? "eye" : "eyeOff"}
        pressed={shown}
        label={`Show ${label} in 3D`}
        onClick={() => results.show(outcome, !shown)}
      />
      <button type="button" class="link-button" onClick={() => (results.activeKey.value = outcome.key)}>
        {label}
      </button>
      <span class="muted ellipsis grow">{summary ? `${summary.type}, ${summary.count}` : "undefined"}</span>
    </div>
  );
}

/** The triangles that the repair added and took away, marked in 3D while a form of the mesh is shown. */
function ChangesLine({ review }: { review: Review }) {
  const { store, workspace } = useApp();
  const scene = workspace.scene.value?.view;
  const changes = review.changes.value;
  const [wanted, setWanted] = useState(true);
  const isDrawn = (outcome: Outcome | null) =>
    outcome !== null && outcome.shown.value.size > 0 && store.results.list.value.includes(outcome);
  const drawn = [review.asIs.value, review.repaired.value].some(isDrawn);
  const shown = wanted && drawn;
  useEffect(() => {
    if (!scene || !changes || !shown) return;
    const names = [`${review.key} added`, `${review.key} removed`] as const;
    scene.setMarkers(names[0], { triangles: changes.added, color: "#2fbf71" });
    scene.setMarkers(names[1], { triangles: changes.removed, color: "#e5484d" });
    return () => names.forEach((name) => scene.setMarkers(name, null));
  }, [scene, changes, shown]);
  if (!changes) return null;
  return (
    <div class="review-line">
      <IconButton
        small
        icon={shown ? "eye" : "eyeOff"}
        pressed={shown}
        label="Mark the changed triangles"
        disabled={!drawn}
        onClick={() => setWanted(!wanted)}
      />
      <span>Changes</span>
      <span class="grow" />
      <span class="added">+{changes.added.length.toLocaleString("en")}</span>
      <span class="removed">−{changes.removed.length.toLocaleString("en")}</span>
    </div>
  );
}

/** Shows the file and its repair in the split screen. */
function SideBySide({ review }: { review: Review }) {
  const { workspace } = useApp();
  const show = (side: "left" | "right", outcome: Outcome | null) => {
    if (outcome?.resultId) workspace.compare(side, { result: outcome.resultId, row: 0, column: "value" });
  };
  return (
    <button
      type="button"
      class="btn"
      onClick={() => {
        show("left", review.asIs.value);
        show("right", review.repaired.value);
      }}
    >
      <Icon name="split" /> Side by side
    </button>
  );
}

/** Whether there is nothing in the file that could be a defect or a solid. */
function hasNoTriangles({ asIs }: Review): boolean {
  const value = asIs.value?.answer.value as Readonly<Record<string, Json>> | null | undefined;
  return value?.["faces"] === 0;
}

/** Files that came together as one relation. */
function ImportLine({ reviews }: { reviews: readonly Review[] }) {
  const { store, workspace } = useApp();
  const [newest] = reviews;
  const ready = reviews.filter(({ batch, phase }) => batch === newest?.batch && phase.value === "ready");
  const [first] = useState(() =>
    objectName(
      "Parts",
      store.catalogue.objects.value.map((object) => object.name),
    ),
  );
  // The order in which they came.
  const form = useNameForm(first, (name) => workspace.uploads.storeAll([...ready].reverse(), name));
  const { readOnly } = store.connection.info.value ?? { readOnly: false };
  if (ready.length < 2) return null;
  return (
    <form class="review review-all" onSubmit={form.submit} data-testid="import-all">
      <span class="grow">{ready.length} files as a relation</span>
      <NameField form={form} label="Name of the new relation" size={12} />
      <button
        type="submit"
        class="btn primary"
        disabled={!form.canSubmit || readOnly}
        title={workspace.uploads.relationOf(ready)}
      >
        <Icon name="save" /> Import
      </button>
    </form>
  );
}

/** What the import found and changed. */
function Report({ outcome, isEmpty }: { outcome: Outcome; isEmpty: boolean }) {
  const rows = (outcome.answer.value ?? []) as readonly Row[];
  const told = rows.filter(({ Phase }) => Phase === "found" || Phase === "changed");
  if (told.length === 0 && isEmpty)
    return (
      <p class="callout warning">The file has no faces: there is nothing to see, and the solid is empty.</p>
    );
  if (told.length === 0)
    return (
      <p class="review-good">
        <Icon name="cube" /> No defects: a valid solid.
      </p>
    );
  return (
    <table class="report">
      <thead>
        <tr>
          <th scope="col" colSpan={2}>
            Found and changed
          </th>
          <th scope="col" class="number">
            Count
          </th>
          <th scope="col" class="number" title="The largest distance, in the units of the file">
            Moved by up to
          </th>
        </tr>
      </thead>
      <tbody>
        {told.map(({ Phase, What, Count, Amount }, index) => (
          <tr key={index} class={text(Phase)}>
            <td>{text(Phase)}</td>
            <td>{text(What)}</td>
            <td class="number">{typeof Count === "number" ? Count.toLocaleString("en") : ""}</td>
            <td class="number muted">{typeof Amount === "number" ? `${shortNumber(Amount)} units` : ""}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

const text = (value: Json | undefined) => (typeof value === "string" ? value : "");

function StoreLine({ review }: { review: Review }) {
  const { store, workspace } = useApp();
  const [first] = useState(() => {
    const taken = store.catalogue.objects.value.map((object) => object.name);
    return objectName(review.fileName, taken);
  });
  const form = useNameForm(first, (name) => workspace.uploads.store(review, name));
  const { readOnly } = store.connection.info.value ?? { readOnly: false };
  return (
    <form class="review-line" onSubmit={form.submit}>
      <NameField form={form} label="Name of the new object" />
      <button
        type="submit"
        class="btn primary"
        disabled={!form.canSubmit || readOnly}
        title="Stores the repaired solid"
      >
        <Icon name="save" /> Store
      </button>
    </form>
  );
}
