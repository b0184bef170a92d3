/** Commands on online values: write, force, release, number formats. */
import { Binary, LockKeyhole, LockKeyholeOpen, PencilLine } from 'lucide-react';
import { NUMBER_FORMATS, setEditorSettings, useEditorSettings, type NumberFormat } from '@/text/settings';
import { contextChanged, menuGroup, registerCommands, type Command, type Enablement } from '@/workbench/commands';
import { connected, live, online, operator, when } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { useOnline } from '@/workbench/onlineSession';
import { forcePrepared, releaseForces, writePrepared } from './acts';
import { clearPrepared, hasOpenField, preparedValues, usePrepared } from './prepared';

const mayOperate = when(online, operator, connected, live);

const hasPrepared = (context: CommandContext): Enablement =>
  context.online !== null && (hasOpenField() || preparedValues(context.online.runtimeId).length > 0)
    ? true
    : 'reason.nothingPrepared';

const hasForces = (context: CommandContext): Enablement =>
  context.online !== null && (useOnline.getState().forces[context.online.runtimeId] ?? []).length > 0
    ? true
    : 'reason.nothingForced';

const onRuntime = (act: (runtimeId: string) => Promise<void> | void) => (context: CommandContext) => {
  if (context.online !== null) return act(context.online.runtimeId);
};

const values: Command[] = [
  ...menuGroup(
    'online',
    '5_values',
    {
      id: 'online.prepareValue',
      title: 'online.prepareValue',
      keys: ['Ctrl+Shift+F7'],
      delegated: true,
      enabled: mayOperate,
    },
    {
      id: 'online.writeValues',
      title: 'online.writeValues',
      icon: PencilLine,
      keys: ['Ctrl+F7'],
      toolbar: { group: '6_values', order: 1 },
      enabled: when(mayOperate, hasPrepared),
      run: onRuntime(writePrepared),
    },
    {
      id: 'online.forceValues',
      title: 'online.forceValues',
      icon: LockKeyhole,
      keys: ['F7'],
      toolbar: { group: '6_values', order: 2 },
      enabled: when(mayOperate, hasPrepared),
      run: onRuntime(forcePrepared),
    },
    {
      id: 'online.unforceAll',
      title: 'online.unforceAll',
      icon: LockKeyholeOpen,
      keys: ['Alt+F7'],
      toolbar: { group: '6_values', order: 3 },
      enabled: when(mayOperate, hasForces),
      run: onRuntime((runtimeId) => releaseForces(runtimeId, null)),
    },
    {
      id: 'online.clearPrepared',
      title: 'online.clearPrepared',
      enabled: hasPrepared,
      run: onRuntime((runtimeId) => clearPrepared(runtimeId)),
    },
  ),
];

const FORMAT_TITLES = {
  dec: 'online.format.dec',
  hex: 'online.format.hex',
  bin: 'online.format.bin',
  sci: 'online.format.sci',
} as const satisfies Record<NumberFormat, string>;

const formats: Command[] = NUMBER_FORMATS.map((format, order) => ({
  id: `online.format.${format}`,
  title: FORMAT_TITLES[format],
  icon: format === 'bin' ? Binary : undefined,
  menu: { menu: 'online', group: '6_format', order, submenu: 'online.format' },
  checked: () => useEditorSettings.getState().numberFormat === format,
  run: () => setEditorSettings({ numberFormat: format }),
}));

export function registerValueCommands(): void {
  registerCommands([...values, ...formats]);
  usePrepared.subscribe(contextChanged);
  useOnline.subscribe((now, before) => {
    if (now.forces !== before.forces) contextChanged();
  });
  useEditorSettings.subscribe((now, before) => {
    if (now.numberFormat !== before.numberFormat) contextChanged();
  });
}
