import { Maximize2, MousePointer2, Plus, SquareMenu, Trash2 } from 'lucide-react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { DropdownMenu } from '@/ui/Menu';
import type { Handlers } from '@/workbench/commands';
import { reasonText } from '@/workbench/run';
import { CAM_ACTS, type CamActId } from './acts';
import styles from './Cam.module.css';
import type { CamEdit, Tool } from './edit';
import { removable, removed } from './keyActs';
import { deleteTappet } from './tappets';

const LINE_BEFORE: ReadonlySet<CamActId> = new Set(['cam.optimise', 'cam.readRunning']);

interface CamToolbarProps {
  acts: Handlers;
  edit: CamEdit;
  readOnly: string | null;
  tool: Tool;
  onTool: (tool: Tool) => void;
  /** What the view in front is about (CAM-20). */
  tools: 'points' | 'tappets';
  /** It is drawn, so that there are tools for the pointer. */
  drawn: boolean;
  /** Shows the whole range of the master; null: it is shown. */
  fit: (() => void) | null;
}

/** The tools of the view in front (CAM-20 to CAM-23), and what can be done with the whole cam (CAM-80 to CAM-83). */
export function CamToolbar({ acts, edit, readOnly, tool, onTool, tools, drawn, fit }: CamToolbarProps) {
  const t = useText();
  const { selected } = edit;
  const tappet = selected?.kind === 'tappet' ? selected : null;
  const canDelete = tools === 'points' ? removable(edit) : tappet !== null;
  const remove = () => {
    if (tools === 'points') removed(edit);
    else if (tappet) edit.change(deleteTappet(edit.cam, tappet), null);
  };
  return (
    <div className={styles.toolbar} role="toolbar" aria-label={t('cam.tools')}>
      {drawn && (
        <>
          <IconButton
            icon={MousePointer2}
            label={t('cam.tool.select')}
            shortcut="Escape"
            pressed={tool === 'select'}
            onClick={() => onTool('select')}
          />
          <IconButton
            icon={Plus}
            label={t(tools === 'points' ? 'cam.tool.addPoint' : 'cam.tool.addTappet')}
            pressed={tool === 'add'}
            disabledReason={readOnly}
            onClick={() => onTool('add')}
          />
        </>
      )}
      <IconButton
        icon={Trash2}
        label={t(tools === 'points' ? 'cam.deletePoint' : 'cam.deleteTappet')}
        shortcut="Delete"
        disabledReason={readOnly ?? (canDelete ? null : t(tools === 'points' ? 'cam.noPoint' : 'cam.noTappet'))}
        onClick={remove}
      />
      {tools === 'points' && drawn && (
        <IconButton
          icon={Maximize2}
          label={t('cam.fit')}
          shortcut="0"
          disabledReason={fit === null ? t('cam.isFit') : null}
          onClick={() => fit?.()}
        />
      )}
      <span className={styles.grow} />
      <DropdownMenu
        align="end"
        trigger={
          <Button variant="quiet" icon={SquareMenu}>
            {t('cam.menu')}
          </Button>
        }
        entries={() =>
          CAM_ACTS.flatMap(({ id }) => {
            const { run, enabled } = acts[id]!;
            const entry = {
              kind: 'item' as const,
              key: id,
              text: t(id),
              disabledReason: enabled === undefined || enabled === true ? null : reasonText(enabled),
              run: () => void run(),
            };
            return LINE_BEFORE.has(id) ? [{ kind: 'line' as const, key: `line ${id}` }, entry] : [entry];
          })
        }
      />
    </div>
  );
}
