/** What can be done with a trace (TRC-05): commands, buttons of the tool bar, entries of its menus. */
import {
  ArrowLeft,
  ArrowRight,
  Camera,
  ChevronsLeftRight,
  ChevronsRightLeft,
  CirclePlay,
  CircleStop,
  Disc,
  Download,
  FileDown,
  FileUp,
  Hand,
  Maximize2,
  Plus,
  RotateCcw,
  Rows3,
  Settings2,
  SquareDashed,
  Trash2,
  Upload,
  ZoomIn,
} from 'lucide-react';
import type { IconComponent } from '@/icons/IconComponent';

/** What an act needs; the reasons of what is missing are said in this order. */
export type Need =
  /** May change the project. */
  | 'editing'
  /** May change how it looks, which of a stored recording everybody may. */
  | 'display'
  /** A recorded variable is selected. */
  | 'variable'
  /** There is a record. */
  | 'configured'
  | 'selected'
  | 'online'
  | 'operator'
  /** The controller has the trace. */
  | 'downloaded'
  | 'recording'
  | 'stopped'
  /** Something is shown that has samples. */
  | 'shown'
  | 'before'
  | 'after'
  | 'cursors';

interface Act {
  id: string;
  icon?: IconComponent;
  needs: readonly Need[];
}

/** In groups, as menus show them. */
export const ACT_GROUPS = [
  [
    { id: 'trace.addVariable', icon: Plus, needs: ['editing'] },
    { id: 'trace.addRecord', needs: ['editing'] },
    { id: 'trace.axisTemplate', needs: ['editing'] },
    { id: 'trace.delete', icon: Trash2, needs: ['editing', 'selected'] },
    { id: 'trace.visible', needs: ['display', 'selected'] },
    { id: 'trace.derivative', needs: ['variable'] },
    { id: 'trace.integral', needs: ['variable'] },
    { id: 'trace.appearance', needs: ['configured'] },
    { id: 'trace.configuration', icon: Settings2, needs: [] },
  ],
  [
    { id: 'trace.download', icon: Download, needs: ['online', 'operator', 'configured'] },
    { id: 'trace.start', icon: CirclePlay, needs: ['online', 'operator', 'downloaded', 'stopped'] },
    { id: 'trace.stop', icon: CircleStop, needs: ['online', 'operator', 'downloaded', 'recording'] },
    { id: 'trace.resetTrigger', icon: RotateCcw, needs: ['online', 'operator', 'downloaded'] },
    { id: 'trace.onlineList', needs: ['online'] },
    { id: 'trace.upload', icon: Upload, needs: ['online', 'editing', 'downloaded'] },
  ],
  [
    { id: 'trace.snapshot', icon: Camera, needs: ['online', 'operator', 'downloaded'] },
    { id: 'trace.longTerm', icon: Disc, needs: ['online', 'operator', 'downloaded'] },
    { id: 'trace.save', icon: FileDown, needs: ['shown'] },
    { id: 'trace.load', icon: FileUp, needs: ['operator'] },
    { id: 'trace.export', needs: ['shown'] },
    { id: 'trace.picture', needs: ['configured'] },
  ],
  [
    { id: 'trace.cursor', icon: SquareDashed, needs: ['configured'] },
    { id: 'trace.mouseScroll', icon: Hand, needs: [] },
    { id: 'trace.mouseZoom', icon: ZoomIn, needs: [] },
    { id: 'trace.resetView', icon: Maximize2, needs: [] },
    { id: 'trace.zoomToCursors', needs: ['cursors'] },
    { id: 'trace.viewBack', icon: ArrowLeft, needs: ['before'] },
    { id: 'trace.viewForward', icon: ArrowRight, needs: ['after'] },
    { id: 'trace.compress', icon: ChevronsRightLeft, needs: ['configured'] },
    { id: 'trace.stretch', icon: ChevronsLeftRight, needs: ['configured'] },
    { id: 'trace.multiChannel', icon: Rows3, needs: ['configured'] },
  ],
] as const satisfies readonly (readonly Act[])[];

export type TraceActId = (typeof ACT_GROUPS)[number][number]['id'];
export const TRACE_ACTS: readonly (Act & { id: TraceActId })[] = ACT_GROUPS.flat();
