/** System events and task groups: what they are called, and what may be entered. Pure functions. */
import type { ObjectSummary, SystemEventCall, TaskConfigurationData, TaskGroup } from '@/api/types';
import type { TextKey } from '@/i18n';
import { SOFT_PLC } from '@/iec/softPlc';
import { valuesOf } from '@/project/kinds';
import { applicationOf } from '@/project/tree';

export type SystemEventName = SystemEventCall['event'];

/** Every event with the sentence that says when it happens. */
export const EVENT_TEXTS = {
  PrepareStart: 'systemEvent.PrepareStart',
  StartDone: 'systemEvent.StartDone',
  PrepareStop: 'systemEvent.PrepareStop',
  StopDone: 'systemEvent.StopDone',
  PrepareReset: 'systemEvent.PrepareReset',
  ResetDone: 'systemEvent.ResetDone',
  PrepareOnlineChange: 'systemEvent.PrepareOnlineChange',
  OnlineChangeDone: 'systemEvent.OnlineChangeDone',
  PrepareDownload: 'systemEvent.PrepareDownload',
  DownloadDone: 'systemEvent.DownloadDone',
  PrepareExit: 'systemEvent.PrepareExit',
  Exception: 'systemEvent.Exception',
  AfterReadingInputs: 'systemEvent.AfterReadingInputs',
  BeforeWritingOutputs: 'systemEvent.BeforeWritingOutputs',
} as const satisfies Record<SystemEventName, TextKey>;

export const EVENTS = Object.keys(EVENT_TEXTS) as SystemEventName[];

/** The variable that counts how often the function of an event was called. */
export const counterOf = (event: SystemEventName): string => `IoConfig_SystemEvents.udi${event}`;

const IDENTIFIER = /^[A-Za-z_]\w*$/;

/** Whether text can name a function or a group. */
export const isName = (text: string): boolean => IDENTIFIER.test(text);

/** Functions and programs that an event of this application can call: its own and those of the POUs view. */
export function callableAtEvents(objects: readonly ObjectSummary[], configurationId: string): ObjectSummary[] {
  const application = applicationOf(objects, configurationId)?.id;
  return objects
    .filter((object) => object.kind === 'pou' && (object.subkind === 'function' || valuesOf(object) === 'program'))
    .filter((object) => [application, undefined].includes(applicationOf(objects, object.id)?.id))
    .sort((a, b) => a.name.localeCompare(b.name));
}

/** `0, 2` as numbers of processors, each once and in order; null when it is no such list. */
export function processorsFrom(text: string): number[] | null {
  const parts = text.split(/[\s,;]+/).filter((part) => part !== '');
  if (!parts.every((part) => /^\d{1,4}$/.test(part) && Number(part) < SOFT_PLC.processors)) return null;
  return [...new Set(parts.map(Number))].sort((a, b) => a - b);
}

/** A name for a new group that no other has. */
export function freeGroupName(groups: readonly TaskGroup[]): string {
  const taken = new Set(groups.map((group) => group.name.toUpperCase()));
  for (let number = 1; ; number += 1) if (!taken.has(`GROUP${String(number)}`)) return `Group${String(number)}`;
}

/** What is wrong with a group; null for nothing. */
export function groupFault(groups: readonly TaskGroup[], at: number): TextKey | null {
  const name = groups[at]!.name;
  if (!isName(name)) return 'taskGroup.nameFault';
  const same = groups.filter((group) => group.name.toUpperCase() === name.toUpperCase());
  return same.length > 1 ? 'taskGroup.twice' : null;
}

/** Whether the server would take the data. */
export function canStore(data: TaskConfigurationData): boolean {
  return (
    data.system_events.every((call) => isName(call.function)) &&
    data.groups.every((_, at) => groupFault(data.groups, at) === null)
  );
}
