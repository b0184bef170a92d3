import { CircleStop, Eraser, FileCode, Play } from 'lucide-react';
import { useEffect, useRef } from 'react';
import { useText } from '@/i18n';
import { useProject } from '@/project/openProject';
import { IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { guard } from '@/ui/notices';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { openObject } from '@/workbench/docking/dock';
import { clearOutput, runScript, stopScript, useScriptRun } from './runner';
import styles from './Scripts.module.css';

/** What the script that ran last has written. An error leads to its line. */
export default function ScriptsPanel() {
  const t = useText();
  const projectId = useProject((state) => state.projectId);
  const last = useScriptRun((state) => state.run);
  const run = last?.projectId === projectId ? last : null;
  const running = run?.state === 'running';
  const end = useRef<HTMLDivElement>(null);
  useEffect(() => {
    end.current?.scrollIntoView({ block: 'nearest' });
  }, [run?.lines]);

  return (
    <Panel>
      <PanelBar>
        <IconButton
          small
          icon={CircleStop}
          label={t('scripts.stop')}
          disabledReason={running ? null : t('scripts.notRunning')}
          onClick={stopScript}
        />
        <IconButton
          small
          icon={Play}
          label={t('scripts.runAgain')}
          disabledReason={run === null ? t('scripts.noneRan') : running ? t('scripts.runs') : null}
          onClick={() => run && void guard(() => runScript(run.projectId, run.objectId))}
        />
        <IconButton
          small
          icon={Eraser}
          label={t('scripts.clear')}
          disabledReason={run === null ? t('scripts.noneRan') : null}
          onClick={clearOutput}
        />
        {run && <span className={styles.name}>{run.name}</span>}
        <span className={styles.state} data-state={run?.state} role="status">
          {run && t(`scripts.state.${run.state}`)}
        </span>
      </PanelBar>
      <PanelRest tabIndex={run ? 0 : undefined}>
        {run === null ? (
          <Empty icon={FileCode} title={t('scripts.noneRan')} text={t('scripts.start')} />
        ) : (
          <div className={styles.output} role="log" aria-label={t('scripts.output')}>
            {run.lines.map(({ serial, tone, text, at }) => (
              <div key={serial} className={styles.line} data-tone={tone}>
                {at === undefined ? (
                  text
                ) : (
                  <button
                    type="button"
                    className={styles.place}
                    onClick={() => openObject(run.objectId, run.name, { place: { line: at } })}
                  >
                    {text}
                  </button>
                )}
              </div>
            ))}
            <div ref={end} />
          </div>
        )}
      </PanelRest>
    </Panel>
  );
}
