import { useQuery } from '@tanstack/react-query';
import { useRef, useState, type KeyboardEvent } from 'react';
import { api, ApiError } from '@/api/client';
import { keys } from '@/api/queries';
import type { PlacementRule, ProjectObject } from '@/api/types';
import { textOf, useText } from '@/i18n';
import { ACCESS_SPECIFIERS } from '@/iec/grammar';
import {
  kindAbout,
  kindOf,
  kindTitle,
  objectIcon,
  subkindTitle,
  type AddOption,
  type AddValues,
} from '@/project/kinds';
import { explain } from '@/ui/notices';
import { createObject } from '../tree/acts';
import { displayName } from '@/project/objectName';
import { firstChoice, ownerOf, fixedNames, nameFault, placeableKinds, proposedName } from '@/project/placement';
import type { Forest, TreeView } from '@/project/tree';
import { FormDialog } from '@/ui/FormDialog';
import { Field, Select, TextInput } from '@/ui/Field';
import styles from './AddObjectDialog.module.css';
import { declarationOf } from './declaration';

type Language = PlacementRule['languages'][number];

interface AddObjectProps {
  projectId: string;
  forest: Forest;
  rules: readonly PlacementRule[];
  view: TreeView;
  parentId: string | null;
  /** Chosen in a menu: the dialog opens with this kind. */
  kind?: string;
  close: (created?: ProjectObject) => void;
}

