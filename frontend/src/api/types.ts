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
  | 'library_manager'
  | 'scene';

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
  /** Why there is no connection. */
  problem: string | null;
  url: string;
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

export interface Revision {
  revision: number;
  at: string;
  author: string;
  comment: string;
  object_id: string | null;
  object_name: string | null;
  /** created, updated, moved, deleted. */
  change: string | null;
}

export interface TaskState {
  name: string;
  kind: string | null;
  priority: number | null;
  status: string | null;
  interval_us: number | null;
  cycles: number;
  last_us: number | null;
  mean_us: number | null;
  min_us: number | null;
  max_us: number | null;
  jitter_us: number | null;
  min_jitter_us: number | null;
  max_jitter_us: number | null;
  overruns: number | null;
}

export interface LogEntry {
  id: number;
  at: string;
  severity: string;
  component: string;
  message: string;
}

export interface LibrarySummary {
  name: string;
  version: string;
  namespace: string;
  company: string;
  title: string;
  description: string;
  item_count: number;
}

export interface Pin {
  name: string;
  type: string;
  default: string | null;
  comment: string;
}

export interface LibraryItem {
  name: string;
  kind: string;
  comment: string;
  inputs: Pin[];
  outputs: Pin[];
  in_out: Pin[];
  members: Pin[];
  values: Record<string, unknown>[];
  returns: string | null;
  methods?: LibraryItem[];
}

export interface Library extends LibrarySummary {
  items: LibraryItem[];
}

/** An account, as administrators see it. */
export interface Account {
  id: string;
  username: string;
  role: Role;
  disabled: boolean;
  has_password: boolean;
  created_at: string;
  last_login_at: string | null;
}
