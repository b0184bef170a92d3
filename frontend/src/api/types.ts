/** Shapes of `/api/v1` (REST), in the names of the user interface. */

export type Role = 'viewer' | 'operator' | 'engineer' | 'admin';

export interface User {
  id: string;
  username: string;
  role: Role;
  language: string | null;
  theme: string | null;
}

export interface AuthStatus {
  first_account_needed: boolean;
  authenticated: boolean;
  user: User | null;
}

export interface ProjectSummary {
  id: string;
  name: string;
  description: string;
  created: string;
  modified: string;
}

export type ObjectKind =
  | 'folder'
  | 'device'
  | 'plc_logic'
  | 'application'
  | 'pou'
  | 'method'
  | 'action'
  | 'property'
  | 'accessor'
  | 'interface'
  | 'dut'
  | 'gvl'
  | 'persistent'
  | 'task_configuration'
  | 'task'
  | 'library_manager';

export interface ObjectSummary {
  id: string;
  parent_id: string | null;
  kind: ObjectKind;
  /** program, function, function_block, struct, enum, alias, union ...; null where the kind says all. */
  subkind: string | null;
  name: string;
  /** Order among the siblings. */
  index: number;
  revision: number;
  badges: string[];
}

export interface ProjectObject<Data = Record<string, unknown>> extends ObjectSummary {
  data: Data;
}

/** Data of every object that is text: pou, method, action, accessor, interface, dut, gvl, persistent. */
export interface TextData {
  declaration: string;
  implementation: string;
  language?: string;
}

export interface TaskPou {
  name: string;
  comment: string;
}

export interface Watchdog {
  enabled: boolean;
  time: string;
  sensitivity: number;
}

export type TaskType = 'cyclic' | 'freewheeling' | 'event' | 'status' | 'external';

export interface TaskData {
  priority: number;
  type: TaskType;
  interval: string;
  event: string;
  watchdog: Watchdog;
  pous: TaskPou[];
}

export interface LibraryReference {
  name: string;
  version: string;
  namespace: string;
}

export interface LibraryManagerData {
  references: LibraryReference[];
}

export interface DeviceData {
  device_type: string;
  runtime_id: string | null;
  simulated: boolean;
  description: string;
}

export type Severity = 'error' | 'warning' | 'info';

export interface Diagnostic {
  code: string;
  severity: Severity;
  message: string;
  advice: string | null;
  object_id: string | null;
  object_path: string;
  part: 'declaration' | 'implementation' | null;
  line: number | null;
  column: number | null;
  end_line: number | null;
  end_column: number | null;
}

export interface BuildReport {
  ok: boolean;
  diagnostics: Diagnostic[];
  code_id: string | null;
  data_id: string | null;
  code_size: number | null;
  data_size: number | null;
  seconds: number;
}

export type RuntimeActivity = 'empty' | 'stop' | 'run' | 'exception';

export interface RuntimeState {
  id: string;
  name: string;
  connected: boolean;
  since: string | null;
  state: RuntimeActivity | null;
  application: string | null;
  code_id: string | null;
  data_id: string | null;
  exception: RuntimeException | null;
  scheduling: string | null;
}

export interface RuntimeException {
  code: number | string;
  message: string;
  task: string;
  pou: string | null;
  line: number | null;
}

export type LoginRelation = 'same' | 'online_change' | 'download' | 'foreign' | 'empty';

export interface LoginAnswer {
  relation: LoginRelation;
  reasons: string[];
}
