/** What the views of a cam share: the cam as it is shown, what is selected, and how it is changed. */
import type { CamTable, Values } from './camTable';
import type { CamDrawing } from './curves';
import type { GraphName, Range } from './plot';
import type { Selected } from './rows';

export type Tool = 'select' | 'add';

export interface GraphLayout {
  /** Closed graphs are a line of text (CAM-32). */
  closed: Readonly<Partial<Record<GraphName, boolean>>>;
  /** Parts of the height. */
  share: Readonly<Record<GraphName, number>>;
  /** What is shown of the master; null: all of it. */
  window: Range | null;
}

export const WHOLE: GraphLayout = { closed: {}, share: { y: 2, v: 1, a: 1, j: 1 }, window: null };

export interface CamEdit {
  /** With what is being dragged. */
  cam: CamTable;
  drawing: CamDrawing | null;
  /** Nothing can be changed. */
  locked: boolean;
  selected: Selected | null;
  select: (selected: Selected | null) => void;
  /** A step that can be undone. */
  change: (cam: CamTable, selected?: Selected | null) => void;
  /** Shows another cam until it is taken by `change` or dropped by null: an act under way is no step. */
  preview: (cam: CamTable | null, selected?: Selected) => void;
  valuesAt: (x: number) => Promise<Values>;
  /** The runtime in which blocks follow the cam now; null while logged out. */
  running: { runtimeId: string; followers: readonly string[] } | null;
}
