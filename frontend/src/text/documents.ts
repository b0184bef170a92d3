/**
 * Open text objects. Every view of an object (text, table, a second tab) shares one `TextDocument`: two Monaco models,
 * one state, one way to the server. It lives while a view holds it, and longer while it has unsaved text.
 */
import { QueryObserver } from '@tanstack/react-query';
import { createStore, type StoreApi } from 'zustand';
import type { editor } from 'monaco-editor/editor/editor.api';
import { dataText } from '@/api/objects';
import { objectQuery, queryClient, saveObject, StaleObject } from '@/api/queries';
import { changedByOthers } from '@/project/authors';
import type { ProjectObject } from '@/api/types';
import { useSession } from '@/session/session';
import { smallestChange } from '@/iec/declaration/text';
import { indentation, useEditorSettings } from './settings';
import { IEC_TEXT } from './iecText';
import { monacoLanguage } from './languages';
import type { Monaco } from './monacoLoader';
import {
  edited,
  isChanged,
  newerVersion,
  opened,
  phaseOf,
  resolved,
  saved,
  savingFailed,
  savingStarted,
  wantsSaving,
  withDraft,
  type DocumentPhase,
  type DocumentState,
  type Resolution,
  type StoredVersion,
  type TextParts,
} from './documentState';
import { Drafts } from './drafts';
import { isStepsOfParts, KeptSteps, textBefore, UndoSteps, type StepsOfParts } from './undoSteps';
import { kindOf } from '@/project/kinds';
import { partUri, type Part } from '@/project/partUri';

const AUTOSAVE_MS = 1500;
const RETRY_MS = 5000;
const DRAFT_MS = 250;

/** The two texts of an object; actions have no declaration of their own, types and lists no implementation. */
function partsOf(object: ProjectObject): TextParts {
  return { declaration: dataText(object, 'declaration'), implementation: dataText(object, 'implementation') };
}

let draftStore: Drafts | null = null;
function drafts(): Drafts {
  if (draftStore === null) {
    draftStore = new Drafts(localStorage);
    draftStore.prune(Date.now());
  }
  return draftStore;
}

let stepStore: KeptSteps<StepsOfParts> | null = null;
function keptSteps(): KeptSteps<StepsOfParts> {
  stepStore ??= new KeptSteps(localStorage, isStepsOfParts);
  return stepStore;
}

const PARTS = ['declaration', 'implementation'] as const;

/** Brings data on top of a revision to the server and answers with the object as it is stored then. */
export type Put = (baseRevision: number, data: Record<string, unknown>) => Promise<ProjectObject>;

export class TextDocument {
  readonly models: Readonly<Record<Part, editor.ITextModel>>;
  readonly store: StoreApi<DocumentState>;
  private readonly steps: Readonly<Record<Part, UndoSteps>>;
  private holders = 0;
  private applying = false;
  private saveTimer: ReturnType<typeof setTimeout> | undefined;
  private draftTimer: ReturnType<typeof setTimeout> | undefined;
  private running: Promise<void> | null = null;
  private readonly stopFollowing: () => void;

  constructor(
    private readonly monaco: Monaco,
    readonly projectId: string,
    private object: ProjectObject,
    private readonly forget: () => void,
  ) {
    const base: StoredVersion = { revision: object.revision, parts: partsOf(object) };
    const draft = drafts().read(this.user, projectId, object.id);
    const state = draft === null ? opened(base) : withDraft(opened(base), draft);
    this.store = createStore(() => state);
    const kept = keptSteps().read(this.user, projectId, object.id);
    const steps = (part: Part) =>
      new UndoSteps(kept !== null && textBefore(state.text[part], kept[part]) !== null ? kept[part].steps : []);
    this.steps = { declaration: steps('declaration'), implementation: steps('implementation') };
    const model = (part: Part) => {
      const uri = monaco.Uri.parse(partUri(projectId, object.id, part));
      const language =
        part === 'implementation' ? (kindOf(object.kind)?.textLanguage ?? monacoLanguage(this.language)) : IEC_TEXT;
      const made = monaco.editor.getModel(uri) ?? monaco.editor.createModel('', language, uri);
      this.fill(made, part, state.text[part]);
      made.updateOptions({
        ...indentation(useEditorSettings.getState()),
        bracketColorizationOptions: { enabled: false, independentColorPoolPerBracketType: false },
      });
      made.onDidChangeContent(({ isUndoing }) => this.typed(isUndoing));
      return made;
    };
    this.models = { declaration: model('declaration'), implementation: model('implementation') };
    const unfollow = this.follow();
    const unsubscribe = useEditorSettings.subscribe((settings) => {
      Object.values(this.models).forEach((one) => one.updateOptions(indentation(settings)));
    });
    this.stopFollowing = () => {
      unfollow();
      unsubscribe();
    };
    addEventListener('pagehide', this.leaving);
    if (isChanged(state)) this.scheduleSave(AUTOSAVE_MS);
  }

