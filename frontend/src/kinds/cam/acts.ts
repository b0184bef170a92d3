/** What can be done with a whole cam: commands, and entries of the menu in its tool bar. */
export const CAM_ACTS = [
  { id: 'cam.import', needs: ['editing'] },
  { id: 'cam.export', needs: [] },
  { id: 'cam.optimise', needs: ['editing'] },
  { id: 'cam.code', needs: [] },
  { id: 'cam.readRunning', needs: ['application', 'editing'] },
  { id: 'cam.writeRunning', needs: ['application'] },
] as const satisfies readonly { id: string; needs: readonly ('application' | 'editing')[] }[];

export type CamActId = (typeof CAM_ACTS)[number]['id'];
