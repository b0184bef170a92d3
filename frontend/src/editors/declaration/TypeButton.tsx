import { useText } from '@/i18n';
import { DropdownMenu } from '@/ui/Menu';
import grid from '@/ui/grid/CellInput.module.css';

/** The ">" of a data type cell: type browser or array wizard (DECL-27). */
export function TypeButton({ onAssistant, onArray }: { onAssistant: () => void; onArray: () => void }) {
  const t = useText();
  return (
    <DropdownMenu
      align="end"
      trigger={
        <button type="button" className={grid.button} aria-label={t('decl.chooseType')} title={t('decl.chooseType')}>
          ›
        </button>
      }
      entries={() => [
        { kind: 'item', key: 'assistant', text: t('decl.typeBrowser'), shortcut: 'F2', run: onAssistant },
        { kind: 'item', key: 'array', text: t('decl.arrayWizard'), run: onArray },
      ]}
    />
  );
}
