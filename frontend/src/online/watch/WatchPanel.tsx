import { Binary, Eye } from 'lucide-react';
import { useCallback, useMemo, useRef, useState, type DragEvent, type KeyboardEvent } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import type { PanelProps } from '@/workbench/panels';
import { useActiveSession } from '@/workbench/online/session';
import { NUMBER_FORMATS } from '@/text/settings';
import { guard } from '@/ui/notices';
import { droppedLines, EXPRESSION_MIME } from '@/workbench/expressionDrag';
import { saveBlob } from '@/workbench/downloadFile';
import { useProject } from '@/project/openProject';
import { Empty } from '@/ui/Empty';
import type { MenuEntry } from '@/ui/Menu';
import { LostBar } from '../LostBar';
import { onlineColumns } from '../columns';
import { parseComputed } from '../computed/computed';
import { OnlineTable, type OnlineTableHandle } from '../OnlineTable';
import panel from '../OnlineTable.module.css';
import type { OnlineRoot, OnlineRow } from '../treeRows';
import { commonEntries } from '../rowMenu';
import { useComments } from '../useComments';
import { ExpressionInput } from './ExpressionInput';
import { listFrom, listText } from './listFile';
import { listTitle } from './listTitle';
import { listActs } from './ownLists';
import {
  addToList,
  findList,
  moveInList,
  plainExpression,
  removeFromList,
  setCurrentList,
  setExpression,
  setLineFormat,
  setListOptions,
  useWatchLists,
} from './lists';
import { PLAIN, type WatchList } from './model';
import { differs, literalIn, snapshotsCsv, takeSnapshot, type Snapshot } from './snapshot';
import { Sparkline } from './Sparkline';
import { useHistory } from './useHistory';
import styles from './Watch.module.css';
import { WatchBar } from './WatchBar';

const NEW = 'new';
/** Between the deletion of a list and the closing of its panel. */
const NO_LIST: WatchList = { id: '', name: '', entries: [], options: PLAIN };
/** Snapshots beside each other; the oldest one makes room. */
const MOST_SNAPSHOTS = 4;

/** What is no variable: an expression over variables, or a part of an array. */
function special(expression: string): Partial<OnlineRoot> {
  if (/\[[^[\]]*\.\.[^[\]]*\]$/.test(expression)) return { kind: 'part', leaf: false };
  const computed = parseComputed(expression);
  return computed === null ? {} : { computed, kind: 'computed', leaf: true };
}

const clockText = (at: Date) => `${at.toLocaleTimeString('en-GB')}.${String(at.getMilliseconds()).padStart(3, '0')}`;

