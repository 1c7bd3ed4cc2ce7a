import { useState } from "preact/hooks";
import type { DatabaseObject } from "../../api/types";
import { describeType } from "../../state/types";
import { useApp } from "../context";
import { Icon, type IconName } from "../ui/Icon";
import { IconButton, SearchField } from "../ui/controls";
import { openMenu, type MenuItem } from "../ui/menu";
import type { App } from "../context";
import { listedFormats } from "../../state/mesh_formats";

const icons: Record<DatabaseObject["kind"], IconName> = {
  relation: "table",
  value: "cube",
  index: "layers",
  function: "code",
};

/** The objects of the database; a click shows the value. */
export function ObjectList() {
  const { store } = useApp();
  const [pattern, setPattern] = useState("");
  const objects = store.catalogue.objects.value;
  const wanted = pattern.toLowerCase();
  const found = objects.filter(({ name, type }) => `${name} ${type}`.toLowerCase().includes(wanted));
  return (
    <>
      <div class="list-search">
        <SearchField label="Search objects" value={pattern} onInput={setPattern} />
        <IconButton icon="refresh" label="Read the list again" onClick={() => void store.loadCatalogue()} />
      </div>
      {objects.length === 0 && (
        <p class="empty">
          The database is empty. Drop {listedFormats(store.catalogue.formats.value)} files on this page, or
          store a value with let.
        </p>
      )}
      {objects.length > 0 && found.length === 0 && <p class="empty">No object matches.</p>}
      <ul class="list" data-testid="objects">
        {found.map((object) => (
          <ObjectItem key={object.name} object={object} />
        ))}
      </ul>
    </>
  );
}

function ObjectItem({ object }: { object: DatabaseObject }) {
  const app = useApp();
  const { name, type, kind, count } = object;
  const canShow = kind === "relation" || kind === "value";
  return (
    <li class="list-row">
      <button
        type="button"
        class="list-item"
        title={canShow ? `query ${name}` : describeType(type)}
        onClick={() => (canShow ? void app.workspace.query(`query ${name}`) : app.workspace.insert(name))}
      >
        <Icon name={icons[kind]} />
        <span class="ellipsis grow">
          <strong>{name}</strong>{" "}
          <span class="muted">
            {kind === "index" ? `index of ${object.indexOf ?? "?"}` : shortType(type)}
          </span>
        </span>
        {typeof count === "number" && <span class="tag">{count.toLocaleString("en")}</span>}
        {!object.hasValue && <span class="tag">undefined</span>}
      </button>
      <IconButton
        small
        icon="more"
        label={`Actions for ${name}`}
        onClick={(event) => openMenu(event.currentTarget as HTMLElement, objectMenu(app, object))}
      />
    </li>
  );
}

function objectMenu({ store, workspace }: App, object: DatabaseObject): MenuItem[] {
  const { name, kind, type } = object;
  const items: MenuItem[] = [{ label: "Put into the editor", run: () => workspace.insert(name) }];
  if (kind === "relation") items.push({ label: "Count", run: () => void store.run(`query ${name} count`) });
  if (["volume3d", "surface3d", "mesh3d"].includes(type)) {
    items.push({ label: "Compare: to the left", run: () => workspace.compareObject("left", name) });
    items.push({ label: "Compare: to the right", run: () => workspace.compareObject("right", name) });
  }
  items.push({ label: "Write: delete", run: () => workspace.editor.value?.append(`delete ${name};`) });
  return items;
}

/** Relations by their attributes' names. */
function shortType(type: string): string {
  return describeType(type).replace(/^relation of /, "");
}
