/**
 * Editing while logged in: a text stays locked until the user agrees to edit it.
 *
 * The question is a strip above the text, not a dialog: the focus stays where it is, and what is typed meanwhile is
 * kept and entered at the cursor once the user agrees.
 */
import { create } from 'zustand';
import { objectSession } from '@/online/useObjectSession';
import type { CodeEditor } from '@/text/CodePane';

export interface EditQuestion {
  /** What has been typed into each editor since the question came up. */
  readonly kept: ReadonlyMap<CodeEditor, string>;
  readonly waiting: readonly ((agreed: boolean) => void)[];
}

interface OnlineEdit {
  /** Objects that are edited while logged in. */
  readonly unlocked: ReadonlySet<string>;
  /** Open questions, by object. */
  readonly questions: ReadonlyMap<string, EditQuestion>;
}

export const useOnlineEdit = create<OnlineEdit>(() => ({ unlocked: new Set(), questions: new Map() }));

const NO_QUESTION: EditQuestion = { kept: new Map(), waiting: [] };

function changeQuestion(objectId: string, change: (question: EditQuestion) => EditQuestion): void {
  useOnlineEdit.setState(({ questions }) => ({
    questions: new Map(questions).set(objectId, change(questions.get(objectId) ?? NO_QUESTION)),
  }));
}

/** Asks whether the object shall be edited while logged in; true when it may be from now on. */
export function askToEdit(objectId: string): Promise<boolean> {
  if (useOnlineEdit.getState().unlocked.has(objectId)) return Promise.resolve(true);
  return new Promise((resolve) =>
    changeQuestion(objectId, ({ kept, waiting }) => ({ kept, waiting: [...waiting, resolve] })),
  );
}

/** Asks, and keeps what was typed into an editor until the answer comes. */
export function keepTyped(objectId: string, editor: CodeEditor, change: (kept: string) => string): void {
  changeQuestion(objectId, ({ kept, waiting }) => ({
    kept: new Map(kept).set(editor, change(kept.get(editor) ?? '')),
    waiting,
  }));
}

/** The user's answer: with a yes, what was kept is entered at the cursors of its editors. */
export function answerEdit(objectId: string, agreed: boolean): void {
  const { questions, unlocked } = useOnlineEdit.getState();
  const question = questions.get(objectId);
  if (question === undefined) return;
  useOnlineEdit.setState({
    questions: new Map([...questions].filter(([id]) => id !== objectId)),
    unlocked: agreed ? new Set([...unlocked, objectId]) : unlocked,
  });
  question.waiting.forEach((resolve) => resolve(agreed));
  if (!agreed) return;
  for (const [editor, text] of question.kept) {
    // React unlocks the pane only with its next render.
    editor.updateOptions({ readOnly: false });
    editor.focus();
    if (text !== '') editor.trigger('keyboard', 'type', { text });
  }
}

/** The object is edited from now on: the user has agreed without being asked. */
export function unlockEdit(objectId: string): void {
  useOnlineEdit.setState(({ unlocked }) => ({ unlocked: new Set([...unlocked, objectId]) }));
}

/** Logged out: nothing is locked and nothing is asked any more; what was kept is entered. */
export function endOnlineEdit(objectId: string): void {
  answerEdit(objectId, true);
  useOnlineEdit.setState(({ unlocked }) => ({ unlocked: new Set([...unlocked].filter((id) => id !== objectId)) }));
}

/** For acts that change a text: true at once while logged out, else what the user answers. */
export function mayChangeNow(projectId: string, objectId: string): Promise<boolean> {
  return objectSession(projectId, objectId) === null ? Promise.resolve(true) : askToEdit(objectId);
}

/** Keeps what is typed into a locked editor instead of letting the editor refuse it; answers how to stop. */
export function keepKeys(objectId: string, editor: CodeEditor): () => void {
  const node = editor.getDomNode();
  if (node === null) return () => undefined;
  const keep = (event: Event, change: (kept: string) => string) => {
    event.preventDefault();
    event.stopImmediatePropagation();
    keepTyped(objectId, editor, change);
  };
  const asked = () => useOnlineEdit.getState().questions.has(objectId);
  const onKey = (event: KeyboardEvent) => {
    if (event.isComposing || event.altKey || event.ctrlKey || event.metaKey || !inText(event)) return;
    if (event.key === 'Enter') keep(event, (kept) => `${kept}\n`);
    else if (event.key === 'Backspace' && asked()) keep(event, (kept) => [...kept].slice(0, -1).join(''));
  };
  const onInput = (event: InputEvent) => {
    const { data } = event;
    if (inText(event) && event.inputType === 'insertText' && data !== null) keep(event, (kept) => kept + data);
  };
  const onComposed = (event: CompositionEvent) => {
    if (inText(event) && event.data !== '') keepTyped(objectId, editor, (kept) => kept + event.data);
  };
  const onPaste = (event: ClipboardEvent) => {
    const text = event.clipboardData?.getData('text/plain') ?? '';
    if (inText(event) && text !== '') keep(event, (kept) => kept + text);
  };
  node.addEventListener('keydown', onKey, true);
  node.addEventListener('beforeinput', onInput, true);
  node.addEventListener('compositionend', onComposed, true);
  node.addEventListener('paste', onPaste, true);
  const subscription = editor.onDidAttemptReadOnlyEdit(() => keepTyped(objectId, editor, (kept) => kept));
  return () => {
    node.removeEventListener('keydown', onKey, true);
    node.removeEventListener('beforeinput', onInput, true);
    node.removeEventListener('compositionend', onComposed, true);
    node.removeEventListener('paste', onPaste, true);
    subscription.dispose();
  };
}

/** Whether an event is meant for the text: fields of widgets inside the editor (find, prepared values) type for themselves. */
function inText(event: Event): boolean {
  return event.target instanceof Element && event.target.matches('textarea.inputarea');
}
