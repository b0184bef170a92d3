import { ArrowDown, ArrowLeft, ArrowRight, ArrowUp, SlidersHorizontal } from 'lucide-react';
import type { KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { openDialog } from '@/ui/dialogs';
import { Failed, Loading } from '@/ui/Empty';
import { Grid } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { usePathBlocks, withInstance, type Chain, type Instance, type PathBlock } from './blocks';
import { movedColumn } from './columns';
import own from './CncSettings.module.css';
import { ParameterDialog } from './ParameterDialog';

interface PreprocessorTabProps {
  projectId: string;
  chain: Chain;
  readOnly: string | null;
  onChain: (chain: Chain) => void;
}

/** What stands around the chain and cannot be removed (CNCS-03, CNCS-08). */
const FIRST = ['SMC_NCDecoder'];
const LAST = ['SMC_CheckVelocities', 'SMC_Interpolator'];

/** The chain of blocks that changes paths: those of the library on the left, the instances on the right. */
export function PreprocessorTab({ projectId, chain, readOnly, onChain }: PreprocessorTabProps) {
  const { data: blocks, error } = usePathBlocks(projectId);
  if (error) return <Failed error={error} />;
  if (!blocks) return <Loading />;
  return <Lists blocks={blocks} chain={chain} readOnly={readOnly} onChain={onChain} />;
}

type ListsProps = Omit<PreprocessorTabProps, 'projectId'> & { blocks: readonly PathBlock[] };

function Lists({ blocks, chain, readOnly, onChain }: ListsProps) {
  const t = useText();
  const offered = useGridSelection(blocks.length);
  const rows = [...FIRST, ...chain.map(({ block }) => block), ...LAST];
  const used = useGridSelection(rows.length);
  const at = used.cursor === null ? -1 : used.cursor.row - FIRST.length;
  const isInstance = at >= 0 && at < chain.length;
  const block = isInstance ? blocks.find(({ name }) => name === chain[at]!.block) : undefined;
  const chosen = offered.cursor && blocks[offered.cursor.row];

  const add = () => {
    if (readOnly !== null || !chosen) return;
    const behind = isInstance ? at : at < 0 && used.cursor !== null ? -1 : chain.length - 1;
    onChain(withInstance(chain, chosen.name, behind));
    used.move({ row: behind + 1 + FIRST.length, column: 0 }, 'one');
  };
  const remove = () => {
    if (readOnly === null && isInstance) onChain(chain.filter((_, number) => number !== at));
  };
  const shift = (by: number) => {
    const next = isInstance && readOnly === null ? movedColumn(chain, at, at + by) : null;
    if (next === null) return;
    onChain(next);
    used.move({ row: at + by + FIRST.length, column: 0 }, 'one');
  };
  const configure = async () => {
    if (readOnly !== null || !block || block.parameters.length === 0) return;
    const answer = await openDialog<Instance>((close) => (
      <ParameterDialog block={block} instance={chain[at]!} close={close} />
    ));
    if (answer) onChain(chain.map((one, number) => (number === at ? answer : one)));
  };
  const taken = (event: KeyboardEvent, act: () => void) => {
    event.preventDefault();
    act();
    return true;
  };
  const onKey = (event: KeyboardEvent): boolean => {
    if (event.key === 'Delete') return taken(event, remove);
    if (event.shiftKey && event.key === 'ArrowUp') return taken(event, () => shift(-1));
    if (event.shiftKey && event.key === 'ArrowDown') return taken(event, () => shift(1));
    if (event.code === 'KeyP' && !event.ctrlKey && !event.metaKey) return taken(event, () => void configure());
    return false;
  };
  const chooseInstance = isInstance ? null : t('cncSettings.chooseInstance');
  const cannotShift = (by: number) =>
    readOnly ?? chooseInstance ?? (movedColumn(chain, at, at + by) === null ? t('cncSettings.atEnd') : null);
  const noParameters = block && block.parameters.length > 0 ? null : t('cncSettings.noParameters');
  return (
    <div className={own.chain}>
      <div className={own.half}>
        <Grid
          label={t('cncSettings.offered')}
          columns={[{ id: 'name', title: t('cncSettings.offered'), width: 220, grow: true }]}
          count={blocks.length}
          keyOf={(row) => blocks[row]?.name ?? ''}
          cell={(row) => blocks[row]!.name}
          hint={(row) => blocks[row]!.comment}
          selected={offered.selected}
          cursor={offered.cursor}
          onCursor={offered.move}
          onEdit={({ initial }) => initial === undefined && add()}
          onKey={(event) => event.key === ' ' && taken(event, add)}
        />
      </div>
      <div className={own.between} role="toolbar" aria-label={t('cncSettings.preprocessor')}>
        <IconButton
          icon={ArrowRight}
          label={t('cncSettings.add')}
          disabledReason={readOnly ?? (chosen ? null : t('cncSettings.chooseBlock'))}
          onClick={add}
        />
        <IconButton
          icon={ArrowLeft}
          label={t('cncSettings.remove')}
          disabledReason={readOnly ?? chooseInstance}
          onClick={remove}
        />
        <IconButton
          icon={ArrowUp}
          label={t('cncSettings.earlier')}
          shortcut="Shift+ArrowUp"
          disabledReason={cannotShift(-1)}
          onClick={() => shift(-1)}
        />
        <IconButton
          icon={ArrowDown}
          label={t('cncSettings.later')}
          shortcut="Shift+ArrowDown"
          disabledReason={cannotShift(1)}
          onClick={() => shift(1)}
        />
        <IconButton
          icon={SlidersHorizontal}
          label={t('cncSettings.parameters')}
          shortcut="P"
          disabledReason={readOnly ?? chooseInstance ?? noParameters}
          onClick={() => void configure()}
        />
      </div>
      <div className={own.half}>
        <Grid
          label={t('cncSettings.used')}
          columns={[
            { id: 'block', title: t('cncSettings.used'), width: 220, grow: true },
            { id: 'values', title: t('cncSettings.parameters'), width: 220, grow: true, code: true },
          ]}
          count={rows.length}
          keyOf={(row) => `${row} ${rows[row]}`}
          cell={(row, { id }) => {
            const instance = chain[row - FIRST.length];
            if (id === 'values') return instance?.parameters.map(({ name, value }) => `${name} := ${value}`).join(', ');
            return instance ? instance.block : <i className={own.fixed}>{rows[row]}</i>;
          }}
          hint={(row) => (chain[row - FIRST.length] ? undefined : t('cncSettings.fixed'))}
          selected={used.selected}
          cursor={used.cursor}
          onCursor={used.move}
          onEdit={({ initial }) => initial === undefined && void configure()}
          onKey={onKey}
        />
      </div>
    </div>
  );
}
