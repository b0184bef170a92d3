import { LogIn } from 'lucide-react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { runCommand } from '@/workbench/run';

/** Stands where values would be. */
export function NotLoggedIn({ text }: { text: string }) {
  const t = useText();
  return (
    <Empty icon={LogIn} title={t('axis.loggedOut')} text={text}>
      <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
        {t('command.login')}
      </Button>
    </Empty>
  );
}
