/** What the page and the worker of a script send each other. */

export type Verb = 'get' | 'post' | 'put' | 'patch' | 'delete';
export type Query = Readonly<Record<string, string | number | boolean | readonly (string | number)[] | null>>;

/** What a script can know of the workbench without asking the server. */
export interface ScriptFacts {
  projectId: string;
  projectName: string;
  /** The active application, null when there is none. */
  applicationId: string | null;
  /** Objects selected in the tree. */
  selection: readonly { id: string; name: string; kind: string }[];
  user: { name: string; role: string; language: string };
}

export type Tone = 'info' | 'warn' | 'error';

export interface OutputLine {
  tone: Tone;
  text: string;
}

export interface ScriptRequest {
  type: 'request';
  id: number;
  verb: Verb;
  path: string;
  query?: Query;
  body?: unknown;
}

/** Why a script ended before its end; the line is one of its text, null where none is known. */
export interface ScriptFailure {
  message: string;
  line: number | null;
  column: number | null;
}

export type FromWorker =
  | { type: 'lines'; lines: readonly OutputLine[] }
  | ScriptRequest
  /** An error of something that the script did not wait for. */
  | ({ type: 'stray' } & ScriptFailure)
  | ({ type: 'failed' } & ScriptFailure)
  | { type: 'done' };

export type ToWorker =
  | { type: 'start'; url: string; facts: ScriptFacts }
  | { type: 'answer'; id: number; data: unknown }
  | { type: 'refusal'; id: number; status: number; message: string };
