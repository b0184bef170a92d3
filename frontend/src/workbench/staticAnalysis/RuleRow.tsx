import type { CodingRule, StaticAnalysisData } from '@/api/types';
import { useText } from '@/i18n';
import { Select, TextInput } from '@/ui/Field';
import { isPrefix, LEVELS, levelOf, limitKey, messageText, titleKey, withLevel, withLimit, withPrefix } from './model';
import styles from './StaticAnalysis.module.css';

interface RuleRowProps {
  rule: CodingRule;
  chosen: StaticAnalysisData;
  readOnly: boolean;
  change: (chosen: StaticAnalysisData) => void;
}

/** One coding rule: how strictly it is checked, and, while it is on, the prefixes and limits it looks at. */
export function RuleRow({ rule, chosen, readOnly, change }: RuleRowProps) {
  const t = useText();
  const level = levelOf(chosen, rule.code);
  const title = t(titleKey(rule.code));
  const adjustable = Object.keys(rule.prefixes).length + Object.keys(rule.limits).length > 0;
  return (
    <div className={styles.rule} data-level={level} role="group" aria-label={`${rule.code} ${title}`}>
      <div className={styles.code}>
        {rule.code}
        {rule.numbers.map((number) => (
          <div key={number} className={styles.muted} title={t('analysis.number', { number })}>
            {number}
          </div>
        ))}
      </div>
      <div className={styles.text}>
        <div>{title}</div>
        <div className={styles.muted}>
          {t('analysis.ruleText', { message: messageText(rule.message), advice: messageText(rule.advice) })}
        </div>
        {level !== 'off' && adjustable && (
          <div className={styles.settings}>
            {Object.entries(rule.prefixes).map(([key, usual]) => (
              <label key={key} className={styles.setting}>
                <span className="code">{key}</span>
                <TextInput
                  className={`code ${styles.prefix}`}
                  value={chosen.prefixes[key] ?? usual}
                  disabled={readOnly}
                  aria-invalid={isPrefix(chosen.prefixes[key] ?? usual) ? undefined : true}
                  onValue={(value) => change(withPrefix(chosen, key, value, usual))}
                />
              </label>
            ))}
            {Object.entries(rule.limits).map(([key, usual]) => (
              <label key={key} className={styles.setting}>
                {t(limitKey(key))}
                <TextInput
                  className={styles.limit}
                  type="number"
                  min={0}
                  max={1_000_000}
                  value={chosen.limits[key] ?? usual}
                  disabled={readOnly}
                  onValue={(value) => {
                    const number = Number(value);
                    if (Number.isInteger(number) && number >= 0 && number <= 1_000_000)
                      change(withLimit(chosen, key, number, usual));
                  }}
                />
              </label>
            ))}
          </div>
        )}
      </div>
      <Select
        compact
        className={styles.level}
        label={t('analysis.levelOf', { code: rule.code })}
        value={level}
        disabled={readOnly}
        choices={LEVELS.map((value) => ({ value, text: t(`analysis.level.${value}`) }))}
        onValue={(value) => change(withLevel(chosen, [rule.code], value))}
      />
    </div>
  );
}
