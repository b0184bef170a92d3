import type { Part } from './partUri';

/** Where in an object something is; lines and columns start at 1. */
export interface Place {
  objectId: string;
  part?: Part;
  line?: number;
  column?: number;
  endLine?: number;
  endColumn?: number;
}
