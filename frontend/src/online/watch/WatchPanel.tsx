import { Eye } from 'lucide-react';
import { useMemo, useState, type DragEvent, type KeyboardEvent } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import type { PanelProps } from '@/workbench/panels';
import { useActiveSession } from '@/workbench/online/session';
import { useProject } from '@/project/openProject';
import { Empty } from '@/ui/Empty';
import type { MenuEntry } from '@/ui/Menu';
import { LostBar } from '../LostBar';
import { onlineColumns } from '../columns';
import { EXPRESSION_MIME, OnlineTable } from '../OnlineTable';
import styles from '../OnlineTable.module.css';
import type { OnlineRoot, OnlineRow } from '../treeRows';
import { commonEntries } from '../rowMenu';
import { useComments } from '../useComments';
import { ExpressionInput } from './ExpressionInput';
import {
  addToList,
  moveInList,
  plainExpression,
  removeFromList,
  setCurrentList,
  setExpression,
  useWatchLists,
  type WatchList,
} from './lists';

const NEW = 'new';

/** One of the watch lists: any variables of the application, structured ones to open (WAT-02 .. WAT-12). */
export default function WatchPanel({ options, visible }: PanelProps) {
  const list = options.list as WatchList;
  const t = useText();
  const session = useActiveSession() ?? null;
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const entries = useWatchLists((state) => state.lists[list]);
  const comments = useComments(projectId);
  const columns = useMemo(() => onlineColumns(t), [t]);
  const [over, setOver] = useState(false);

  const roots = useMemo((): readonly OnlineRoot[] => {
    const known = objects ?? [];
    const filled = entries.map((entry) => {
      const expression = plainExpression(entry.expression, known);
      return { key: entry.id, label: entry.expression, expression, comment: comments(expression) };
    });
    // The last line waits for the next expression.
    return [...filled, { key: NEW, label: '', expression: '', leaf: true, valueless: true }];
  }, [entries, objects, comments]);

  const remove = (rows: readonly OnlineRow[]) =>
    removeFromList(
      list,
      rows.filter((row) => row.depth === 0).map((row) => row.key),
    );
  const onKey = (event: KeyboardEvent, rows: readonly OnlineRow[]): boolean => {
    if (event.key === 'Delete') return (remove(rows), true);
    const one = rows[0];
    if (event.altKey && one?.depth === 0 && (event.key === 'ArrowUp' || event.key === 'ArrowDown')) {
      event.preventDefault();
      moveInList(list, one.key, event.key === 'ArrowUp' ? -1 : 1);
      return true;
    }
    return false;
  };
  const menu = (rows: readonly OnlineRow[]): MenuEntry[] => [
    ...commonEntries(t, session, rows),
    { kind: 'line', key: 'remove-line' },
    {
      kind: 'item',
      key: 'remove',
      text: t('watch.remove'),
      shortcut: 'Del',
      disabledReason: rows.some((row) => row.depth === 0 && row.key !== NEW) ? null : t('watch.selectLine'),
      run: () => remove(rows),
    },
  ];
  const onDrop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    addToList(list, droppedExpressions(event, objects ?? []));
  };
  const editor = (row: OnlineRow, initial: string | undefined, done: () => void) => (
    <ExpressionInput
      session={session}
      value={row.label}
      initial={initial}
      onCommit={(text) => {
        if (row.key === NEW) addToList(list, [text]);
        else setExpression(list, row.key, text);
        done();
      }}
      onCancel={done}
    />
  );
  return (
    <div
      className={styles.panel}
      data-drop={over || undefined}
      onFocusCapture={() => setCurrentList(list)}
      onDragOver={(event) => {
        if (!event.dataTransfer.types.some((type) => type === EXPRESSION_MIME || type === 'text/plain')) return;
        event.preventDefault();
        event.dataTransfer.dropEffect = 'copy';
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={onDrop}
    >
      <LostBar session={session} />
      <div>
        <OnlineTable
          label={t('watch.title', { number: list })}
          session={session}
          roots={roots}
          columns={columns}
          expressionEditor={editor}
          onKey={onKey}
          menu={menu}
          visible={visible}
          empty={<Empty icon={Eye} title={t('watch.empty')} />}
        />
        {entries.length === 0 && (
          <div className={styles.hint}>
            <Empty icon={Eye} title={t('watch.empty')} text={t('watch.emptyText')} />
          </div>
        )}
      </div>
    </div>
  );
}

/** Expressions from a table or another list, or lines of text from an editor. */
function droppedExpressions(event: DragEvent, objects: readonly ObjectSummary[]): string[] {
  const own = event.dataTransfer.getData(EXPRESSION_MIME);
  if (own !== '') return JSON.parse(own) as string[];
  return event.dataTransfer
    .getData('text/plain')
    .split(/\r?\n/)
    .map((line) => plainExpression(line, objects))
    .filter((line) => /^[.%A-Za-z_][\w.[\],\s%^-]*$/.test(line));
}
