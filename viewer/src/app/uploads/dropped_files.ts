/** The files that were dropped, and those of dropped folders, sorted by their paths. */
export async function droppedFiles(transfer: DataTransfer): Promise<readonly File[]> {
  // Entries can be had during the event only.
  const entries = [...transfer.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  const files = [...transfer.files];
  if (!entries.some(({ isDirectory }) => isDirectory)) return files;
  const found: FileSystemFileEntry[] = [];
  const open = [...entries];
  for (let entry = open.pop(); entry; entry = open.pop())
    if (entry.isDirectory) open.push(...(await contentOf(entry as FileSystemDirectoryEntry)));
    else found.push(entry as FileSystemFileEntry);
  found.sort((a, b) => a.fullPath.localeCompare(b.fullPath, "en", { numeric: true }));
  return Promise.all(found.map((entry) => new Promise<File>((take, fail) => entry.file(take, fail))));
}

/** Chosen files in the order in which they were chosen, those of a folder by their paths. */
export function sortedByPath(files: Iterable<File>): readonly File[] {
  return [...files].sort((a, b) =>
    a.webkitRelativePath.localeCompare(b.webkitRelativePath, "en", { numeric: true }),
  );
}

/** A folder is read in parts; an empty part is the last. */
async function contentOf(folder: FileSystemDirectoryEntry): Promise<readonly FileSystemEntry[]> {
  const reader = folder.createReader();
  const content: FileSystemEntry[] = [];
  for (;;) {
    const part = await new Promise<FileSystemEntry[]>((take, fail) => reader.readEntries(take, fail));
    if (part.length === 0) return content;
    content.push(...part);
  }
}
