/** The extension: language server and debug adapter are the program `tappet`, which is started here. */

import * as vscode from 'vscode';
import { LanguageClient, TransportKind } from 'vscode-languageclient/node';
import { type Command, completed, tappetCommand } from './command';

let client: LanguageClient | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory('tappet', { createDebugAdapterDescriptor: adapter }),
    vscode.debug.registerDebugConfigurationProvider('tappet', {
      resolveDebugConfiguration: (_folder, configuration) =>
        completed(configuration, vscode.window.activeTextEditor?.document.fileName) as vscode.DebugConfiguration,
    }),
    vscode.commands.registerCommand('tappet.restartLanguageServer', () => restart()),
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration('tappet.command')) void restart();
    }),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await client?.stop();
}

function command(...words: string[]): Command {
  const setting: unknown = vscode.workspace.getConfiguration('tappet').get('command');
  const found = tappetCommand(setting, ...words);
  if (!found) throw new Error(vscode.l10n.t('The setting tappet.command names no program.'));
  return found;
}

async function start(): Promise<void> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  const { program, arguments: args } = command('lsp', '--stdio', ...(folder ? [folder] : []));
  client = new LanguageClient(
    'tappet',
    'Tappet',
    { command: program, args: [...args], transport: TransportKind.stdio },
    {
      documentSelector: [{ language: 'iec-st' }, { scheme: 'tappet-library' }],
    },
  );
  await client.start();
}

async function restart(): Promise<void> {
  await client?.stop();
  await start();
}

function adapter(session: vscode.DebugSession): vscode.DebugAdapterDescriptor {
  const { program, arguments: args } = command('dap');
  const folder = session.workspaceFolder?.uri.fsPath;
  return new vscode.DebugAdapterExecutable(program, [...args], folder ? { cwd: folder } : {});
}