  get objectId(): string {
    return this.object.id;
  }

  get name(): string {
    return this.object.name;
  }

  /** Language of the body, as the server calls it; undefined for objects without one. */
  get language(): string | undefined {
    return dataText(this.object, 'language') || undefined;
  }

  get phase(): DocumentPhase {
    return phaseOf(this.store.getState());
  }

  hold(): void {
    this.holders += 1;
  }

  /** A view has closed. Unsaved text is sent at once; the draft stays until the server has it. */
  release(): void {
    this.holders -= 1;
    if (this.holders > 0) return;
    void this.save().finally(() => {
      if (this.holders === 0) this.dispose();
    });
  }

  /** Stores now what is not stored; resolves when the server has answered, whatever it said. */
  save(autosave = false): Promise<void> {
    return this.saveBy((baseRevision, data) =>
      saveObject(this.projectId, this.objectId, baseRevision, data, { autosave }),
    );
  }

  /** As `save`; `put` brings the data to the server. */
  async saveBy(put: Put): Promise<void> {
    if (this.running !== null) await this.running;
    clearTimeout(this.saveTimer);
    if (!wantsSaving(this.store.getState())) return;
    this.running = this.send(put).finally(() => {
      this.running = null;
    });
    await this.running;
  }

  /** Gives a part its former text after a save that was refused; a version of somebody else is then followed. */
  takeBack(part: Part, text: string): void {
    this.replaceText(part, text);
    const state = this.store.getState();
    if (state.theirs !== null && !isChanged(state)) this.change((now) => resolved(now, 'theirs'));
  }

  resolve(resolution: Resolution, merged?: TextParts): void {
    this.change((state) => resolved(state, resolution, merged), resolution !== 'mine');
    this.scheduleSave(0);
  }

  /** Replaces the text of a part in one undoable step; only what differs is touched, so cursors stay. */
  replaceText(part: Part, text: string): void {
    const model = this.models[part];
    const change = smallestChange(model.getValue(), text);
    if (change === null) return;
    const range = rangeOf(model, change.start, change.end);
    model.pushStackElement();
    model.pushEditOperations([], [{ range, text: change.text }], () => null);
    model.pushStackElement();
  }

  /** Gives a model its text with the steps that lead to it, so that undo goes back over edits of an earlier visit. */
  private fill(model: editor.ITextModel, part: Part, text: string): void {
    const kept = this.steps[part].of(text);
    model.setValue(textBefore(text, kept) ?? text);
    model.setEOL(0 satisfies editor.EndOfLineSequence.LF);
    for (const { at, removed, inserted } of kept.steps) {
      model.pushStackElement();
      const range = rangeOf(model, at, at + removed.length);
      model.pushEditOperations([], [{ range, text: inserted }], () => null);
    }
    model.pushStackElement();
  }

  private get user(): string {
    return useSession.getState().user?.id ?? '';
  }

  private async send(put: Put): Promise<void> {
    const state = this.store.getState();
    this.store.setState(savingStarted(state), true);
    try {
      const texts = Object.entries(state.text).filter(([part]) => part in this.object.data);
      const data = { ...this.object.data, ...Object.fromEntries(texts) };
      const answer = await put(state.base.revision, data);
      this.object = answer;
      this.change((now) => saved(now, { revision: answer.revision, parts: partsOf(answer) }));
    } catch (error) {
      this.refused(error);
    }
    this.storeDraft();
    if (wantsSaving(this.store.getState())) {
      this.scheduleSave(this.phase === 'failed' ? RETRY_MS : AUTOSAVE_MS);
    }
  }

  private refused(error: unknown): void {
    if (error instanceof StaleObject && error.current.id === this.objectId) {
      const theirs = { revision: error.current.revision, parts: partsOf(error.current) };
      this.change((now) => newerVersion({ ...now, sent: null }, theirs));
    } else {
      this.change((now) => savingFailed(now, error));
    }
  }

