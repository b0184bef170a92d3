import { listed, useText } from '@/i18n';
import { SOFT_PLC, SOFT_PLC_EXTERNAL_EVENTS, SOFT_PLC_KINDS } from '@/iec/softPlc';
import { Section } from '@/editors/form/FormPage';
import { Facts } from '@/ui/Facts';

/** What the description of the device permits of tasks, read-only (TASK-04, TASK-07). */
export function TargetSection() {
  const t = useText();
  return (
    <Section title={t('taskConfiguration.target')}>
      <Facts>
        <dt>{t('taskConfiguration.most')}</dt>
        <dd>{t('taskConfiguration.mostText', { count: SOFT_PLC.mostTasks })}</dd>
        <dt>{t('taskConfiguration.priorities')}</dt>
        <dd>{t('taskConfiguration.prioritiesText', SOFT_PLC)}</dd>
        <dt>{t('taskConfiguration.types')}</dt>
        <dd>{listed(SOFT_PLC_KINDS.map((type) => t(`taskType.${type}`)))}</dd>
        <dt>{t('taskConfiguration.externalEvents')}</dt>
        <dd>{listed([...SOFT_PLC_EXTERNAL_EVENTS])}</dd>
      </Facts>
    </Section>
  );
}
