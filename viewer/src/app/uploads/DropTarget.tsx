import { useEffect, useRef, useState } from "preact/hooks";
import { useApp } from "../context";
import { Icon } from "../ui/Icon";
import { droppedFiles, sortedByPath } from "./dropped_files";
import { listedFormats } from "../../state/mesh_formats";

/** Takes files that are dropped on the page, and those that are chosen by the button in the head. */
export function DropTarget() {
  const { store, workspace } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  useEffect(() => {
    workspace.chooseFiles = () => input.current?.click();
    workspace.chooseFolder = () => folder.current?.click();
    // Not among the attributes that Preact knows.
    folder.current?.setAttribute("webkitdirectory", "");
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    const onOver = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(true);
    };
    const onLeave = (event: DragEvent) => {
      if (event.relatedTarget === null) setOver(false);
    };
    const onDrop = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(false);
      if (event.dataTransfer)
        void droppedFiles(event.dataTransfer).then((files) => workspace.uploads.take(files));
    };
    addEventListener("dragover", onOver);
    addEventListener("dragleave", onLeave);
    addEventListener("drop", onDrop);
    return () => {
      removeEventListener("dragover", onOver);
      removeEventListener("dragleave", onLeave);
      removeEventListener("drop", onDrop);
    };
  }, []);
  const take = ({ currentTarget }: { readonly currentTarget: HTMLInputElement }) => {
    const files = sortedByPath(currentTarget.files ?? []);
    currentTarget.value = "";
    void workspace.uploads.take(files);
  };
  return (
    <>
      <input ref={input} type="file" multiple hidden data-testid="file-input" onChange={take} />
      <input ref={folder} type="file" hidden data-testid="folder-input" onChange={take} />
      {over && (
        <div class="drop-target">
          <div>
            <Icon name="upload" />
            Drop {listedFormats(store.catalogue.formats.value)} files to look at them
          </div>
        </div>
      )}
    </>
  );
}
