/** Files that are dropped or chosen, folders walked through, each with its path. */
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ImportFormats } from '@/api/types';
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
  return [...loose, ...(await ofFolders(found))];
}

/** Files of a file dialog; those of a folder are filtered. */
export async function chosenFiles(files: Iterable<File>): Promise<NamedFile[]> {
  const all = [...files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
  return all.some(({ file }) => file.webkitRelativePath) ? [...(await ofFolders(all))] : all;
}

/** What an import takes; it does not change while the server runs. */
function formats(): Promise<ImportFormats> {
  return queryClient.fetchQuery({
    queryKey: keys.importFormats,
    queryFn: () => api.get('/api/v1/import-formats'),
    staleTime: Infinity,
  });
}

async function ofFolders(files: readonly NamedFile[]): Promise<readonly NamedFile[]> {
  if (files.length === 0) return files;
  const paths = files.map(({ path }) => path);
  const wanted = new Set(readable(await formats(), paths));
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

/** The files as the server gets them: called by their paths. */
export function filesToSend(files: readonly NamedFile[]): File[] {
  return files.map(({ path, file }) => new File([file], path, { type: file.type }));
}
