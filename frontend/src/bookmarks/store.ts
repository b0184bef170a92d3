/** The bookmarks of the project that is open: kept on the server for user and project. */
import { create } from 'zustand';
import { useProject } from '@/project/openProject';
import { loadSetting } from '@/session/preferences';
import { saveSettingLater, saveSettingNow } from '@/session/settingsLater';
import { notifyError } from '@/ui/notices';
import { fromStored, isIn, keyOf, toggled, type Bookmark, type TextPart } from './model';

interface BookmarkState {
  projectId: string | null;
  /** What is stored has arrived. */
  loaded: boolean;
  bookmarks: readonly Bookmark[];
}

export const useBookmarks = create<BookmarkState>(() => ({ projectId: null, loaded: false, bookmarks: [] }));

/** While one types, lines move with every Enter. */
const SAVE_AFTER_MS = 800;

/** Loads the bookmarks of each project that is opened. */
export function followProject(): void {
  const load = async (projectId: string | null) => {
    if (projectId === useBookmarks.getState().projectId) return;
    const before = useBookmarks.getState().projectId;
    if (before !== null) saveSettingNow(keyFor(before));
    useBookmarks.setState({ projectId, loaded: false, bookmarks: [] });
    if (projectId === null) return;
    const stored = fromStored(await loadSetting(keyFor(projectId)));
    const now = useBookmarks.getState();
    if (now.projectId !== projectId || now.loaded) return;
    // What was set while loading is not lost.
    const known = new Set(now.bookmarks.map(keyOf));
    const joined = [...stored.filter((mark) => !known.has(keyOf(mark))), ...now.bookmarks];
    useBookmarks.setState({ loaded: true, bookmarks: joined });
    if (now.bookmarks.length > 0) save(0);
  };
  const start = (projectId: string | null) => void load(projectId).catch(notifyError);
  start(useProject.getState().projectId);
  useProject.subscribe((state) => start(state.projectId));
}

function keyFor(projectId: string): string {
  return `bookmarks.${projectId}`;
}

/** Stores the bookmarks, but not in place of those that have not arrived yet. */
function save(after: number): void {
  const { projectId, loaded, bookmarks } = useBookmarks.getState();
  if (projectId !== null && loaded) saveSettingLater(keyFor(projectId), () => bookmarks, after, notifyError);
}

export function changeBookmarks(change: (bookmarks: readonly Bookmark[]) => readonly Bookmark[], wait = 0): void {
  const before = useBookmarks.getState().bookmarks;
  const next = change(before);
  if (next === before) return;
  useBookmarks.setState({ bookmarks: next });
  save(wait);
}

/** Lines have moved under the bookmarks. */
export function moveBookmarks(change: (bookmarks: readonly Bookmark[]) => readonly Bookmark[]): void {
  changeBookmarks(change, SAVE_AFTER_MS);
}

export function toggleBookmark(at: Bookmark): void {
  changeBookmarks((bookmarks) => toggled(bookmarks, at));
}

/** Takes bookmarks away: those of a text, of an object, or all. */
export function clearBookmarks(gone: (mark: Bookmark) => boolean): void {
  changeBookmarks((bookmarks) => {
    const left = bookmarks.filter((mark) => !gone(mark));
    return left.length === bookmarks.length ? bookmarks : left;
  });
}

/** Lines of a text that have a bookmark, sorted; a text that shows the same lines is not drawn again. */
export function linesOf(bookmarks: readonly Bookmark[], of: TextPart): string {
  return bookmarks
    .filter((mark) => isIn(mark, of))
    .map(({ line }) => line)
    .sort((a, b) => a - b)
    .join();
}
