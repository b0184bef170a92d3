/** What can be done with a whole cam: commands, and entries of the menu in its tool bar. */
export const CAM_ACTS = [
  { id: 'cam.import', menu: 'cam.menu', needs: 'editing' },
  { id: 'cam.export', menu: 'cam.menu', needs: null },
  { id: 'cam.optimise', menu: 'cam.menu', needs: 'editing' },
  { id: 'cam.code', menu: 'cam.menu', needs: null },
  { id: 'cam.readRunning', menu: 'cam.menu', needs: 'application' },
  { id: 'cam.writeRunning', menu: 'cam.menu', needs: 'application' },
] as const;

export type CamActId = (typeof CAM_ACTS)[number]['id'];
