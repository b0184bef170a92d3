/** What is seen of a trace: which run, which part, with which tools. */
import type { Node } from './configuration';
import type { Computed } from './diagram/diagrams';
import { FIRST_VIEWS, type Views } from './diagram/viewport';

export type Tool = 'scroll' | 'zoom';
export const PANELS = ['measure', 'statistics', 'spectrum', 'xy', 'compare', 'recordings'] as const;
export type PanelId = (typeof PANELS)[number];

/** A recording drawn over what is shown, moved by so many nanoseconds. */
export interface Overlay {
  id: string;
  shift: number;
}

export interface TraceView {
  /** The recording that is shown; null: what the controller records. */
  shown: string | null;
  overlays: readonly Overlay[];
  views: Views;
  tool: Tool;
  multi: boolean;
  /** Moments of none, one or two cursors, in nanoseconds. */
  cursors: readonly number[];
  /** The diagram that keys act on. */
  diagram: string | null;
  panel: PanelId | null;
  computed: readonly Computed[];
  nodes: readonly Node[];
}

export const FIRST_VIEW: TraceView = {
  shown: null,
  overlays: [],
  views: FIRST_VIEWS,
  tool: 'scroll',
  multi: false,
  cursors: [],
  diagram: null,
  panel: null,
  computed: [],
  nodes: [],
};

/** No cursor, one, two, none again (TRC-81): they come into the middle and the last quarter of what is seen. */
export function nextCursors(cursors: readonly number[], seen: { min: number; max: number }): number[] {
  const at = (part: number) => seen.min + part * (seen.max - seen.min);
  if (cursors.length === 0) return [at(0.5)];
  if (cursors.length === 1) return [cursors[0]!, at(0.75)];
  return [];
}
