/**
 * Shapes of `/api/v1` under the names that the user interface uses. All of them come from `schema.ts`, which
 * `npm run generate` makes from the server's OpenAPI document.
 */
import type { components } from './schema';

type Schemas = components['schemas'];

export type Role = Schemas['Role'];
export type User = Schemas['Me'];
/** An account, as administrators see it. */
export type Account = Schemas['User'];
export type AuthStatus = Schemas['AuthStatus'];

export type ProjectSummary = Schemas['ProjectSummary'];
export type Revision = Schemas['Revision'];

/** An object in the tree. Its kind may be one that a plug-in of the server brought. */
export type ObjectSummary = Omit<Schemas['ObjectSummary'], 'excluded'> & {
  /** From the build. */
  excluded?: boolean;
};
export type ProjectObject<Data = Record<string, unknown>> = ObjectSummary & { data: Data };
export type BodyLanguage = Schemas['BodyLanguage'];
export type PlacementRule = Schemas['PlacementRule'];

/** Data of every object that is text: pou, method, action, accessor, interface, dut, gvl, persistent. */
export interface TextData {
  declaration: string;
  implementation: string;
  language?: string;
}
export type TaskData = Schemas['TaskData'];
export type TaskType = TaskData['type'];
export type TaskPou = Schemas['ProgramCall'];
export type LibraryParameter = Schemas['LibraryParameterData'];
export type LibraryReference = Omit<
  Schemas['LibraryReferenceData'],
  'placeholder' | 'parameters' | 'qualified_only'
> & {
  qualified_only?: boolean;
  placeholder?: string | null;
  parameters?: LibraryParameter[];
};
export interface LibraryManagerData {
  references: LibraryReference[];
}
export interface ApplicationData {
  static_analysis?: StaticAnalysisData;
}
export type StaticAnalysisData = Required<Schemas['StaticAnalysisData']>;
export type CodingRule = Schemas['CodingRule'];
export type DeviceData = Schemas['DeviceData'];

export type ImportFormats = Schemas['ImportFormats'];
export type ImportNode = Schemas['ImportNode'];
export type ImportEntry = Schemas['Entry'];
export interface ImportReport {
  entries: ImportEntry[];
}
export type ImportPreview = Omit<Schemas['ImportPreview'], 'report'> & { report: ImportReport };
export type ImportResult = Omit<Schemas['ImportResult'], 'report'> & { report: ImportReport };

export type Severity = Schemas['Severity'];
export type Diagnostic = Schemas['Diagnostic'];
export type BuildReport = Schemas['BuildReport'];

export type ImagePlace = Schemas['ImagePlace'];
export type RuntimeState = Schemas['RuntimeState'];
export type RuntimeException = Schemas['RuntimeException'];
export type CallFrame = Schemas['CallFrame'];
export type TaskState = Schemas['TaskState'];
export type LogEntry = Schemas['LogEntry'];
export type LoginRelation = Schemas['Relation'];
export type LoginAnswer = Schemas['LoginReport'];

export type TestReport = Schemas['TestReport'];
export type TestSuite = Schemas['TestSuite'];
export type TestResult = Schemas['TestResult'];
export type TestFailure = Schemas['TestFailure'];

export type LibrarySummary = Schemas['LibrarySummary'];
export type LibraryUse = Schemas['LibraryUse'];
export type LibraryItem = Schemas['LibraryItem'];
export type Library = Schemas['LibraryDetail'];
export type Pin = Schemas['Pin'];
