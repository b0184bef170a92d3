/**
 * Shapes of `/api/v1` that are used in several places; others are `Schemas['...']` where they are used. All of them
 * come from `schema.ts`, which `npm run generate` makes from the server's OpenAPI document.
 */
import type { components } from './schema';

export type Schemas = components['schemas'];

export type Role = Schemas['Role'];
export type User = Schemas['Me'];
/** An account, as administrators see it. */
export type Account = Schemas['User'];

export type ProjectSummary = Schemas['ProjectSummary'];
/** A project that a new one can begin with. */
export type Example = Schemas['Example'];
export type Revision = Schemas['Revision'];

/** An object in the tree. Its kind may be one that a plug-in of the server brought. */
export type ObjectSummary = Schemas['ObjectSummary'];
/** An object with its data, whose shape depends on the kind. */
export type ProjectObject = Schemas['ObjectDetail'];
/** An object whose data have a known shape. */
export type ObjectOf<Data extends ProjectObject['data']> = ObjectSummary & { data: Data };
/** The data of objects by kind, of the kinds that the server describes; others come with plug-ins. */
export type DataOfKind = {
  [One in ProjectObject as string extends One['kind'] ? never : One['kind']]: One['data'];
};
export type PlacementRule = Schemas['PlacementRule'];

export type TaskData = Schemas['TaskData'];
export type TaskPou = Schemas['ProgramCall'];
export type TaskConfigurationData = Schemas['TaskConfigurationData'];
export type TaskGroup = Schemas['TaskGroup'];
export type SystemEventCall = Schemas['SystemEventCall'];
export type LibraryParameter = Schemas['LibraryParameterData'];
export type LibraryReference = Schemas['LibraryReferenceData'];
export type StaticAnalysisData = Schemas['StaticAnalysisData'];
export type CodingRule = Schemas['CodingRule'];
export type CompilerWarning = Schemas['CompilerWarning'];

export type ImportFormats = Schemas['ImportFormats'];
export type ImportNode = Schemas['ImportNode'];
export type ImportEntry = Schemas['Entry'];

export type Severity = Schemas['Severity'];
export type Diagnostic = Schemas['Diagnostic'];
export type BuildReport = Schemas['BuildReport'];

export type ImagePlace = Schemas['ImagePlace'];
export type RuntimeState = Schemas['RuntimeState'];
export type RuntimeException = Schemas['RuntimeException'];
export type CallFrame = Schemas['CallFrame'];
export type TaskState = Schemas['TaskState'];
export type TaskTimes = Schemas['TaskTimes'];
export type LoadOfTasks = Schemas['LoadOfTasks'];
export type DebugState = Schemas['DebugState'];
export type Breakpoint = Schemas['Breakpoint'];
export type BreakpointOrder = Schemas['BreakpointOrder'];
export type FlowSnapshot = Schemas['FlowSnapshot'];
export type FlowStatement = Schemas['FlowStatement'];
export type CodeSpot = Schemas['CodeSpot'];
export type Halt = Schemas['Halt'];
export type StackFrame = Schemas['Frame'];
export type FrameVariable = Schemas['Variable'];
export type LogEntry = Schemas['LogEntry'];
export type LoginRelation = Schemas['Relation'];
export type LoginAnswer = Schemas['LoginReport'];
/** One that was brought into a controller. */
export type RuntimeVersion = Schemas['Version'];

export type TestReport = Schemas['TestReport'];
export type TestRun = Schemas['TestRun'];
export type TestSuite = Schemas['TestSuite'];
export type TestFailure = Schemas['TestFailure'];

export type LibrarySummary = Schemas['LibrarySummary'];
export type LibraryItem = Schemas['LibraryItem'];
export type Library = Schemas['LibraryDetail'];
export type Pin = Schemas['Pin'];
