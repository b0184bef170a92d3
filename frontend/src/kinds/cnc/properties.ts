/** The properties of a CNC program (cnc.md CNC-10 to CNC-17), and how they are stored beside its text. */
import { ofKind, shaped } from '@/api/objects';
import { keys, objectQuery, queryClient, saveObject, StaleObject } from '@/api/queries';
import type { DataOfKind } from '@/api/types';
import type { Conditions } from './checks';
import { AXES } from './gcodes';
import type { Position } from './state';

export type CncProgramData = DataOfKind['cnc'];
export type CncPropertyData = Omit<CncProgramData, 'implementation'>;

export const GREATEST_RATE = 1e9;
export const FARTHEST = 1e12;
export const LEAST_QUEUE = 5;
export const MOST_QUEUE = 65_535;
export const COMPILE_MODES = [
  'cnc_ref',
  'out_queue',
  'file',
] as const satisfies readonly CncProgramData['compile_mode'][];
export const VIEWS = ['text', 'table'] as const satisfies readonly CncProgramData['view'][];

export function conditionsOf({ velocity, compile_mode, step_suppression }: CncProgramData): Conditions {
  return { velocity, ready: compile_mode === 'out_queue', suppress: step_suppression };
}

export function startOf({ start }: Pick<CncProgramData, 'start'>): Position {
  return [...AXES.toLowerCase()].map((axis) => start[axis as keyof typeof start]);
}

export function withStart(start: CncProgramData['start'], axis: string, value: number): CncProgramData['start'] {
  return { ...start, [axis.toLowerCase()]: value };
}

const isProgram = ofKind('cnc');

/** Stores other properties; the text is as it is stored by now, and one that is being typed stays where it is. */
export async function saveProperties(
  projectId: string,
  objectId: string,
  change: Partial<CncPropertyData>,
): Promise<void> {
  for (let attempt = 0; ; attempt++) {
    const object = shaped(await queryClient.fetchQuery(objectQuery(projectId, objectId)), isProgram);
    try {
      await saveObject(projectId, objectId, object.revision, { ...object.data, ...change });
      return;
    } catch (error) {
      // The text was stored meanwhile: properties are other fields, so they go on top of it.
      if (!(error instanceof StaleObject) || attempt > 0) throw error;
      await queryClient.invalidateQueries({ queryKey: keys.object(projectId, objectId) });
    }
  }
}
