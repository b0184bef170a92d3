/** What the delegated commands do in a text editor. */
import { t } from '@/i18n';
import { notify } from '@/ui/notices';
import type { Handler, Handlers } from '@/workbench/commands';
import { setDirty } from '@/workbench/selection';
import {
  addToWatch,
  autoDeclare,
  breakOnChangeAt,
  inputAssistant,
  rename,
  revisions,
  showCrossReferences,
  watchable,
  type TextPanel,
} from '../text/acts';
import type { CodeEditor } from '@/text/CodePane';
import { bodyOf } from '@/text/bodies';
import { ACTIONS, CHANGING, inEditor } from '../text/actions';
import { mayChangeNow } from '../text/onlineEdit';
import { panelChosen, panelEditor, panelPlace, panelPrepare, panelTable, type TextPlace } from '@/text/focus';

/** Acts of a panel with Monaco editors: they go to the one that had the focus last. */
export function textHandlers(panelId: string, panel: TextPanel): Handlers {
  const { document, object } = panel;
  const onEditor = (run: (editor: CodeEditor) => Promise<void> | void) => ({
    run: () => {
      const editor = panelEditor(panelId);
      if (editor !== null) return run(editor);
    },
  });
  const onPlace = (run: (place: TextPlace) => Promise<void> | void) => ({
    run: () => {
      const place = panelPlace(panelId);
      if (place !== null) return run(place);
    },
  });
  const act = (id: string) => inEditor(panelId, id);
  /** Acts that change the text: while logged in it asks first. */
  const changing = ({ run }: Handler): Handler => ({
    run: async (argument) => {
      if (!(await mayChangeNow(panel.projectId, object.id))) return;
      // React unlocks the pane only with its next render.
      panelEditor(panelId)?.updateOptions({ readOnly: false });
      await run(argument);
    },
  });
  const history = (command: 'undo' | 'redo') => ({
    run: () => {
      const table = panelTable(panelId);
      if (table !== null) {
        table[command]();
        return;
      }
      const editor = panelEditor(panelId);
      if (editor?.getRawOptions().readOnly === true) return;
      editor?.focus();
      editor?.trigger('command', command, null);
    },
  });
  const handlers: Handlers = {
    ...Object.fromEntries(Object.entries(ACTIONS).map(([command, action]) => [command, act(action)])),
    'edit.undo': history('undo'),
    'edit.redo': history('redo'),
    'st.inputAssistant': onEditor((editor) => inputAssistant(panel, editor)),
    'st.autoDeclare': onPlace((place) => autoDeclare(panel, place)),
    ...Object.fromEntries(CHANGING.map((command) => [command, changing(act(ACTIONS[command]!))])),
    'st.renameSymbol': changing(onPlace((place) => rename(panel, place))),
    'st.crossReferences': onPlace((place) => showCrossReferences(panel, place)),
    'online.prepareValue': {
      run: () => {
        if (!panelPrepare(panelId)) notify({ tone: 'info', title: t('online.nothingToPrepare') });
      },
    },
    'watch.add': {
      run: (argument) => {
        const place = panelPlace(panelId);
        return addToWatch(panelChosen(panelId) ?? (place === null ? [] : watchable(panel, place)), argument);
      },
    },
    'debug.breakOnChange': {
      run: () => {
        const place = panelPlace(panelId);
        const chosen = panelChosen(panelId) ?? (place === null ? [] : watchable(panel, place));
        return breakOnChangeAt(panel, chosen);
      },
    },
    ...Object.fromEntries(
      Object.entries(bodyOf(document.language).handlers?.(panelId, document) ?? {}).map(([command, handler]) => [
        command,
        changing(handler),
      ]),
    ),
    'st.revisions': { run: () => revisions(panel) },
    'file.save': {
      run: async () => {
        await document.save();
        // At once, since a build that has just asked for saving looks at it next.
        setDirty(panelId, document.phase !== 'clean');
      },
    },
  };
  return Object.fromEntries(
    Object.entries(handlers).map(([command, handler]) => [
      command,
      { ...handler, run: first(panelId, command, handler) },
    ]),
  );
}

/** What a table does in its own way comes first while it has the focus; an editor beside it is not meant then. */
function first(panelId: string, command: string, handler: Handler): Handler['run'] {
  return (argument) => {
    const table = panelTable(panelId);
    const own = table?.acts?.[command];
    if (own !== undefined) return own();
    if (table?.acts !== undefined && command in ACTIONS) return;
    return handler.run(argument);
  };
}
