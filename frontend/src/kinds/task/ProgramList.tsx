import { ArrowDown, ArrowUp, Plus, Replace, SquareArrowOutUpRight, Trash2, TriangleAlert } from 'lucide-react';
import { useState, type KeyboardEvent } from 'react';
import type { ObjectSummary, TaskPou } from '@/api/types';
import { useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import { openDialog } from '@/ui/dialogs';
import { openObject } from '@/workbench/docking/dock';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Tooltip } from '@/ui/Tooltip';
import styles from './ProgramList.module.css';
import { movedPou } from './model';
import { ProgramPicker } from './ProgramPicker';

interface ProgramListProps {
  pous: readonly TaskPou[];
  /** Programs that can be called. */
  programs: readonly ObjectSummary[];
  readOnly: string | null;
  onChange: (pous: TaskPou[]) => void;
}

const ProgramIcon = objectIcon('pou', 'program');

/** The programs a task calls, top to bottom in every cycle (TASK-20, TASK-21). */
export function ProgramList({ pous, programs, readOnly, onChange }: ProgramListProps) {
  const t = useText();
  const [chosen, setChosen] = useState(0);
  const at = Math.min(chosen, pous.length - 1);
  const selected = pous[at];
  const known = (name: string) => programs.find((program) => program.name.toUpperCase() === name.toUpperCase());
  const none = selected ? null : t('task.chooseProgram');

  const pick = async (replacing: boolean) =>
    openDialog<string>((close) => <ProgramPicker replacing={replacing} programs={programs} close={close} />);
  const add = async () => {
    const name = await pick(false);
    if (!name) return;
    onChange([...pous.slice(0, at + 1), { name, comment: '' }, ...pous.slice(at + 1)]);
    setChosen(at + 1);
  };
  const replace = async () => {
    const name = await pick(true);
    if (name) onChange(pous.map((pou, index) => (index === at ? { ...pou, name } : pou)));
  };
  const remove = () => onChange(pous.filter((_, index) => index !== at));
  const move = (by: -1 | 1) => {
    onChange(movedPou(pous, at, by));
    setChosen(Math.max(0, Math.min(pous.length - 1, at + by)));
  };
  const open = () => {
    const program = selected && known(selected.name);
    if (program) openObject(program.id, program.name);
  };

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.target instanceof HTMLInputElement) return;
    const by = event.key === 'ArrowUp' ? -1 : event.key === 'ArrowDown' ? 1 : 0;
    if (by && event.altKey && !readOnly) move(by);
    else if (by) setChosen(Math.max(0, Math.min(pous.length - 1, at + by)));
    else if (event.key === 'Enter') open();
    else if (event.key === 'Delete' && selected && !readOnly) remove();
    else if (event.key === 'Insert' && !readOnly) void add();
    else return;
    event.preventDefault();
  };

  return (
    <div className={styles.list}>
      <div className={styles.tools}>
        <Button icon={Plus} disabledReason={readOnly} onClick={() => void add()}>
          {t('task.addProgram')}
        </Button>
        <IconButton
          icon={Replace}
          label={t('task.replaceProgram')}
          disabledReason={readOnly ?? none}
          onClick={() => void replace()}
        />
        <IconButton
          icon={SquareArrowOutUpRight}
          label={t('task.openProgram')}
          shortcut="Enter"
          disabledReason={none ?? (known(selected!.name) ? null : t('task.unknownProgram'))}
          onClick={open}
        />
        <IconButton
          icon={ArrowUp}
          label={t('action.moveUp')}
          shortcut="Alt+↑"
          disabledReason={readOnly ?? none ?? (at > 0 ? null : t('reason.first'))}
          onClick={() => move(-1)}
        />
        <IconButton
          icon={ArrowDown}
          label={t('action.moveDown')}
          shortcut="Alt+↓"
          disabledReason={readOnly ?? none ?? (at < pous.length - 1 ? null : t('reason.last'))}
          onClick={() => move(1)}
        />
        <IconButton
          icon={Trash2}
          label={t('task.removeProgram')}
          shortcut="Del"
          disabledReason={readOnly ?? none}
          onClick={remove}
        />
      </div>
      <div className={styles.table} role="grid" aria-label={t('task.programs')} tabIndex={0} onKeyDown={onKeyDown}>
        {pous.length === 0 && <Empty title={t('task.noPrograms')} text={t('task.noProgramsText')} />}
        {pous.map((pou, index) => (
          <div
            key={`${index}:${pou.name}`}
            role="row"
            aria-selected={index === at}
            className={styles.row}
            onMouseDown={() => setChosen(index)}
            onDoubleClick={open}
          >
            <span role="gridcell" className={styles.number}>
              {index + 1}
            </span>
            <span role="gridcell" className={styles.program}>
              <ProgramIcon />
              <span className={styles.name}>{pou.name}</span>
              {!known(pou.name) && (
                <Tooltip text={t('task.unknownProgram')}>
                  <TriangleAlert size={14} color="var(--warn)" />
                </Tooltip>
              )}
            </span>
            <span role="gridcell" className={styles.commentCell}>
              <input
                className={styles.comment}
                value={pou.comment}
                aria-label={t('task.comment', { name: pou.name })}
                placeholder={readOnly ? '' : t('task.commentHint')}
                disabled={readOnly !== null}
                onDoubleClick={(event) => event.stopPropagation()}
                onChange={(event) =>
                  onChange(
                    pous.map((other, place) => (place === index ? { ...other, comment: event.target.value } : other)),
                  )
                }
              />
            </span>
          </div>
        ))}
      </div>
    </div>
  );
}
