import { CloudUpload, GitCompareArrows, LogIn, Zap } from 'lucide-react';
import { useText } from '@/i18n';
import { useProject } from '@/project/openProject';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { runCommand } from '../run';
import { ChangesTable } from './ChangesTable';
import { useKnownRelation } from './knownRelation';
import styles from './ChangesPanel.module.css';

/** What loading the present application would do to the one that runs, before and after a login. */
export default function ChangesPanel() {
  const t = useText();
  const applicationId = useProject((state) => state.applicationId);
  const known = useKnownRelation((state) => (applicationId ? state.known[applicationId] : undefined));
  if (!known)
    return (
      <Empty icon={Zap} title={t('changes.unknown')} text={t('changes.unknownText')}>
        <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
          {t('command.login')}
        </Button>
      </Empty>
    );
  const { answer } = known;
  const { relation } = answer;
  const compare = (
    <Button icon={GitCompareArrows} onClick={() => void runCommand('online.compareRunning')}>
      {t('command.compareRunning')}
    </Button>
  );
  return (
    <Panel>
      <PanelBar>
        {relation === 'online_change' ? <Zap size={14} aria-hidden /> : <CloudUpload size={14} aria-hidden />}
        <span>{t(`relation.${relation}`)}</span>
        <span className={styles.acts}>
          {relation !== 'same' && relation !== 'empty' && relation !== 'foreign' && compare}
        </span>
      </PanelBar>
      <PanelRest>
        {answer.changes.length > 0 ? (
          <div className={styles.table}>
            <ChangesTable answer={answer} />
          </div>
        ) : relation === 'same' ? (
          <Empty icon={Zap} title={t('changes.none')} />
        ) : (
          <ul className={styles.reasons}>
            {answer.reasons.map((reason) => (
              <li key={reason}>{reason}</li>
            ))}
          </ul>
        )}
      </PanelRest>
    </Panel>
  );
}
