import {
  CaseSensitive,
  ChevronDown,
  ChevronRight,
  CopyMinus,
  Eraser,
  Regex,
  RefreshCw,
  Replace,
  WholeWord,
  X,
} from 'lucide-react';
import { useEffect, useMemo, useRef, useState } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { useProject } from '@/project/openProject';
import { Button, IconButton } from '@/ui/Button';
import { Empty, Spinner } from '@/ui/Empty';
import { Select, TextInput } from '@/ui/Field';
import { FilterToggles } from '@/ui/Filter';
import { Panel, PanelRest } from '@/ui/Panel';
import { toggledIn } from '@/ui/toggleSet';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { useCommandContext } from '@/workbench/useCommandContext';
import { AREAS, changedSince, chosenHits, hitCount, keyOf, SCOPES, type Area } from './model';
import { ResultTree } from './ResultTree';
import styles from './Search.module.css';
import { changeForm, clearSearch, replaceChosen, search, searchOn, stopSearch, useSearch } from './store';

/** Search and replace in the project: what, where, and the places found, by object. */
export default function SearchPanel() {
  const t = useText();
  const { form, groups, next, answered, busy, error, leftOut, projectId: searched, focusSerial } = useSearch();
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const context = useCommandContext();
  const field = useRef<HTMLInputElement>(null);
  const [closed, setClosed] = useState<ReadonlySet<string>>(new Set());
  const shown = searched === projectId ? groups : [];
  const hits = useMemo(() => hitCount(groups), [groups]);
  const old = useMemo(
    () => searched === projectId && changedSince(groups, objects ?? []),
    [groups, objects, searched, projectId],
  );
  const chosen = shown.reduce((sum, group) => sum + chosenHits(group, leftOut).length, 0);
  const replacing = form.replacing && form.scope !== 'libraries';
  const mayReplace = mayEdit(context);

  useEffect(() => {
    if (focusSerial > 0) field.current?.select();
  }, [focusSerial]);

  const refusal = (): string | null => {
    if (mayReplace !== true) return reasonText(mayReplace);
    if (form.scope === 'libraries') return t('search.librariesReadOnly');
    return chosen === 0 ? t('search.nothingChosen') : null;
  };
  const found = (counted: boolean): string => {
    const places = t('search.places', {
      hits: t(next === null ? 'search.hits' : 'search.hitsAndMore', { count: hits }),
      objects: t('search.inObjects', { count: shown.length }),
    });
    return counted ? t('search.placesChosen', { places, count: chosen }) : places;
  };
  const fault = (of: 'text' | 'replacement') => (error?.field === of ? error.text : null);

  return (
    <Panel>
      <div className={styles.form}>
        <div className={styles.line}>
          <IconButton
            small
            icon={form.replacing ? ChevronDown : ChevronRight}
            label={t('search.showReplace')}
            pressed={form.replacing}
            onClick={() => changeForm({ replacing: !form.replacing })}
          />
          <TextInput
            ref={field}
            data-autofocus
            className={styles.input}
            value={form.text}
            onValue={(text) => changeForm({ text })}
            onKeyDown={(event) => event.key === 'Enter' && void search()}
            placeholder={t('search.text')}
            aria-label={t('search.text')}
            aria-invalid={fault('text') !== null || undefined}
            aria-describedby={fault('text') === null ? undefined : 'search-text-fault'}
          />
          <IconButton
            small
            icon={CaseSensitive}
            label={t('search.matchCase')}
            pressed={form.matchCase}
            onClick={() => changeForm({ matchCase: !form.matchCase })}
          />
          <IconButton
            small
            icon={WholeWord}
            label={t('search.wholeWords')}
            pressed={form.wholeWords}
            onClick={() => changeForm({ wholeWords: !form.wholeWords })}
          />
          <IconButton
            small
            icon={Regex}
            label={t('search.regularExpression')}
            pressed={form.regularExpression}
            onClick={() => changeForm({ regularExpression: !form.regularExpression })}
          />
        </div>
        <Fault id="search-text-fault" text={fault('text')} />
        {form.replacing && (
          <>
            <div className={styles.line}>
              <span className={styles.indent} />
              <TextInput
                className={styles.input}
                value={form.replacement}
                onValue={(replacement) => changeForm({ replacement })}
                placeholder={t('search.replacement')}
                aria-label={t('search.replacement')}
                aria-invalid={fault('replacement') !== null || undefined}
                aria-describedby={fault('replacement') === null ? undefined : 'search-replacement-fault'}
              />
              <Button icon={Replace} disabledReason={refusal()} onClick={() => void replaceChosen()}>
                {t('search.replace')}
              </Button>
            </div>
            <Fault id="search-replacement-fault" text={fault('replacement')} />
          </>
        )}
        <div className={styles.line}>
          <Select
            label={t('search.scope')}
            className={styles.scope}
            value={form.scope}
            choices={SCOPES.map((scope) => ({ value: scope, text: t(`search.scope.${scope}`) }))}
            onValue={(scope) => changeForm({ scope })}
          />
          <IconButton small icon={RefreshCw} label={t('search.again')} onClick={() => void search()} />
          <IconButton
            small
            icon={CopyMinus}
            label={t('search.closeAll')}
            disabledReason={shown.length === 0 ? t('search.nothingFound') : null}
            onClick={() => setClosed(new Set(closed.size > 0 ? [] : shown.map(keyOf)))}
          />
          <IconButton small icon={Eraser} label={t('search.clear')} onClick={clearSearch} />
        </div>
        <div className={styles.areas} role="group" aria-label={t('search.areas')}>
          <FilterToggles<Area>
            kinds={AREAS}
            hidden={new Set(AREAS.filter((area) => !form.areas.includes(area)))}
            toggle={(area) => changeForm({ areas: [...toggledIn(new Set(form.areas), area)] })}
          >
            {(area) => t(`search.area.${area}`)}
          </FilterToggles>
        </div>
      </div>
      <div className={styles.summary} role="status">
        {busy && (
          <>
            <Spinner size={12} />
            <span className={styles.grow}>{t('search.busy')}</span>
            <IconButton small icon={X} label={t('action.cancel')} onClick={stopSearch} />
          </>
        )}
        {!busy && answered && (
          <span className={styles.grow}>{hits === 0 ? t('search.nothingFound') : found(replacing)}</span>
        )}
        {!busy && error !== null && error.field === null && <span className={styles.fault}>{error.text}</span>}
        {!busy && old && <span className={styles.old}>{t('search.old')}</span>}
      </div>
      <PanelRest>
        {shown.length > 0 ? (
          <ResultTree groups={shown} closed={closed} setClosed={setClosed} replacing={replacing} leftOut={leftOut}>
            {next !== null && (
              <Button className={styles.more} onClick={() => void searchOn()}>
                {t('search.more')}
              </Button>
            )}
          </ResultTree>
        ) : (
          !busy && <NoResults answered={answered} noArea={form.areas.length === 0} />
        )}
      </PanelRest>
    </Panel>
  );
}

function Fault({ id, text }: { id: string; text: string | null }) {
  return text === null ? null : (
    <div id={id} className={styles.fault} role="alert">
      {text}
    </div>
  );
}

function NoResults({ answered, noArea }: { answered: boolean; noArea: boolean }) {
  const t = useText();
  if (noArea) return <Empty title={t('search.noArea')} />;
  if (answered) return <Empty title={t('search.nothingFound')} text={t('search.nothingFoundText')} />;
  return <Empty title={t('search.start')} text={t('search.startText')} />;
}
