import { useMemo, type RefObject } from 'react';
import { ACTIONS, inEditor, plainTextHandlers } from '@/editors/text/actions';
import { t } from '@/i18n';
import type { TextDocument } from '@/text/documents';
import { panelTable } from '@/text/focus';
import { openDialog } from '@/ui/dialogs';
import { guard, notify } from '@/ui/notices';
import type { Enablement, Handlers } from '@/workbench/commands';
import { saveBlob } from '@/workbench/downloadFile';
import { setDirty } from '@/workbench/selection';
import { CNC_ACTS, type CncActId } from './acts';
import type { CncDocument } from './cncDocument';
import { ArrayDialog, MoveDialog, RotateDialog, StretchDialog } from './dialogs';
import type { LinesEdit } from './edits';
import { ImportDialog } from './ImportDialog';
import { InfoDialog } from './InfoDialog';
import { arrayedProgram } from './operations/array';
import { Refused } from './operations/refusal';
import { renumbered } from './operations/renumber';
import { reversedProgram } from './operations/reverse';
import { splitElement } from './operations/split';
import { movedProgram, rotatedProgram, stretchedProgram } from './operations/transform';
import { saveProperties, startOf, type CncProgramData } from './properties';
import { PropertiesDialog } from './PropertiesDialog';
import { VariablesDialog } from './VariablesDialog';

export interface CncScene {
  projectId: string;
  objectId: string;
  name: string;
  program: CncDocument;
  document: TextDocument;
  /** The chosen block, from 0. */
  line: number;
  data: CncProgramData;
}

/** Carries out an operation on the whole program, or says why it cannot be done. */
function operate({ program }: CncScene, make: (lines: readonly string[]) => readonly LinesEdit[]): void {
  try {
    program.apply(make(program.lines()));
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    const { reason, line, values } = error;
    notify({ tone: 'warn', title: t(`cnc.refused.${reason}`, { line: String(line), letter: '', ...values }) });
  }
}

const RUN: Readonly<Record<CncActId, (scene: CncScene) => Promise<void> | void>> = {
  'cnc.renumber': (scene) => operate(scene, renumbered),
  'cnc.move': async (scene) => {
    const vector = await openDialog<readonly number[]>((close) => <MoveDialog close={close} />);
    if (vector) operate(scene, (lines) => movedProgram(lines, startOf(scene.data), vector, scene.data.velocity));
  },
  'cnc.rotate': async (scene) => {
    const degrees = await openDialog<number>((close) => <RotateDialog close={close} />);
    if (degrees !== undefined) operate(scene, (lines) => rotatedProgram(lines, startOf(scene.data), degrees));
  },
  'cnc.stretch': async (scene) => {
    const order = await openDialog<{ factor: number; distances: boolean }>((close) => <StretchDialog close={close} />);
    if (order) operate(scene, (lines) => stretchedProgram(lines, startOf(scene.data), order.factor, order.distances));
  },
  'cnc.reverse': (scene) => operate(scene, (lines) => reversedProgram(lines, startOf(scene.data), scene.data)),
  'cnc.array': async (scene) => {
    const shape = await openDialog<Parameters<typeof arrayedProgram>[2]>((close) => <ArrayDialog close={close} />);
    if (shape) operate(scene, (lines) => arrayedProgram(lines, startOf(scene.data), shape, scene.data.velocity));
  },
  'cnc.split': (scene) =>
    operate(scene, (lines) => splitElement(lines, startOf(scene.data), Math.min(scene.line, lines.length - 1))),
  'cnc.import': (scene) =>
    void openDialog((close) => (
      <ImportDialog
        take={(text) =>
          scene.program.apply([{ from: 0, removed: scene.program.model.getLineCount(), lines: text.split('\n') }])
        }
        close={close}
      />
    )),
  'cnc.export': ({ program, name }) =>
    saveBlob(new Blob([program.model.getValue()], { type: 'text/plain;charset=utf-8' }), `${name}.cnc`),
  'cnc.suppress': ({ projectId, objectId, data }) =>
    saveProperties(projectId, objectId, { step_suppression: !data.step_suppression }),
  'cnc.variables': ({ projectId, objectId, data, program }) =>
    void openDialog((close) => (
      <VariablesDialog projectId={projectId} objectId={objectId} data={data} lines={program.lines()} close={close} />
    )),
  'cnc.info': ({ projectId, objectId, name, data, program }) => {
    const shown = { ...data, implementation: program.model.getValue() };
    void openDialog((close) => (
      <InfoDialog projectId={projectId} objectId={objectId} name={name} program={shown} close={close} />
    ));
  },
  'cnc.properties': ({ projectId, objectId, name }) =>
    void openDialog((close) => (
      <PropertiesDialog projectId={projectId} objectId={objectId} name={name} close={close} />
    )),
};

/** Of the acts of texts those that read only. */
const IN_TEXT = ['st.quickFix', 'st.suggest', 'st.nextProblem', 'st.previousProblem'] as const;

/** The acts of the program that is shown, as commands find them. */
export function useCncActs(panelId: string, scene: RefObject<CncScene | null>, locked: boolean): Handlers {
  return useMemo(() => {
    const enabled: Enablement = locked ? 'cnc.locked' : true;
    const own = CNC_ACTS.map((act) => [
      act.id,
      {
        run: () => guard(async () => scene.current && (await RUN[act.id](scene.current))),
        enabled: 'reads' in act ? (true as const) : enabled,
      },
    ]);
    const step = (which: 'undo' | 'redo') => ({
      run: () => {
        const table = panelTable(panelId);
        if (table !== null) table[which]();
        else void inEditor(panelId, which).run();
      },
      enabled,
    });
    return {
      ...plainTextHandlers(panelId),
      ...Object.fromEntries(IN_TEXT.map((command) => [command, inEditor(panelId, ACTIONS[command]!)])),
      ...(Object.fromEntries(own) as Handlers),
      'edit.undo': step('undo'),
      'edit.redo': step('redo'),
      'file.save': {
        run: async () => {
          const document = scene.current?.document;
          await document?.save();
          setDirty(panelId, document !== undefined && document.phase !== 'clean');
        },
      },
    };
  }, [panelId, scene, locked]);
}
