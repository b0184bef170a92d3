import { useText } from '@/i18n';
import styles from '@/editors/form/Form.module.css';
import { USUAL } from './model';
import { PageSetupForm } from './PageSetupForm';

/** What holds in a project without a page setup, for those who cannot make one. */
export default function UsualPageSetup({ readOnly }: { readOnly: string }) {
  const t = useText();
  return (
    <>
      <div className={styles.banner}>{t('pageSetup.usual', { reason: readOnly })}</div>
      <PageSetupForm setup={USUAL} disabled onChange={() => undefined} />
    </>
  );
}
