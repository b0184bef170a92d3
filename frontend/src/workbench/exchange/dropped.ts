/** Files that are dropped or chosen, folders walked through, each with its path. */
import { readable } from './model';

export interface NamedFile {
  path: string;
  file: File;
}

/** What was dropped; must be called in the drop event itself, because the browser forgets it afterwards. */
export async function droppedFiles(data: DataTransfer): Promise<NamedFile[]> {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  if (entries.length === 0) return [...data.files].map((file) => ({ path: file.name, file }));
  const found: NamedFile[] = [];
  const loose: NamedFile[] = [];
  for (const entry of entries) {
    if (entry.isDirectory) found.push(...(await filesIn(entry as FileSystemDirectoryEntry)));
    else loose.push({ path: entry.name, file: await fileOf(entry as FileSystemFileEntry) });
  }
  return [...loose, ...ofFolders(found)];
}

/** Files of a file dialog; those of a folder are filtered. */
export function chosenFiles(files: Iterable<File>): NamedFile[] {
  const all = [...files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
  return all.some(({ file }) => file.webkitRelativePath) ? ofFolders(all) : all;
}

function ofFolders(files: readonly NamedFile[]): NamedFile[] {
  const wanted = new Set(readable(files.map(({ path }) => path)));
  return files.filter(({ path }) => wanted.has(path));
}

async function filesIn(folder: FileSystemDirectoryEntry): Promise<NamedFile[]> {
  const found: NamedFile[] = [];
  const waiting: FileSystemDirectoryEntry[] = [folder];
  for (let next = waiting.shift(); next; next = waiting.shift()) {
    for (const entry of await entriesOf(next)) {
      if (entry.isDirectory) waiting.push(entry as FileSystemDirectoryEntry);
      else {
        const path = entry.fullPath.replace(/^\//, '');
        found.push({ path, file: await fileOf(entry as FileSystemFileEntry) });
      }
    }
  }
  return found;
}

/** The browser gives the entries of a folder in portions, an empty one at the end. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  for (;;) {
    const part = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (part.length === 0) return found;
    found.push(...part);
  }
}

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((resolve, reject) => entry.file(resolve, reject));
}

/** The files as a form for the server, with their paths. */
export function formOf(files: readonly NamedFile[]): FormData {
  const form = new FormData();
  for (const { path, file } of files) form.append('files', file, path);
  return form;
}
