import { Download, Plus, SquareMenu, Trash2, Upload } from 'lucide-react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { DropdownMenu } from '@/ui/Menu';
import type { Handlers } from '@/workbench/commands';
import { reasonText, runCommand } from '@/workbench/run';
import { RECIPE_ACTS, type RecipeActId } from './acts';
import type { RecipeDefinition } from './model';
import styles from './Recipes.module.css';

const IN_MENU: readonly RecipeActId[] = [
  'recipes.addRecipe',
  'recipes.renameRecipe',
  'recipes.removeRecipe',
  'recipes.import',
  'recipes.export',
  'recipes.files',
];

interface RecipeToolbarProps {
  acts: Handlers;
  definition: RecipeDefinition;
  recipe: string | null;
  onRecipe: (recipe: string) => void;
}

/** Variables to the left, the recipe that is worked with to the right. */
export function RecipeToolbar({ acts, definition, recipe, onRecipe }: RecipeToolbarProps) {
  const t = useText();
  const refusal = (id: RecipeActId) => {
    const enabled = acts[id]?.enabled;
    return enabled === undefined || enabled === true ? null : reasonText(enabled);
  };
  const run = (id: RecipeActId) => () => void runCommand(id);
  return (
    <div className={styles.toolbar} role="toolbar" aria-label={t('recipes.tools')}>
      <Button
        variant="quiet"
        icon={Plus}
        disabledReason={refusal('recipes.addVariables')}
        onClick={run('recipes.addVariables')}
      >
        {t('recipes.addVariables')}
      </Button>
      <IconButton
        icon={Trash2}
        label={t('recipes.removeVariables')}
        shortcut="Delete"
        disabledReason={refusal('recipes.removeVariables')}
        onClick={run('recipes.removeVariables')}
      />
      <span className={styles.line} aria-hidden />
      <Button
        variant="quiet"
        icon={Plus}
        disabledReason={refusal('recipes.addRecipe')}
        onClick={run('recipes.addRecipe')}
      >
        {t('recipes.addRecipe')}
      </Button>
      <span className={styles.grow} />
      <Select
        className={styles.recipe}
        label={t('recipes.recipe')}
        placeholder={t('recipes.noRecipe')}
        disabled={definition.recipes.length === 0}
        value={recipe}
        choices={definition.recipes.map(({ name }) => ({ value: name, text: name }))}
        onValue={onRecipe}
      />
      <Button icon={Upload} disabledReason={refusal('recipes.read')} onClick={run('recipes.read')}>
        {t('recipes.readShort')}
      </Button>
      <Button icon={Download} disabledReason={refusal('recipes.write')} onClick={run('recipes.write')}>
        {t('recipes.writeShort')}
      </Button>
      <DropdownMenu
        align="end"
        trigger={
          <Button variant="quiet" icon={SquareMenu}>
            {t('recipes.menu')}
          </Button>
        }
        entries={() =>
          RECIPE_ACTS.filter(({ id }) => IN_MENU.includes(id)).map(({ id }) => ({
            kind: 'item' as const,
            key: id,
            text: t(id),
            disabledReason: refusal(id),
            run: run(id),
          }))
        }
      />
    </div>
  );
}
