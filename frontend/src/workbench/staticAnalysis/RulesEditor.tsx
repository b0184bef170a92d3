import { ChevronRight, Search } from 'lucide-react';
import { useRef, useState } from 'react';
import type { CodingRule, StaticAnalysisData } from '@/api/types';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { useToggleSet } from '@/ui/toggleSet';
import { groupKey, groupsOf, NO_RULES, onIn, titleKey, withLevel, type Level } from './model';
import { RuleRow } from './RuleRow';
import styles from './StaticAnalysis.module.css';

interface RulesEditorProps {
  rules: readonly CodingRule[];
  chosen: StaticAnalysisData;
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  change: (chosen: StaticAnalysisData) => void;
}

/** All coding rules by group: which are on, how strictly, with which prefixes and limits. */
export function RulesEditor({ rules, chosen, readOnly, change }: RulesEditorProps) {
  const t = useText();
  const [search, setSearch] = useState('');
  const [closed, toggle] = useToggleSet<string>();
  const list = useRef<HTMLDivElement>(null);
  const groups = groupsOf(rules, search, (code) => t(titleKey(code)));
  const shown = groups.flatMap((group) => group.rules);
  const setAll = (level: Level) => {
    const codes = shown.map((rule) => rule.code);
    change(withLevel(chosen, level === 'off' ? codes : codes.filter((code) => !chosen.rules[code]), level));
  };
  return (
    <>
      <div className={styles.bar}>
        <div className={styles.search}>
          <Search size={13} aria-hidden />
          <input
            data-autofocus
            value={search}
            placeholder={t('analysis.search')}
            aria-label={t('analysis.search')}
            spellCheck={false}
            onChange={(event) => {
              setSearch(event.target.value);
              if (list.current) list.current.scrollTop = 0;
            }}
            onKeyDown={(event) => event.key === 'Enter' && event.preventDefault()}
          />
        </div>
        <Button disabledReason={readOnly} onClick={() => setAll('warning')}>
          {t('analysis.allOn')}
        </Button>
        <Button disabledReason={readOnly} onClick={() => setAll('off')}>
          {t('analysis.allOff')}
        </Button>
        <Button disabledReason={readOnly} onClick={() => change(NO_RULES)}>
          {t('analysis.defaults')}
        </Button>
      </div>
      <div className={styles.list} ref={list}>
        {groups.length === 0 && <Empty title={t('tree.nothingFound', { text: search.trim() })} />}
        {groups.map((group) => {
          const open = !closed.has(group.id);
          return (
            <section key={group.id} aria-label={t(groupKey(group.id))}>
              <button
                type="button"
                className={styles.group}
                aria-expanded={open}
                data-open={open ? '' : undefined}
                onClick={() => toggle(group.id)}
              >
                <ChevronRight size={14} strokeWidth={1.75} aria-hidden />
                {t(groupKey(group.id))}
                <span className={styles.muted}>
                  {t('analysis.on', { on: onIn(chosen, group.rules), all: group.rules.length })}
                </span>
              </button>
              {open &&
                group.rules.map((rule) => (
                  <RuleRow key={rule.code} rule={rule} chosen={chosen} readOnly={readOnly !== null} change={change} />
                ))}
            </section>
          );
        })}
      </div>
    </>
  );
}
