import { useVirtualizer } from '@tanstack/react-virtual';
import { useId, useRef, type KeyboardEvent } from 'react';
import type { Revision } from '@/api/types';
import { useText } from '@/i18n';
import { rowAfterKey } from '@/ui/table';
import { secondText } from '@/workbench/clock';
import { actionText } from '@/workbench/tree/actionText';
import styles from './compare.module.css';

const ROW_HEIGHT = 46;
const PAGE = 8;

interface RevisionListProps {
  /** Newest first. */
  revisions: readonly Revision[];
  selected: number;
  select: (revision: number) => void;
  /** Of the whole project: each entry names the objects. */
  ofProject: boolean;
}

/** Who saved what when. */
export function RevisionList({ revisions, selected, select, ofProject }: RevisionListProps) {
  const t = useText();
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const at = revisions.findIndex((one) => one.revision === selected);
  const virtual = useVirtualizer({
    count: revisions.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 8,
  });
  const onKeyDown = (event: KeyboardEvent) => {
    const next = rowAfterKey(event.key, at, revisions.length, PAGE);
    if (next === null) return;
    event.preventDefault();
    select(revisions[next]!.revision);
    virtual.scrollToIndex(next);
  };
  const what = (one: Revision) => {
    const done = one.autosave ? t('doc.autosave') : actionText(one.action);
    if (!ofProject) return done;
    return `${done} · ${one.object_name ?? t('undo.several', { count: one.object_count })}`;
  };
  return (
    <div
      ref={scroll}
      className={styles.list}
      role="listbox"
      aria-label={t('doc.revisions')}
      aria-activedescendant={at >= 0 ? `${id}-${at}` : undefined}
      tabIndex={0}
      data-autofocus
      onKeyDown={onKeyDown}
    >
      <div className={styles.rows} style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map(({ index, start }) => {
          const one = revisions[index]!;
          return (
            <div
              key={one.revision}
              id={`${id}-${index}`}
              role="option"
              aria-selected={index === at}
              className={styles.revision}
              style={{ transform: `translateY(${start}px)` }}
              title={one.comment}
              onClick={() => select(one.revision)}
            >
              <b className="digits">{one.revision}</b>
              <span className={styles.what}>{what(one)}</span>
              <small>
                <time className="digits" dateTime={one.at}>
                  {secondText(one.at)}
                </time>
                {` · ${one.author}`}
                {index === 0 && ` · ${t('history.now')}`}
                {one.comment && ` · ${one.comment}`}
              </small>
            </div>
          );
        })}
      </div>
    </div>
  );
}
