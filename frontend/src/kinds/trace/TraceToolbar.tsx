import { ChartLine, SquareMenu } from 'lucide-react';
import { Fragment, memo } from 'react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { DropdownMenu, type MenuEntry } from '@/ui/Menu';
import type { Handlers } from '@/workbench/commands';
import { reasonText } from '@/workbench/run';
import { ACT_GROUPS, type TraceActId } from './acts';
import type { TraceView } from './traceView';
import styles from './Trace.module.css';

/** The part of the view that buttons show. */
export type ToolView = Pick<TraceView, 'tool' | 'multi' | 'cursors'>;

interface TraceToolbarProps {
  acts: Handlers;
  view: ToolView;
  recording: boolean;
}

/** Acts whose button stays pressed. */
function pressed(id: TraceActId, view: ToolView, recording: boolean): boolean | undefined {
  switch (id) {
    case 'trace.mouseScroll':
      return view.tool === 'scroll';
    case 'trace.mouseZoom':
      return view.tool === 'zoom';
    case 'trace.multiChannel':
      return view.multi;
    case 'trace.cursor':
      return view.cursors.length > 0;
    case 'trace.longTerm':
      return recording;
    default:
      return undefined;
  }
}

/** Keys of the diagrams that do the same. */
const KEYS: Partial<Record<TraceActId, string>> = {
  'trace.resetView': '0',
  'trace.compress': '-',
  'trace.stretch': '+',
};

export const TraceToolbar = memo(function TraceToolbar({ acts, view, recording }: TraceToolbarProps) {
  const t = useText();
  return (
    <div className={styles.toolbar} role="toolbar" aria-label={t('trace.tools')}>
      {ACT_GROUPS.map((group, number) => (
        <Fragment key={group[0].id}>
          {number > 0 && <span className={styles.divider} aria-hidden />}
          {group.map((act) => {
            if (!('icon' in act)) return null;
            const { run, enabled } = acts[act.id]!;
            return (
              <IconButton
                key={act.id}
                icon={act.icon}
                label={t(act.id)}
                shortcut={KEYS[act.id]}
                pressed={pressed(act.id, view, recording)}
                disabledReason={enabled === undefined || enabled === true ? null : reasonText(enabled)}
                onClick={() => void run()}
              />
            );
          })}
        </Fragment>
      ))}
      <span className={styles.grow} />
      <DropdownMenu
        align="end"
        trigger={
          <Button variant="quiet" icon={SquareMenu}>
            {t('trace.menu')}
          </Button>
        }
        entries={() => menuEntriesOf(acts, view, recording, t)}
      />
    </div>
  );
});

/** All acts as a menu, in their groups (TRC-05). */
export function menuEntriesOf(
  acts: Handlers,
  view: ToolView,
  recording: boolean,
  t: ReturnType<typeof useText>,
): MenuEntry[] {
  return ACT_GROUPS.flatMap((group, number) => [
    ...(number > 0 ? [{ kind: 'line' as const, key: `line ${number}` }] : []),
    ...group.map((act): MenuEntry => {
      const { run, enabled } = acts[act.id]!;
      return {
        kind: 'item',
        key: act.id,
        text: t(act.id),
        icon: 'icon' in act ? act.icon : undefined,
        shortcut: KEYS[act.id],
        checked: pressed(act.id, view, recording),
        disabledReason: enabled === undefined || enabled === true ? null : reasonText(enabled),
        run: () => void run(),
      };
    }),
  ]);
}

export const TraceIcon = ChartLine;
