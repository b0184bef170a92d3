import { Plus } from 'lucide-react';
import { ofKind } from '@/api/objects';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { kindTitle, objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { FormPage, Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { openObject } from '@/workbench/docking/dock';
import { runCommand } from '@/workbench/run';
import {
  exampleLine,
  extensionFault,
  FILE_COLUMNS,
  folderFault,
  isValid,
  SEPARATORS,
  withColumn,
  type FileColumn,
  type RecipeManager,
  type Separator,
} from './model';

const ManagerIcon = objectIcon('recipe_manager');
const DefinitionIcon = objectIcon('recipe_definition');

/** How recipes are kept in the controller, and the recipe definitions. */
export default function RecipeManagerEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('recipe_manager'), isValid);
  const { data: objects } = useObjects(projectId);
  const definitions = (objects ?? [])
    .filter((object) => object.parent_id === objectId)
    .sort((a, b) => a.index - b.index);
  const disabled = draft.readOnly !== null;
  return (
    <FormPage draft={draft}>
      {(manager) => {
        const change = (part: Partial<RecipeManager>) => draft.change({ ...manager, ...part });
        return (
          <>
            <h1 className={styles.title}>
              <ManagerIcon size={20} />
              {kindTitle('recipe_manager')}
            </h1>
            <Section
              title={t('recipeManager.definitions')}
              tools={
                <Button
                  icon={Plus}
                  disabledReason={draft.readOnly}
                  onClick={() =>
                    void runCommand('project.addObject', {
                      kind: 'recipe_definition',
                      parentId: objectId,
                      view: 'devices',
                    })
                  }
                >
                  {t('recipeManager.add')}
                </Button>
              }
            >
              {definitions.length === 0 ? (
                <Empty title={t('recipeManager.none')} text={t('recipeManager.noneText')} />
              ) : (
                <div className={styles.tools}>
                  {definitions.map((item) => (
                    <Button key={item.id} icon={DefinitionIcon} onClick={() => openObject(item.id, item.name)}>
                      {item.name}
                    </Button>
                  ))}
                </div>
              )}
            </Section>
            <Section title={t('recipeManager.running')}>
              <div className={styles.fields}>
                <Checkbox
                  checked={manager.in_controller}
                  disabled={disabled}
                  onChecked={(in_controller) => change({ in_controller })}
                >
                  {t('recipeManager.inController')}
                </Checkbox>
                <span className={styles.note}>{t('recipeManager.inControllerHint')}</span>
                <Checkbox
                  checked={manager.save_changes}
                  disabled={disabled || !manager.in_controller}
                  onChecked={(save_changes) => change({ save_changes })}
                >
                  {t('recipeManager.saveChanges')}
                </Checkbox>
                <Checkbox
                  checked={manager.load_at_start}
                  disabled={disabled || !manager.in_controller}
                  onChecked={(load_at_start) => change({ load_at_start })}
                >
                  {t('recipeManager.loadAtStart')}
                </Checkbox>
                <Checkbox
                  checked={manager.exact_match}
                  disabled={disabled}
                  onChecked={(exact_match) => change({ exact_match })}
                >
                  {t('recipeManager.exact')}
                </Checkbox>
              </div>
            </Section>
            <Section title={t('recipeManager.files')}>
              <div className={styles.fields}>
                <Field row label={t('recipeManager.storage')} hint={t(`recipeManager.${manager.storage}Hint`)}>
                  {(attributes) => (
                    <Select<RecipeManager['storage']>
                      {...attributes}
                      disabled={disabled}
                      value={manager.storage}
                      choices={[
                        { value: 'textual', text: t('recipeManager.textual') },
                        { value: 'binary', text: t('recipeManager.binary') },
                      ]}
                      onValue={(storage) => change({ storage })}
                    />
                  )}
                </Field>
                <Field
                  row
                  label={t('recipeManager.folder')}
                  hint={t('recipeManager.folderHint')}
                  error={folderFault(manager.path) ? t('recipeManager.folderFault') : null}
                >
                  {(attributes) => (
                    <TextInput
                      {...attributes}
                      disabled={disabled}
                      value={manager.path}
                      onValue={(path) => change({ path })}
                    />
                  )}
                </Field>
                <Field
                  row
                  label={t('recipeManager.extension')}
                  error={extensionFault(manager.extension) ? t('recipeManager.extensionFault') : null}
                >
                  {(attributes) => (
                    <TextInput
                      {...attributes}
                      className={styles.narrow}
                      disabled={disabled}
                      value={manager.extension}
                      onValue={(extension) => change({ extension })}
                    />
                  )}
                </Field>
                <Field row label={t('recipeManager.separator')}>
                  {(attributes) => (
                    <Select<Separator>
                      {...attributes}
                      disabled={disabled || manager.storage === 'binary'}
                      value={manager.separator}
                      choices={SEPARATORS.map((value) => ({
                        value,
                        text:
                          value === ' '
                            ? t('recipeManager.separator.space')
                            : value === '\t'
                              ? t('recipeManager.separator.tab')
                              : value,
                      }))}
                      onValue={(separator) => change({ separator })}
                    />
                  )}
                </Field>
                <Field row label={t('recipeManager.columns')}>
                  {() => (
                    <div className={styles.tools}>
                      {[...manager.columns, 'none' as const].slice(0, FILE_COLUMNS.length).map((column, place) => (
                        <Select<FileColumn | 'none'>
                          key={place}
                          compact
                          label={t('recipeManager.column', { place: place + 1 })}
                          disabled={disabled || manager.storage === 'binary'}
                          value={column}
                          choices={[...FILE_COLUMNS, 'none' as const].map((value) => ({
                            value,
                            text: t(`recipeManager.column.${value}`),
                          }))}
                          onValue={(value) => change({ columns: [...withColumn(manager.columns, place, value)] })}
                        />
                      ))}
                    </div>
                  )}
                </Field>
                {manager.storage === 'textual' && (
                  <Field row label={t('recipeManager.example')}>
                    {() => <span className="code">{exampleLine(manager)}</span>}
                  </Field>
                )}
              </div>
            </Section>
          </>
        );
      }}
    </FormPage>
  );
}
