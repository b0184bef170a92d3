import { Box, SquareMenu, SquareSplitVertical, Table2, TextInitial } from 'lucide-react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { DropdownMenu } from '@/ui/Menu';
import type { Handlers } from '@/workbench/commands';
import { reasonText } from '@/workbench/run';
import { CNC_ACTS } from './acts';
import styles from './Cnc.module.css';
import type { CncDocument } from './cncDocument';
import type { CncProgramData } from './properties';
import { rowCount } from './table';
import { useProgramVersion } from './useProgramVersion';

export type CncView = 'text' | 'both' | 'table';

const VIEWS = [
  { view: 'text', icon: TextInitial },
  { view: 'both', icon: SquareSplitVertical },
  { view: 'table', icon: Table2 },
] as const;

interface CncToolbarProps {
  acts: Handlers;
  view: CncView;
  onView: (view: CncView) => void;
  /** The path is shown in 3D. */
  graphic: boolean;
  onGraphic: (graphic: boolean) => void;
  program: CncDocument;
  data: CncProgramData;
}

/** The views of the program, what is wrong with it, and the CNC menu. */
export function CncToolbar({ acts, view, onView, graphic, onGraphic, program, data }: CncToolbarProps) {
  const t = useText();
  useProgramVersion(program);
  const errors = program.found.filter(({ severity }) => severity === 'error').length;
  const warnings = program.found.length - errors;
  return (
    <div className={styles.toolbar} role="toolbar" aria-label={t('cnc.tools')}>
      <div role="group" aria-label={t('cnc.views')} className={styles.views}>
        {VIEWS.map(({ view: one, icon }) => (
          <IconButton
            key={one}
            icon={icon}
            label={t(`cnc.view.${one}`)}
            pressed={view === one}
            onClick={() => onView(one)}
          />
        ))}
      </div>
      <IconButton
        icon={Box}
        label={t(graphic ? 'cnc.path.hide' : 'cnc.path.show')}
        pressed={graphic}
        onClick={() => onGraphic(!graphic)}
      />
      <span className={styles.facts}>
        <span>{t(`cnc.mode.${data.compile_mode}`)}</span>
        <span>
          {t('cnc.blocks', {
            count: rowCount(program.program.count, program.program.block(program.program.count - 1).text),
          })}
        </span>
        <span role="status" data-tone={errors > 0 ? 'error' : warnings > 0 ? 'warn' : undefined}>
          {program.program.settled ? t('cnc.found', { errors, warnings }) : t('cnc.checking')}
        </span>
        {data.step_suppression && <span>{t('cnc.suppress')}</span>}
      </span>
      <span className={styles.grow} />
      <DropdownMenu
        align="end"
        trigger={
          <Button variant="quiet" icon={SquareMenu}>
            {t('cnc.menu')}
          </Button>
        }
        entries={() =>
          CNC_ACTS.flatMap(({ id, group }, at) => {
            const { run, enabled } = acts[id]!;
            const entry = {
              kind: 'item' as const,
              key: id,
              text: t(id),
              checked: id === 'cnc.suppress' ? data.step_suppression : undefined,
              disabledReason: enabled === undefined || enabled === true ? null : reasonText(enabled),
              run: () => void run(),
            };
            const before = CNC_ACTS[at - 1]?.group;
            return before === undefined || before === group
              ? [entry]
              : [{ kind: 'line' as const, key: `line ${id}` }, entry];
          })
        }
      />
    </div>
  );
}
