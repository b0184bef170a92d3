import { useVirtualizer } from '@tanstack/react-virtual';
import { useId, useMemo, useRef, useState, type KeyboardEvent, type MouseEvent, type ReactNode } from 'react';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { displayPlace } from '@/project/objectName';
import { MOTION_OF_KEY, moveFocus } from '@/project/tree';
import { Twist } from '@/ui/Twist';
import { toggledIn } from '@/ui/toggleSet';
import { openObject } from '@/workbench/docking/dock';
import { dragOut } from '@/workbench/expressionDrag';
import { showDocumentation } from '@/workbench/libraries/show';
import rowStyles from '@/ui/Rows.module.css';
import { choiceOf, hitKey, rowsOf, withChoice, type ResultRow, type SearchObject } from './model';
import styles from './Search.module.css';
import { useSearch } from './store';
import { variablesOfHit } from './watchable';

const ROW_HEIGHT = 24;

interface ResultTreeProps {
  groups: readonly SearchObject[];
  closed: ReadonlySet<string>;
  setClosed: (closed: ReadonlySet<string>) => void;
  /** Show what replaces each hit, and a box to leave it out. */
  replacing: boolean;
  leftOut: ReadonlySet<string>;
  /** Below the last row. */
  children?: ReactNode;
}

/** What was found: objects, below each its hits with the line they stand in. Enter or a click goes to the place. */
export function ResultTree({ groups, closed, setClosed, replacing, leftOut, children }: ResultTreeProps) {
  const t = useText();
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const [focused, setFocused] = useState<string | null>(null);
  const rows = useMemo(() => rowsOf(groups, closed), [groups, closed]);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 15,
    paddingStart: 2,
  });
  const at = rows.findIndex((row) => row.object.id === focused);

  const choose = (row: ResultRow) => useSearch.setState({ leftOut: withChoice(row, leftOut) });
  const open = (row: ResultRow, focus: boolean) => {
    if (row.hit === null) setClosed(toggledIn(closed, row.object.id));
    else goToHit(row, focus);
  };

  const onKeyDown = (event: KeyboardEvent) => {
    const row = rows[at];
    const motion = MOTION_OF_KEY[event.key];
    if (motion && !event.ctrlKey && !event.altKey) {
      const move = moveFocus(rows, focused, motion);
      if (move.open ?? move.close) setClosed(toggledIn(closed, (move.open ?? move.close)!));
      if (move.focus !== undefined) {
        setFocused(move.focus);
        virtual.scrollToIndex(rows.findIndex((one) => one.object.id === move.focus));
      }
    } else if (event.key === 'Enter' && row) open(row, true);
    else if (event.key === ' ' && row && replacing) choose(row);
    else return;
    event.preventDefault();
  };

  return (
    <div
      ref={scroll}
      className={`${rowStyles.rows} ${styles.results}`}
      role="tree"
      aria-label={t('search.results')}
      aria-multiselectable={replacing || undefined}
      tabIndex={0}
      aria-activedescendant={at >= 0 ? `${id}-${String(at)}` : undefined}
      onKeyDown={onKeyDown}
    >
      <div role="presentation" style={{ height: virtual.getTotalSize(), position: 'relative' }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const row = rows[index]!;
          return (
            <div
              key={row.object.id}
              id={`${id}-${String(index)}`}
              role="treeitem"
              aria-level={row.level}
              aria-expanded={row.expandable ? row.expanded : undefined}
              aria-selected={row.object.id === focused}
              className={`${rowStyles.row} ${styles.row}`}
              style={{ transform: `translateY(${String(start)}px)`, paddingLeft: row.level === 1 ? 4 : 22 }}
              title={row.hit === null ? row.group.path : `${row.hit.before}${row.hit.match}${row.hit.after}`}
              onMouseDown={(event) => {
                setFocused(row.object.id);
                dragHit(row, event);
              }}
              onClick={() => open(row, false)}
            >
              {row.level === 1 && <Twist open={row.expanded} expandable />}
              {replacing && <Choice row={row} leftOut={leftOut} onChoose={() => choose(row)} />}
              {row.hit === null ? (
                <ObjectLine row={row} />
              ) : (
                <HitLine row={row} replacing={replacing} leftOut={leftOut} />
              )}
            </div>
          );
        })}
      </div>
      {children}
    </div>
  );
}

/** The box of a hit or of all hits of an object. Space clicks that of the focused row. */
function Choice({ row, leftOut, onChoose }: { row: ResultRow; leftOut: ReadonlySet<string>; onChoose: () => void }) {
  const t = useText();
  const chosen =
    row.hit === null ? choiceOf(row.group, leftOut) : row.hit.writable ? !leftOut.has(row.object.id) : null;
  return (
    <input
      type="checkbox"
      tabIndex={-1}
      className={styles.choice}
      aria-label={t(row.hit === null ? 'search.replaceInObject' : 'search.replaceHit')}
      checked={chosen === true}
      disabled={chosen === null}
      ref={(box) => {
        if (box) box.indeterminate = chosen === 'some';
      }}
      onClick={(event) => event.stopPropagation()}
      onChange={onChoose}
    />
  );
}

function ObjectLine({ row: { group } }: { row: ResultRow }) {
  return (
    <>
      <ObjectIcon kind={group.kind} subkind={group.subkind} name={group.name} style={{ flex: 'none' }} />
      <span className={styles.name}>{group.name}</span>
      <span className={styles.path}>{displayPlace(group.path)}</span>
      <span className={styles.count}>{group.total}</span>
    </>
  );
}

interface HitLineProps {
  row: ResultRow;
  replacing: boolean;
  leftOut: ReadonlySet<string>;
}

function HitLine({ row: { group, hit }, replacing, leftOut }: HitLineProps) {
  const t = useText();
  if (hit === null) return null;
  const replaced = replacing && hit.replacement !== null && !leftOut.has(hitKey(group, hit));
  return (
    <>
      <span className={styles.place}>{hit.part ? hit.line : hit.field || t('search.area.names')}</span>
      <span className={styles.preview} data-comment={hit.area === 'comments' || undefined}>
        {shortened(hit.before)}
        <mark className={replaced ? styles.gone : styles.match}>{hit.match}</mark>
        {replaced && <ins className={styles.coming}>{hit.replacement}</ins>}
        {hit.after}
      </span>
    </>
  );
}

/** So that the hit itself is in view in a narrow panel. */
const BEFORE = 18;

function shortened(before: string): string {
  return before.length > BEFORE + 2 ? `…${before.slice(-BEFORE)}` : before;
}

/** Out of the panel the variable of a hit is dragged, to watch lists and traces. */
function dragHit({ group, hit }: ResultRow, event: MouseEvent<HTMLElement>): void {
  const { projectId } = useSearch.getState();
  const home = event.currentTarget.closest('[role="tree"]');
  const objectId = group.object_id;
  if (event.button !== 0 || hit === null || objectId === null || projectId === null || home === null) return;
  event.preventDefault();
  (home as HTMLElement).focus();
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  dragOut({ home, expressions: () => variablesOfHit(projectId, objects, objectId, hit) });
}

function goToHit({ group, hit }: ResultRow, focus: boolean): void {
  if (hit === null) return;
  if (group.object_id === null) {
    void showDocumentation(group.library ?? '', group.name);
    return;
  }
  const place =
    hit.part === null
      ? undefined
      : { part: hit.part, line: hit.line, column: hit.column, endLine: hit.end_line, endColumn: hit.end_column };
  openObject(group.object_id, group.name, { place, focus });
}