/** Add Object: kinds that may be here at the left, name and what the kind needs at the right. */
export function AddObjectDialog({ projectId, forest, rules, view, parentId, kind, close }: AddObjectProps) {
  const t = useText();
  const languages = useQuery({
    queryKey: keys.languages,
    queryFn: () => api.get('/api/v1/languages'),
    staleTime: Infinity,
  });
  const kinds = placeableKinds(rules, forest, parentId, view);
  const [rule, setRule] = useState(() => firstChoice(kinds, kind));
  const [subkind, setSubkind] = useState<string | undefined>(rule.subkinds[0]);
  const [language, setLanguage] = useState<Language | undefined>(rule.languages[0]);
  const [name, setName] = useState(() => proposedName(rule, forest, parentId));
  const [options, setOptions] = useState<AddValues>({});
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const nameInput = useRef<HTMLInputElement>(null);
  const fixed = fixedNames(rule, forest, parentId);
  const fault = nameFault(rules, rule.kind, forest, parentId, name);
  const owner = ownerOf(forest, parentId);

  const languageTitle = (name: string) =>
    textOf(`language.${name}`) ?? languages.data?.find((each) => each.name === name)?.title ?? name;

  const choose = (next: PlacementRule) => {
    setRule(next);
    setSubkind(next.subkinds[0]);
    setLanguage(next.languages[0]);
    setName(proposedName(next, forest, parentId));
    setOptions({});
    setRefused(null);
    requestAnimationFrame(() => nameInput.current?.select());
  };

  const create = async () => {
    if (busy) return;
    setBusy(true);
    try {
      const declaration = declarationOf(rule.kind, { subkind, name, values: options });
      const data = declaration === null ? undefined : withBody(rule.kind, declaration, language);
      const order = { parent_id: parentId, kind: rule.kind, name, subkind, language, data };
      close(await createObject(projectId, order));
    } catch (error) {
      setBusy(false);
      setRefused(error instanceof ApiError ? error.message : (explain(error).text ?? explain(error).title));
    }
  };

  const option = (key: AddOption) =>
    key === 'access' ? (
      <Field key={key} label={t('addObject.access')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={options.access ?? 'PUBLIC'}
            choices={ACCESS_SPECIFIERS.map((access) => ({ value: access, text: access }))}
            onValue={(access) => setOptions({ ...options, access })}
          />
        )}
      </Field>
    ) : (
      <Field key={key} label={t(`addObject.${key}`)}>
        {(attributes) => (
          <TextInput
            {...attributes}
            value={options[key] ?? ''}
            placeholder={t(`addObject.${key}Example`)}
            onValue={(value) => setOptions({ ...options, [key]: value })}
          />
        )}
      </Field>
    );

  return (
    <FormDialog
      title={owner ? t('addObject.titleAt', { name: displayName(owner) }) : t('addObject.title')}
      width={620}
      onClose={() => close()}
      onSubmit={() => void create()}
      action={t('action.add')}
      disabledReason={fault && t(fault.key, fault.values)}
    >
      <div className={styles.columns}>
        <div className={styles.kinds} role="radiogroup" aria-label={t('addObject.kind')} onKeyDown={walk}>
          {kinds.map((candidate) => {
            const Icon = objectIcon(candidate.kind);
            const chosen = candidate.kind === rule.kind;
            return (
              <button
                key={candidate.kind}
                type="button"
                role="radio"
                aria-checked={chosen}
                tabIndex={chosen ? 0 : -1}
                className={styles.kind}
                onClick={() => choose(candidate)}
              >
                <Icon />
                {kindTitle(candidate.kind)}
              </button>
            );
          })}
        </div>
        <div className={styles.form}>
          <p className={styles.about}>{kindAbout(rule.kind)}</p>
          <Field label={t('addObject.name')} error={refused ?? (fault && t(fault.key, fault.values))}>
            {(attributes) =>
              fixed.length > 0 ? (
                <Select
                  {...attributes}
                  value={name}
                  choices={fixed.map((each) => ({ value: each, text: each }))}
                  onValue={setName}
                />
              ) : (
                <TextInput
                  {...attributes}
                  ref={nameInput}
                  data-autofocus
                  value={name}
                  onValue={(value) => {
                    setName(value);
                    setRefused(null);
                  }}
                />
              )
            }
          </Field>
          {rule.subkinds.length > 0 && (
            <div className={styles.subkinds} role="radiogroup" aria-label={t('addObject.type')} onKeyDown={walk}>
              {rule.subkinds.map((each) => {
                const Icon = objectIcon(rule.kind, each);
                return (
                  <button
                    key={each}
                    type="button"
                    role="radio"
                    aria-checked={each === subkind}
                    tabIndex={each === subkind ? 0 : -1}
                    className={styles.subkind}
                    onClick={() => setSubkind(each)}
                  >
                    <Icon />
                    {subkindTitle(each)}
                  </button>
                );
              })}
            </div>
          )}
          {kindOf(rule.kind)?.add?.optionsOf?.(subkind).map(option)}
          {language !== undefined && (
            <Field label={t('addObject.language')}>
              {(attributes) => (
                <Select
                  {...attributes}
                  value={language}
                  choices={rule.languages.map((each) => ({ value: each, text: languageTitle(each) }))}
                  onValue={setLanguage}
                />
              )}
            </Field>
          )}
        </div>
      </div>
    </FormDialog>
  );
}

/** Arrow keys walk through a group of radio buttons and choose as they go. */
function walk(event: KeyboardEvent<HTMLElement>): void {
  const step =
    event.key === 'ArrowDown' || event.key === 'ArrowRight'
      ? 1
      : event.key === 'ArrowUp' || event.key === 'ArrowLeft'
        ? -1
        : 0;
  if (!step) return;
  event.preventDefault();
  const buttons = [...event.currentTarget.querySelectorAll<HTMLButtonElement>('[role="radio"]')];
  const next = buttons[buttons.indexOf(document.activeElement as HTMLButtonElement) + step];
  next?.focus();
  next?.click();
}

/** Kinds with a body have an implementation beside their declaration. */
function withBody(kind: string, declaration: string, language: Language | undefined): Record<string, unknown> {
  const hasBody = kindOf(kind)?.parts?.includes('implementation');
  return hasBody ? { declaration, implementation: '', language } : { declaration };
}