  /** Newer versions reach the query cache by the events socket. */
  private follow(): () => void {
    const observer = new QueryObserver(queryClient, objectQuery(this.projectId, this.objectId));
    return observer.subscribe(({ data }) => {
      if (data === undefined || data.revision <= this.object.revision) return;
      const foreign = changedByOthers(this.objectId, this.object.revision, data.revision);
      this.object = data;
      this.change((state) => newerVersion(state, { revision: data.revision, parts: partsOf(data) }), foreign);
    });
  }

  /**
   * Applies a transition and brings the models to the text it ends with. What is `foreign`, by somebody else, is no
   * step that undo could take back, and neither is what was before it.
   */
  private change(transition: (state: DocumentState) => DocumentState, foreign = false): void {
    const before = this.store.getState().text;
    const next = transition(this.store.getState());
    this.store.setState(next, true);
    this.applying = true;
    for (const part of PARTS) {
      if (foreign && next.text[part] !== before[part]) this.resetText(part, next.text[part]);
      else this.replaceText(part, next.text[part]);
      if (!foreign) this.steps[part].edited(before[part], next.text[part], Date.now());
    }
    this.applying = false;
    if (next.text !== before) this.storeSteps();
  }

  /** Gives a part its text without a way back; cursors and scrolling stay where they can. */
  private resetText(part: Part, text: string): void {
    const model = this.models[part];
    this.steps[part].clear();
    const views = this.monaco.editor.getEditors().filter((view) => view.getModel() === model);
    const states = views.map((view) => view.saveViewState());
    model.setValue(text);
    views.forEach((view, at) => view.restoreViewState(states[at] ?? null));
  }

  private typed(undone: boolean): void {
    if (this.applying) return;
    const before = this.store.getState().text;
    const text = {
      declaration: this.models.declaration.getValue(),
      implementation: this.models.implementation.getValue(),
    };
    for (const part of PARTS) this.steps[part].edited(before[part], text[part], Date.now(), undone);
    this.store.setState(edited(this.store.getState(), text), true);
    this.scheduleSave(AUTOSAVE_MS);
    clearTimeout(this.draftTimer);
    this.draftTimer = setTimeout(() => this.storeDraft(), DRAFT_MS);
  }

  private scheduleSave(ms: number): void {
    clearTimeout(this.saveTimer);
    this.saveTimer = setTimeout(() => void this.save(true), ms);
  }

  private storeSteps(): void {
    const { text } = this.store.getState();
    const empty = PARTS.every((part) => this.steps[part].length === 0);
    const steps = {
      declaration: this.steps.declaration.of(text.declaration),
      implementation: this.steps.implementation.of(text.implementation),
    };
    keptSteps().write(this.user, this.projectId, this.objectId, empty ? null : steps, Date.now());
  }

  private storeDraft(): void {
    clearTimeout(this.draftTimer);
    this.storeSteps();
    const { base, text } = this.store.getState();
    if (isChanged(this.store.getState())) {
      drafts().write(this.user, this.projectId, this.objectId, { base, text, savedAt: Date.now() });
    } else {
      drafts().remove(this.user, this.projectId, this.objectId);
    }
  }

  private readonly leaving = () => this.storeDraft();

  private dispose(): void {
    this.storeDraft();
    clearTimeout(this.saveTimer);
    removeEventListener('pagehide', this.leaving);
    this.stopFollowing();
    this.models.declaration.dispose();
    this.models.implementation.dispose();
    this.forget();
  }
}

function rangeOf(model: editor.ITextModel, start: number, end: number) {
  const from = model.getPositionAt(start);
  const to = model.getPositionAt(end);
  return {
    startLineNumber: from.lineNumber,
    startColumn: from.column,
    endLineNumber: to.lineNumber,
    endColumn: to.column,
  };
}

const open = new Map<string, Promise<TextDocument>>();

/** The shared document of an object; every `openDocument` needs one `release`. */
export async function openDocument(monaco: Monaco, projectId: string, objectId: string): Promise<TextDocument> {
  const id = `${projectId}/${objectId}`;
  let known = open.get(id);
  if (known === undefined) {
    known = queryClient
      .fetchQuery(objectQuery(projectId, objectId))
      .then((object) => new TextDocument(monaco, projectId, object, () => open.delete(id)));
    open.set(id, known);
    known.catch(() => open.delete(id));
  }
  const document = await known;
  document.hold();
  return document;
}
