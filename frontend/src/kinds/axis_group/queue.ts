/** The information queue of a group as its page shows it (AG-42). Pure functions. */

/** MAX_COMMAND + 1 of the library: the queue is a ring of so many places. */
export const PLACES = 64;
/** What is shown of each command. */
export const MEMBERS = [
  'sInstance',
  'wTypeId',
  'eKind',
  'BufferMode',
  'vStart',
  'vEnd',
  'stPath.fLength',
  'Busy',
  'Active',
] as const;

const BLOCKS: Readonly<Record<number, string>> = {
  0xaaaa: 'MC_MoveLinearAbsolute',
  0xaaab: 'MC_MoveLinearRelative',
  0xaaac: 'MC_MoveCircularAbsolute',
  0xaaad: 'MC_MoveCircularRelative',
  0xaaae: 'MC_MoveDirectAbsolute',
  0xaaaf: 'MC_MoveDirectRelative',
  0xaab0: 'SMC_GroupWait',
};

/** The type of a block by the code in its command (AG-62). */
export function blockName(code: number): string {
  return BLOCKS[code] ?? `16#${code.toString(16).toUpperCase().padStart(4, '0')}`;
}

/** The places of the ring that hold commands, the running one first. */
export function slotsOf(head: number, count: number): number[] {
  const length = Math.min(Math.max(count, 0), PLACES);
  return Array.from({ length }, (_, place) => (head + place) % PLACES);
}

/** What is left of the path of a command: all of it while it waits. */
export function remaining(length: number, position: number, running: boolean): number {
  return running ? Math.max(length - position, 0) : length;
}
