import { useState } from "preact/hooks";
import { examplesOf, largestRelation } from "../state/first_page";
import { listedFormats } from "../state/mesh_formats";
import { useApp } from "./context";
import { IconButton } from "./ui/controls";
import { Icon } from "./ui/Icon";
import { startTour } from "./Tour";

/**
 * What to begin with, over the rows of the table, whose header stays free, while nothing was run yet: the scene keeps its
 * size when it goes.
 */
export function StartPanel() {
  const { store, workspace } = useApp();
  const [closed, setClosed] = useState(false);
  const { list } = store.results;
  const isStart = list.value.every(({ isPreview }) => isPreview);
  const info = store.connection.info.value;
  if (closed || !isStart || !store.isLoaded.value || !info) return null;
  const objects = store.catalogue.objects.value;
  const formats = listedFormats(store.catalogue.formats.value);
  const relation = largestRelation(objects);
  return (
    <section class="start-panel" aria-label="To begin with" data-testid="start">
      <div class="row">
        <strong class="grow">{titleOf(objects.length, relation?.name, info)}</strong>
        <IconButton small icon="close" label="Close the first page" onClick={() => setClosed(true)} />
      </div>
      <ul class="examples">
        {examplesOf(objects, info.readOnly).map(({ title, statement }) => (
          <li key={statement}>
            <button
              type="button"
              class="btn"
              title={statement}
              onClick={() => void workspace.tryStatement(statement)}
            >
              <Icon name="play" /> {title}
            </button>
          </li>
        ))}
        <li>
          <button
            type="button"
            class="btn"
            title={`${formats} files, or a folder of them`}
            onClick={() => workspace.chooseFiles()}
          >
            <Icon name="upload" /> Drop a file, or choose one
          </button>
        </li>
        <li>
          <button type="button" class="btn" onClick={startTour}>
            <Icon name="help" /> Two-minute tour
          </button>
        </li>
      </ul>
    </section>
  );
}

function titleOf(
  objects: number,
  relation: string | undefined,
  { database, readOnly }: { readonly database: string; readonly readOnly: boolean },
): string {
  const suffix = readOnly ? " It is read-only: nothing can be stored." : "";
  if (objects === 0) return `The database ${database} is empty.${suffix}`;
  if (relation) return `${relation}, the largest relation with geometry in ${database}.${suffix}`;
  return `${database} has ${objects === 1 ? "1 object" : `${objects} objects`}.${suffix}`;
}
