import { LogIn, Timer } from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import { useActiveSession } from './session';
import { runCommand } from '../run';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { TaskTable } from './TaskTable';

/** The tasks of the active application's runtime. */
export default function TasksPanel() {
  const t = useText();
  const session = useActiveSession();
  const [selected, setSelected] = useState<string | null>(null);
  if (session) return <TaskTable runtimeId={session.runtimeId} selected={selected} onSelected={setSelected} />;
  return (
    <Empty icon={Timer} title={t('tasks.offline')} text={t('tasks.offlineText')}>
      <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
        {t('command.login')}
      </Button>
    </Empty>
  );
}
