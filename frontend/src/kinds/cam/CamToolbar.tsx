import { Maximize2, MousePointer2, Plus, SquareMenu, Trash2 } from 'lucide-react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { DropdownMenu } from '@/ui/Menu';
import { openDialog } from '@/ui/dialogs';
import styles from './Cam.module.css';
import { CodeDialog } from './CodeDialog';
import type { CamEdit, Tool } from './edit';
import { ExportDialog } from './ExportDialog';
import { ImportDialog } from './ImportDialog';
import { removable, removed } from './keyActs';
import { OptimiseDialog } from './OptimiseDialog';
import { deleteTappet } from './tappets';

interface CamToolbarProps {
  projectId: string;
  name: string;
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
export function CamToolbar({ projectId, name, edit, readOnly, tool, onTool, tools, drawn, fit }: CamToolbarProps) {
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
        entries={() => [
          {
            kind: 'item',
            key: 'import',
            text: t('cam.import'),
            disabledReason: readOnly,
            run: () => void openDialog((close) => <ImportDialog projectId={projectId} edit={edit} close={close} />),
          },
          {
            kind: 'item',
            key: 'export',
            text: t('cam.export'),
            run: () =>
              void openDialog((close) => (
                <ExportDialog projectId={projectId} name={name} cam={edit.cam} close={close} />
              )),
          },
          { kind: 'line', key: 'line' },
          {
            kind: 'item',
            key: 'optimise',
            text: t('cam.optimise'),
            disabledReason: readOnly,
            run: () => void openDialog((close) => <OptimiseDialog projectId={projectId} edit={edit} close={close} />),
          },
          {
            kind: 'item',
            key: 'code',
            text: t('cam.code'),
            run: () =>
              void openDialog((close) => <CodeDialog projectId={projectId} name={name} cam={edit.cam} close={close} />),
          },
        ]}
      />
    </div>
  );
}
