/** What can be done with a CNC program: commands, and entries of the menu in its tool bar (cnc.md section 6). */
export const CNC_ACTS = [
  { id: 'cnc.renumber', group: 1 },
  { id: 'cnc.move', group: 1 },
  { id: 'cnc.rotate', group: 1 },
  { id: 'cnc.stretch', group: 1 },
  { id: 'cnc.reverse', group: 1 },
  { id: 'cnc.array', group: 1 },
  { id: 'cnc.split', group: 1 },
  { id: 'cnc.import', group: 2 },
  { id: 'cnc.export', group: 2, reads: true },
  { id: 'cnc.suppress', group: 3 },
  { id: 'cnc.variables', group: 3 },
  { id: 'cnc.info', group: 3, reads: true },
  { id: 'cnc.properties', group: 3 },
] as const satisfies readonly { id: string; group: number; reads?: true }[];

export type CncActId = (typeof CNC_ACTS)[number]['id'];
