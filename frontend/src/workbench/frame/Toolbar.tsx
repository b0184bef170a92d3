import { hasRole } from '@/project/kinds';
import { RotateCcw } from 'lucide-react';
import { Fragment, useMemo } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { kindWithRole } from '@/project/kinds';
import { useRegistry, type Command } from '../commands';
import { commandContext, type CommandContext } from '../context';
import { useCommandContext } from '../useCommandContext';
import { keysText } from '../keys';
import { setActiveApplication, useProject } from '@/project/openProject';
import { refusal, runCommand, titleOf } from '../run';
import { lineage, objectPath } from '@/project/tree';
import { Button, IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { DropdownMenu } from '@/ui/Menu';
import { entriesOf } from './menuEntries';
import { toolbarOf } from './menuModel';
import styles from './Toolbar.module.css';

export function Toolbar() {
  const t = useText();
  const context = useCommandContext();
  const commands = useRegistry((state) => state.commands);
  const groups = toolbarOf(commands.values(), context);
  return (
    <div className={styles.toolbar} role="toolbar" aria-label={t('toolbar.label')}>
      <ApplicationSelect />
      {groups.map((group) => (
        <Fragment key={group[0]!.id}>
          <span className={styles.divider} aria-hidden />
          {group.map((command) => (
            <ToolbarButton key={command.id} command={command} context={context} />
          ))}
          {group.some((command) => command.id === 'debug.stop') && <ResetMenu context={context} />}
        </Fragment>
      ))}
    </div>
  );
}

const TONES: Record<string, string> = { 'debug.start': 'var(--ok)', 'debug.stop': 'var(--error)' };

function ToolbarButton({ command, context }: { command: Command; context: CommandContext }) {
  const Icon = command.icon;
  if (!Icon) return null;
  const keys = command.keys?.[0];
  const reason = refusal(command, context);
  const run = () => void runCommand(command.id);
  if (command.toolbar?.label) {
    return (
      <Button variant="quiet" className={styles.labelled} icon={Icon} disabledReason={reason} onClick={run}>
        {titleOf(command)}
      </Button>
    );
  }
  return (
    <IconButton
      icon={Icon}
      label={titleOf(command)}
      shortcut={keys && keysText(keys)}
      pressed={command.checked?.(context)}
      disabledReason={reason}
      tone={TONES[command.id]}
      onClick={run}
    />
  );
}

const RESETS = ['online.reset.warm', 'online.reset.cold', 'online.reset.origin'];

/** The three resets under one button. */
function ResetMenu({ context }: { context: CommandContext }) {
  const t = useText();
  const commands = useRegistry((state) => state.commands);
  const first = commands.get(RESETS[0]!);
  if (!first) return null;
  const reason = refusal(first, context);
  const button = <IconButton icon={RotateCcw} label={t('toolbar.reset')} disabledReason={reason} />;
  if (reason) return button;
  return <DropdownMenu entries={() => entriesOf(RESETS, commands, commandContext())} trigger={button} />;
}

/** The active application; its device stands before its name where there are several. */
function ApplicationSelect() {
  const t = useText();
  const { projectId, applicationId } = useProject();
  const { data: objects } = useObjects(projectId);
  const choices = useMemo(() => {
    const applications = (objects ?? []).filter((object) => hasRole(object, 'application'));
    const devices = new Set(applications.map((object) => lineage(objects!, object.id).at(-1)?.id));
    return applications.map((object) => ({
      value: object.id,
      text: devices.size > 1 ? objectPath(objects!, object.id) : object.name,
      icon: kindWithRole('application')?.icon,
    }));
  }, [objects]);
  return (
    <Select
      className={styles.application}
      label={t('toolbar.application')}
      placeholder={t('toolbar.noApplication')}
      value={applicationId}
      choices={choices}
      onValue={setActiveApplication}
      disabled={choices.length === 0}
    />
  );
}
