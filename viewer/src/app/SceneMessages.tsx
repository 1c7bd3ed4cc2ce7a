import { useEffect, useState } from "preact/hooks";
import type { LoadProgress, SceneProblem, SceneView } from "../scene/api";
import { WithCode } from "./ui/WithCode";
import { Icon } from "./ui/Icon";

/** The progress of a scene that is loading, and the reason why it cannot draw. */
function useSceneReports(view: SceneView): {
  progress: readonly LoadProgress[];
  problem: SceneProblem | null;
} {
  const [progress, setProgress] = useState(view.progress);
  const [problem, setProblem] = useState(view.problem);
  useEffect(() => {
    setProgress(view.progress);
    setProblem(view.problem);
    const ends = [
      view.on("progress", () => setProgress([...view.progress])),
      view.on("shapes", () => setProgress([...view.progress])),
      view.on("problem", setProblem),
    ];
    return () => ends.forEach((end) => end());
  }, [view]);
  return { progress, problem };
}

interface Props {
  readonly view: SceneView;
  /** Whether a failure of this result is told. */
  readonly told?: ((result: string) => boolean) | undefined;
}

/** Loading, failed loading, objects far out of sight, and a missing WebGL, drawn over a scene. */
export function SceneMessages({ view, told }: Props) {
  const { progress, problem } = useSceneReports(view);
  if (problem)
    return (
      <div class="scene-problem" role="alert" data-testid="scene-problem">
        <Icon name="warning" />
        <div>
          <strong>{problem.message}</strong>
          <p class="muted">
            <WithCode text={problem.remedy} />
          </p>
        </div>
      </div>
    );
  // A failure goes with its result.
  const shown = progress.filter(
    (each) =>
      each.phase !== "done" &&
      each.phase !== "stopped" &&
      (each.phase !== "failed" || (view.isVisible(each) && told?.(each.result) !== false)),
  );
  return (
    <>
      {shown.length > 0 && (
        <div class="scene-loading" role="status" data-testid="scene-loading">
          {shown.map((each) => (
            <LoadingLine key={`${each.result}/${each.column}`} view={view} progress={each} />
          ))}
        </div>
      )}
      <StoppedLines view={view} progress={progress} />
      <FarLine view={view} />
    </>
  );
}

/** What to do while a scene is empty; nothing while it cannot be drawn. */
export function SceneHint({ view, text }: { view: SceneView; text: string }) {
  const { problem } = useSceneReports(view);
  return problem ? null : <p class="scene-hint muted">{text}</p>;
}

/** Says that the camera has left out what is far away, and shows it on demand. */
function FarLine({ view }: { view: SceneView }) {
  const [count, setCount] = useState(view.farCount);
  useEffect(() => {
    setCount(view.farCount);
    return view.on("far", (far) => setCount(far.count));
  }, [view]);
  if (count === 0) return null;
  return (
    <p class="scene-far" role="status" data-testid="scene-far">
      {count === 1 ? "1 object is" : `${count.toLocaleString("en")} objects are`} far from the others.
      <button type="button" class="btn small" onClick={() => view.fit()}>
        Show all
      </button>
    </p>
  );
}

/** Says what was not loaded because a person stopped it, and goes on on demand. */
function StoppedLines({ view, progress }: { view: SceneView; progress: readonly LoadProgress[] }) {
  const stopped = progress.filter((each) => each.phase === "stopped" && view.isVisible(each));
  if (stopped.length === 0) return null;
  return (
    <div class="scene-loading" role="status" data-testid="scene-stopped">
      {stopped.map((each) => (
        <div key={`${each.result}/${each.column}`} class="row">
          <span class="muted grow">{each.text}</span>
          <button type="button" class="btn small" onClick={() => view.resumeLoading(each)}>
            Load the rest
          </button>
        </div>
      ))}
    </div>
  );
}

function LoadingLine({ view, progress }: { view: SceneView; progress: LoadProgress }) {
  const { phase, text, rows, rowsLoaded, fraction } = progress;
  if (phase === "failed") return <div class="error-text">{text}</div>;
  const share = rows > 1 ? rowsLoaded / rows : fraction;
  return (
    <div>
      <div class="row">
        <div class="muted grow">{text}</div>
        <button type="button" class="btn small danger" onClick={() => view.stopLoading(progress)}>
          <Icon name="stop" /> Stop loading
        </button>
      </div>
      <div class={`progress${share === null ? " unknown" : ""}`}>
        <div style={share === null ? undefined : { width: `${Math.round(share * 100)}%` }} />
      </div>
    </div>
  );
}
