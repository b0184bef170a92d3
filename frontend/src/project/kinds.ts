/**
 * Kinds of objects: one descriptor each, the twin of the server's `ObjectKind`.
 *
 * A folder `src/kinds/<kind>` exports its descriptor from `index.tsx`; `kinds/register.ts` finds the folders by their
 * place and registers them here. Nothing else names kinds: the tree, the dialogs and the editors ask `kindOf`. The texts of a kind
 * stand beside it in `en.json` and `zh.json` under fixed keys: `kind.<kind>`, `about.<kind>`, `subkind.<subkind>`.
 * A kind without a folder (a plug-in brought it) has a neutral icon, its own name as title, and a read-only view of its data.
 */
import type { ComponentType } from 'react';
import type { Check } from '@/api/objects';
import type { ObjectOf, ObjectSummary, ProjectObject, Schemas } from '@/api/types';
import { textOf, type TextKey } from '@/i18n';
import type { ACCESS_SPECIFIERS } from '@/iec/grammar';
import type { IconComponent } from '@/icons/IconComponent';
import { NeutralIcon } from '@/icons/shape';
import type { EditorProps } from './editorProps';
import type { Part } from './partUri';

/** What an object is to the workbench itself, whatever its kind is called. */
export type Role =
  /** How the documentation of the project is printed. */
  | 'page-setup'
  /** Built, downloaded and logged in to; the commands act on the active one. */
  | 'application'
  /** Carries applications; the roots of the Devices view. */
  | 'device'
  /** Groups objects and means nothing to the program: what is in it belongs to the owner of the folder. */
  | 'folder'
  /** References the libraries that an application sees. */
  | 'libraries'
  /** Run from the Tools menu. */
  | 'script';

/** Where the variables that an object declares have their values in a running application. */
export type ValuePlace =
  /** Under the name of the object. */
  | 'global'
  /** Under the name of the object, a program. */
  | 'program'
  /** In each instance of the object, a function block. */
  | 'instance'
  /** On the stack while the object, or what it belongs to, is called. */
  | 'call'
  /** It has none of its own and uses those of the object it belongs to. */
  | 'owner';

/** One field that Add Object shows besides the name; `access` is a choice, the others are typed. */
export type AddOption = 'extends' | 'implements' | 'returns' | 'access' | 'base';
export type Access = (typeof ACCESS_SPECIFIERS)[number];
export type AddValues = Partial<Record<Exclude<AddOption, 'access'>, string> & { access: Access }>;

export interface NewDeclaration {
  subkind: string | undefined;
  name: string;
  /** Trimmed; what was left empty is not there. */
  values: AddValues;
}

export interface Subkind {
  icon?: IconComponent;
  /** As the field abbreviates it, behind the name in the tree: PRG, FB. */
  short?: string;
}

export type ContentGroup = 'programs' | 'blocks' | 'functions' | 'types' | 'lists' | 'tasks';

export interface SettingsProps {
  /** With the changes made in the dialog. */
  object: ProjectObject;
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  change: (data: ProjectObject['data']) => void;
}

/** A page of the project settings. */
export interface SettingsPage {
  title: TextKey;
  component: ComponentType<SettingsProps>;
  /** Whether the server would take the data; true where the page lets nothing else be chosen. */
  canStore?: (object: ProjectObject) => boolean;
}

export interface ObjectKindDescriptor {
  kind: string;
  icon: IconComponent;
  /** Icon of one object where it depends on more than kind and subkind. */
  iconOf?: (name: string) => IconComponent;
  subkinds?: Readonly<Record<string, Subkind>>;
  /** What it does in the controller, behind its name in the tree. */
  state?: ComponentType<{ projectId: string; object: ObjectSummary }>;
  /** Opens in a tab; without one a double click opens or closes the row in the tree. */
  editor?: ComponentType<EditorProps>;
  /** Shows what holds in a project without an object of the kind; `readOnly` says why none can be made. */
  usual?: ComponentType<{ readOnly: string }>;
  /** Shown in the properties of an object, below what all objects have. */
  properties?: ComponentType<{ projectId: string; objectId: string }>;
  /** Pages of the project settings, for each object of the kind. */
  settings?: readonly SettingsPage[];
  role?: Role;
  /** Texts of the object, top to bottom; absent where it is no text. */
  parts?: readonly Part[];
  /** Monaco's language of its text, where that is no IEC text. */
  textLanguage?: string;
  /** The compiler gets it, so it can be excluded from the build. */
  compiled?: boolean;
  tree?: {
    /** Open when the project is opened for the first time. */
    openAtFirst?: boolean;
    /** The name that the system gives and stores; it is shown in the language of the user. */
    fixedName?: string;
    /** Not part of a path as an engineer writes it: `Device.Application.PLC_PRG`. */
    outsidePaths?: boolean;
  };
  add?: {
    /** Chosen when Add Object opens. */
    first?: boolean;
    /** The server creates further objects below it. */
    bringsChildren?: boolean;
    optionsOf?: (subkind: string | undefined) => readonly AddOption[];
    /** The declaration with options, null where the text of the server will do. */
    declarationOf?: (order: NewDeclaration) => string | null;
  };
  online?: {
    /** Where values are; undefined where objects of this subkind have none. */
    valuesOf?: (subkind: string | null) => ValuePlace | undefined;
  };
  /** Under what the overview of an application counts it. */
  countedAs?: (subkind: string | null) => ContentGroup | undefined;
  /** Section of the variables that Auto Declare writes into an object of this kind. */
  declares?: string;
  /** Where the input assistant lists objects of this kind. */
  catalog?: 'pous' | 'types';
}

