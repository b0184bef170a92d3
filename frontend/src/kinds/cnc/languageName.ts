/** Monaco's name of the language of CNC programs. */
export const CNC_TEXT = 'cnc';