/** One of the watch lists: any variables of the application, structured ones to open (WAT-02 .. WAT-12). */
export default function WatchPanel({ options: props, visible }: PanelProps) {
  const list = String(props.list);
  const t = useText();
  const session = useActiveSession() ?? null;
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const shown = useWatchLists((state) => state.lists.find((one) => one.id === list)) ?? NO_LIST;
  const { entries, options } = shown;
  const comments = useComments(projectId);
  const [snapshots, setSnapshots] = useState<readonly Snapshot[]>([]);
  const table = useRef<OnlineTableHandle>(null);
  const runtimeId = session?.runtimeId ?? null;
  const columns = useMemo(() => {
    const extra = [
      ...(options.history ? [{ id: 'history', title: t('watch.history'), width: 140 }] : []),
      ...snapshots.map((one, at) => ({ id: `snapshot${String(at)}`, title: clockText(one.at), width: 130 })),
    ];
    const all = onlineColumns(t);
    return [...all.slice(0, 3), ...extra, ...all.slice(3)];
  }, [t, options.history, snapshots]);
  const [over, setOver] = useState(false);

  const roots = useMemo((): readonly OnlineRoot[] => {
    const known = objects ?? [];
    const filled = entries.map((entry) => {
      const expression = plainExpression(entry.expression, known);
      return {
        key: entry.id,
        label: entry.expression,
        expression,
        comment: comments(expression),
        ...special(expression),
      };
    });
    // The last line waits for the next expression.
    return [...filled, { key: NEW, label: '', expression: '', leaf: true, valueless: true }];
  }, [entries, objects, comments]);

  const watched = useMemo(
    () =>
      roots
        .filter((root) => root.expression !== '' && root.leaf !== false && !root.computed)
        .map((root) => root.expression),
    [roots],
  );
  const history = useHistory(runtimeId, watched, options.history && visible !== false);
  const formats = useMemo(() => new Map(entries.map((entry) => [entry.id, entry.format])), [entries]);
  const formatOf = useCallback(
    (row: OnlineRow) => formats.get(roots[row.root]?.key ?? '') ?? options.format ?? undefined,
    [formats, roots, options.format],
  );
  const extraCell = useCallback(
    (row: OnlineRow, column: string) => {
      if (column === 'history')
        return history && row.leaf !== false && row.depth === 0 && watched.includes(row.expression) ? (
          <Sparkline history={history} name={row.expression} />
        ) : null;
      const at = Number(column.replace('snapshot', ''));
      const snapshot = snapshots[at];
      if (snapshot === undefined || row.expression === '') return null;
      const changed = at > 0 && differs(snapshots[at - 1], snapshot, row);
      return (
        <span className={styles.snapshot} data-differs={changed || undefined}>
          {literalIn(snapshot, row)}
        </span>
      );
    },
    [history, watched, snapshots],
  );
  const snap = () =>
    void guard(async () => {
      if (runtimeId === null) return;
      const taken = await takeSnapshot(runtimeId, table.current?.rows() ?? []);
      setSnapshots((before) => [...before.slice(-(MOST_SNAPSHOTS - 1)), taken]);
    });
  const fileName = shown.name?.replace(/[^\p{L}\p{N}_-]+/gu, '_') ?? `watch${list}`;
  const save = (text: string, name: string, type: string) => saveBlob(new Blob([text], { type }), name);
  const importList = (text: string) => {
    const listed = listFrom(text);
    addToList(
      list,
      listed.map(({ expression }) => expression),
    );
    for (const { expression, format } of listed) {
      if (format === undefined) continue;
      const entry = findList(list)?.entries.find((one) => one.expression === expression);
      if (entry) setLineFormat(list, [entry.id], format);
    }
  };

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
      kind: 'sub',
      key: 'format',
      text: t('online.format'),
      icon: Binary,
      entries: [undefined, ...NUMBER_FORMATS].map((format) => ({
        kind: 'item',
        key: format ?? 'list',
        text: format === undefined ? t('watch.formatOfList') : t(`online.format.${format}`),
        checked: rows.length > 0 && rows.every((row) => formats.get(roots[row.root]?.key ?? '') === format),
        disabledReason: rows.length > 0 ? null : t('watch.selectLine'),
        run: () =>
          setLineFormat(
            list,
            rows.map((row) => roots[row.root]?.key ?? ''),
            format,
          ),
      })),
    },
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
      className={panel.panel}
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
      <WatchBar
        online={session !== null}
        empty={entries.length === 0}
        options={options}
        snapshots={snapshots.length}
        onOptions={(changes) => setListOptions(list, changes)}
        onSnapshot={snap}
        onForget={() => setSnapshots([])}
        onCsv={() => save(snapshotsCsv(table.current?.rows() ?? [], snapshots), `${fileName}.csv`, 'text/csv')}
        onExport={() => save(listText(entries), `${fileName}.txt`, 'text/plain')}
        onImport={importList}
        acts={() => listActs(list)}
      />
      <div>
        <OnlineTable
          handle={table}
          formatOf={formatOf}
          extraCell={extraCell}
          label={listTitle(t, shown)}
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
          <div className={panel.hint}>
            <Empty icon={Eye} title={t('watch.empty')} text={t('watch.emptyText')} />
          </div>
        )}
      </div>
    </div>
  );
}

/** Expressions from a table or another list, or lines of text from an editor. */
function droppedExpressions(event: DragEvent, objects: readonly ObjectSummary[]): string[] {
  const { expressions, text } = droppedLines(event.dataTransfer);
  if (!text) return [...expressions];
  return expressions
    .map((line) => plainExpression(line, objects))
    .filter((line) => /^[.%A-Za-z_][\w.[\],\s%^-]*$/.test(line) || parseComputed(line) !== null);
}
