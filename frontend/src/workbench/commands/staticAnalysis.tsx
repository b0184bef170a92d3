import { hasRole } from '@/project/kinds';
import { ListChecks, SlidersHorizontal } from 'lucide-react';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { registerCommands, type Command } from '../commands';
import { application, engineer, idle, when } from '../conditions';
import type { CommandContext } from '../context';
import { openDialog } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import { analyse } from '../online/acts';
import { mayEdit } from '../rights';
import { reasonText } from '../run';
import { storedRules, StaticAnalysisDialog } from '../staticAnalysis/StaticAnalysisDialog';

async function openSettings(context: CommandContext): Promise<boolean> {
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(context.projectId!)) ?? [];
  const allowed = mayEdit(context);
  const saved = await openDialog<boolean>((close) => (
    <StaticAnalysisDialog
      projectId={context.projectId!}
      applications={objects.filter((object) => hasRole(object, 'application'))}
      applicationId={context.applicationId!}
      readOnly={allowed === true ? null : reasonText(allowed)}
      close={close}
    />
  ));
  return saved === true;
}

const commands: Command[] = [
  {
    id: 'build.staticAnalysis',
    title: 'command.staticAnalysis',
    icon: ListChecks,
    menu: { menu: 'build', group: '1_build', order: 2 },
    enabled: when(application, engineer, idle),
    run: async (context) => {
      const chosen = await storedRules(context.projectId!, context.applicationId!);
      if (Object.keys(chosen.rules).length === 0) {
        notify({ tone: 'info', title: t('analysis.none'), text: t('analysis.noneText') });
        if (!(await openSettings(context))) return;
      }
      const report = await analyse(context);
      const found = report?.diagnostics.filter((one) => one.code.startsWith('S')).length;
      if (found !== undefined)
        notify({ tone: found ? 'warn' : 'ok', title: t('analysis.done'), text: t('analysis.found', { count: found }) });
    },
  },
  {
    id: 'project.staticAnalysis',
    title: 'command.staticAnalysisSettings',
    icon: SlidersHorizontal,
    menu: { menu: 'project', group: '3_project', order: 4 },
    enabled: application,
    run: async (context) => {
      await openSettings(context);
    },
  },
];

export function registerStaticAnalysisCommands(): void {
  registerCommands(commands);
}