const kinds = new Map<string, ObjectKindDescriptor>();

export function registerKind(descriptor: ObjectKindDescriptor): () => void {
  kinds.set(descriptor.kind, descriptor);
  return () => kinds.delete(descriptor.kind);
}

export function allKinds(): readonly ObjectKindDescriptor[] {
  return [...kinds.values()];
}

/** Undefined for a kind that has no folder here. */
export function kindOf(kind: string): ObjectKindDescriptor | undefined {
  return kinds.get(kind);
}

type Kinded = Pick<ObjectSummary, 'kind'>;

/** The data of objects of a role, as the server describes them. */
interface DataOfRole {
  application: Schemas['ApplicationData'];
  device: Schemas['DeviceData'];
  folder: Schemas['NoData'];
  libraries: Schemas['LibraryManagerData'];
  'page-setup': Schemas['PageSetupData'];
  script: Schemas['ScriptData'];
}

/** Whether an object has the data of a role. */
export function ofRole<Named extends Role>(role: Named): Check<DataOfRole[Named]> {
  return (object): object is ObjectOf<DataOfRole[Named]> => hasRole(object, role);
}

export function hasRole(object: Kinded | undefined, role: Role): boolean {
  return object !== undefined && kindOf(object.kind)?.role === role;
}

export function kindWithRole(role: Role): ObjectKindDescriptor | undefined {
  return allKinds().find((descriptor) => descriptor.role === role);
}

/** The kind that Add Object begins with: the one added most often. */
export function firstKind(): ObjectKindDescriptor | undefined {
  return allKinds().find((descriptor) => descriptor.add?.first);
}

/** Whether the object has a tab of its own; one of an unknown kind shows its data there. */
export function opensEditor(object: Kinded): boolean {
  const descriptor = kindOf(object.kind);
  return descriptor === undefined || descriptor.editor !== undefined;
}

/** The texts that an object of the kind has, top to bottom. */
export function partsOf(kind: string): readonly Part[] {
  return kindOf(kind)?.parts ?? [];
}

export function valuesOf(object: Pick<ObjectSummary, 'kind' | 'subkind'>): ValuePlace | undefined {
  return kindOf(object.kind)?.online?.valuesOf?.(object.subkind);
}

/** Whether the name of the object begins the paths of its variables in the running application. */
export function holdsValues(object: Pick<ObjectSummary, 'kind' | 'subkind'>): boolean {
  const place = valuesOf(object);
  return place === 'global' || place === 'program';
}

export function kindTitle(kind: string): string {
  return textOf(`kind.${kind}`) ?? kind;
}

export function kindAbout(kind: string): string {
  return textOf(`about.${kind}`) ?? '';
}

export function subkindTitle(subkind: string): string {
  return textOf(`subkind.${subkind}`) ?? subkind;
}

/** Icon of an object, or of a kind where nothing more is said. */
export function objectIcon(kind: string, subkind?: string | null, name?: string): IconComponent {
  const descriptor = kindOf(kind);
  if (descriptor === undefined) return NeutralIcon;
  if (name !== undefined && descriptor.iconOf) return descriptor.iconOf(name);
  return (subkind ? descriptor.subkinds?.[subkind]?.icon : undefined) ?? descriptor.icon;
}

/** The kind that has a subkind, and the subkind: for what is named by the subkind alone, as in libraries. */
export function kindOfSubkind(subkind: string): { kind: string; subkind: string | null } {
  const owner = allKinds().find(({ subkinds }) => subkinds !== undefined && subkind in subkinds);
  return owner === undefined ? { kind: subkind, subkind: null } : { kind: owner.kind, subkind };
}
