/**
 * What is known about an open text object: the stored version it builds on, what is on its way to the server,
 * and whether somebody else was faster. Pure transitions; `documents.ts` carries them out.
 */

export interface TextParts {
  readonly declaration: string;
  readonly implementation: string;
}

export interface StoredVersion {
  readonly revision: number;
  readonly parts: TextParts;
}

export type DocumentPhase =
  | 'clean'
  /** Has changes that are not stored yet. */
  | 'changed'
  | 'saving'
  /** Both sides changed; the user has to choose. */
  | 'conflict'
  /** The last attempt to store failed; the text is kept as a draft on this computer. */
  | 'failed';

export interface DocumentState {
  /** The version that the text in the editor was made from. */
  readonly base: StoredVersion;
  /** The text in the editor. */
  readonly text: TextParts;
  /** What was sent and is not answered yet. */
  readonly sent: TextParts | null;
  /** Somebody else's version that the text does not build on. */
  readonly theirs: StoredVersion | null;
  readonly failure: unknown;
}

export function opened(base: StoredVersion): DocumentState {
  return { base, text: base.parts, sent: null, theirs: null, failure: null };
}

function sameParts(a: TextParts, b: TextParts): boolean {
  return a.declaration === b.declaration && a.implementation === b.implementation;
}

export function isChanged(state: DocumentState): boolean {
  return !sameParts(state.text, state.base.parts);
}

export function phaseOf(state: DocumentState): DocumentPhase {
  if (state.theirs !== null) return 'conflict';
  if (state.sent !== null) return 'saving';
  if (state.failure !== null && isChanged(state)) return 'failed';
  return isChanged(state) ? 'changed' : 'clean';
}

export function edited(state: DocumentState, text: TextParts): DocumentState {
  return sameParts(state.text, text) ? state : { ...state, text };
}

/** Whether the text should be sent now. */
export function wantsSaving(state: DocumentState): boolean {
  return isChanged(state) && state.sent === null && state.theirs === null;
}

export function savingStarted(state: DocumentState): DocumentState {
  return { ...state, sent: state.text, failure: null };
}

/** The server took what was sent; later typing stays changed on top of it. */
export function saved(state: DocumentState, stored: StoredVersion): DocumentState {
  return { ...state, base: stored, sent: null, failure: null };
}

export function savingFailed(state: DocumentState, failure: unknown): DocumentState {
  return { ...state, sent: null, failure };
}

/**
 * A version of the server that is newer than the base: by an event, or as the answer 409. An unchanged text
 * follows it; a changed one that is the same by chance only moves its base; else the user has to choose.
 */
export function newerVersion(state: DocumentState, version: StoredVersion): DocumentState {
  const known = state.theirs?.revision ?? state.base.revision;
  if (version.revision <= known) return state;
  if (!isChanged(state) && state.sent === null) return { ...state, base: version, text: version.parts, theirs: null };
  if (sameParts(version.parts, state.text)) return { ...state, base: version, theirs: null };
  if (sameParts(version.parts, state.base.parts)) return { ...state, base: version };
  // What was sent may be just this version, with the event ahead of the answer.
  if (state.sent !== null && sameParts(version.parts, state.sent)) return { ...state, base: version };
  return { ...state, theirs: version, sent: null };
}

export type Resolution = 'mine' | 'theirs' | 'merged';

/** Ends a conflict: the text is built on their version from now on, so nothing is overwritten unseen. */
export function resolved(state: DocumentState, resolution: Resolution, merged: TextParts = state.text): DocumentState {
  const theirs = state.theirs;
  if (theirs === null) return state;
  const text = resolution === 'theirs' ? theirs.parts : resolution === 'merged' ? merged : state.text;
  return { ...state, base: theirs, text, theirs: null, sent: null, failure: null };
}

/**
 * A draft found on this computer when the object is opened. It was made from `draft.base`; when the server has
 * moved on meanwhile, both versions are put before the user.
 */
export function withDraft(
  state: DocumentState,
  draft: { readonly base: StoredVersion; readonly text: TextParts },
): DocumentState {
  if (sameParts(draft.text, state.base.parts)) return state;
  if (draft.base.revision === state.base.revision || sameParts(draft.base.parts, state.base.parts)) {
    return { ...state, text: draft.text };
  }
  return { base: draft.base, text: draft.text, sent: null, theirs: state.base, failure: null };
}
