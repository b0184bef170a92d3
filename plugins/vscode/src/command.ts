/** How `tappet` is started: what the settings say, made into a program with arguments. No import of VS Code here. */

export interface Command {
  readonly program: string;
  readonly arguments: readonly string[];
}

/** The command of the settings with what is to be done; undefined where the setting names no program. */
export function tappetCommand(setting: unknown, ...words: readonly string[]): Command | undefined {
  if (!Array.isArray(setting) || !setting.every((word) => typeof word === 'string')) return undefined;
  const [program, ...first] = setting as string[];
  return program ? { program, arguments: [...first, ...words] } : undefined;
}

/** Debug configurations as VS Code hands them over before their variables are replaced. */
export interface Configuration {
  type?: string;
  request?: string;
  name?: string;
  program?: string;
  [key: string]: unknown;
}

/** A configuration that can be started: F5 without a launch.json debugs the open `.st` file, or the folder. */
export function completed(given: Configuration, openFile: string | undefined): Configuration {
  if (given.type || given.request || given.name) return given;
  const alone = openFile?.toLowerCase().endsWith('.st') ?? false;
  return {
    ...given,
    type: 'tappet',
    request: 'launch',
    name: 'Run in a soft PLC',
    program: alone ? '${file}' : '${workspaceFolder}',
  };
}
