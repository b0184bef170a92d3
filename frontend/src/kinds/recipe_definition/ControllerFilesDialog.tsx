import { useQuery } from '@tanstack/react-query';
import { Download, HardDriveUpload, Trash2 } from 'lucide-react';
import { useState } from 'react';
import { api } from '@/api/client';
import { language, useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import { confirm } from '@/ui/dialogs';
import { Empty } from '@/ui/Empty';
import { FormDialog } from '@/ui/FormDialog';
import { Grid, type GridColumn } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { explain } from '@/ui/notices';
import { saveBlob } from '@/workbench/downloadFile';
import styles from './Recipes.module.css';
import { sameName } from './model';
import type { RecipeScene } from './scene';
import { takeFile } from './takeFile';

interface ControllerFilesDialogProps {
  scene: RecipeScene;
  runtimeId: string;
  /** Why the user may not change files in the controller. */
  fixed: string | null;
  close: (answer?: true) => void;
}

/** The recipe files of the definition in the controller: taken into the project, written there, deleted. */
export function ControllerFilesDialog({ scene, runtimeId, fixed, close }: ControllerFilesDialogProps) {
  const t = useText();
  const { projectId, objectId, definition, recipe } = scene;
  const [fault, setFault] = useState<string | null>(null);
  const query = { project_id: projectId, definition_id: objectId };
  const { data, error, refetch } = useQuery({
    queryKey: ['recipe-files', runtimeId, projectId, objectId],
    queryFn: () =>
      api.get('/api/v1/runtimes/{runtime_id}/recipes/files', {
        params: { path: { runtime_id: runtimeId }, query },
      }),
    retry: false,
    gcTime: 0,
  });
  const found = data?.files ?? [];
  const selection = useGridSelection(found.length);
  const file = found[selection.cursor?.row ?? -1] ?? null;
  const none = file === null ? t('recipes.chooseFileThere') : null;
  const params = (name: string) => ({ path: { runtime_id: runtimeId, recipe: name }, query });
  const columns: GridColumn[] = [
    { id: 'recipe', title: t('recipes.recipe'), width: 160, grow: true },
    { id: 'name', title: t('recipes.fileName'), width: 240, grow: true, code: true },
    { id: 'size', title: t('recipes.fileBytes'), width: 90 },
    { id: 'modified', title: t('recipes.fileModified'), width: 170 },
  ];
  const act = async (run: () => Promise<void>) => {
    setFault(null);
    try {
      await run();
    } catch (reason) {
      setFault(explain(reason).text ?? explain(reason).title);
    }
  };
  const read = (name: string) =>
    api.download('/api/v1/runtimes/{runtime_id}/recipes/files/{recipe}', { params: params(name) });
  const download = () =>
    act(async () => {
      if (file !== null) saveBlob(await read(file.recipe), file.name);
    });
  const load = () =>
    act(async () => {
      if (file === null) return;
      const text = await (await read(file.recipe)).text();
      const there = definition.recipes.find((one) => sameName(one.name, file.recipe));
      await takeFile(scene, text, there?.name ?? null, file.recipe);
      close(true);
    });
  const store = () =>
    act(async () => {
      if (recipe === null) return;
      const stored = await api.download('/api/v1/projects/{project_id}/recipes/{definition_id}/{recipe}/file', {
        params: { path: { project_id: projectId, definition_id: objectId, recipe } },
      });
      await api.put('/api/v1/runtimes/{runtime_id}/recipes/files/{recipe}', {
        params: params(recipe),
        body: { text: await stored.text() },
      });
      await refetch();
    });
  const remove = () =>
    act(async () => {
      if (file === null) return;
      const sure = await confirm({
        title: t('recipes.deleteFile', { name: file.name }),
        text: t('recipes.deleteFileText'),
        action: t('action.delete'),
        danger: true,
      });
      if (!sure) return;
      await api.delete('/api/v1/runtimes/{runtime_id}/recipes/files/{recipe}', { params: params(file.recipe) });
      selection.clear();
      await refetch();
    });
  return (
    <FormDialog
      title={t('recipes.files')}
      description={t('recipes.filesText')}
      width={720}
      action={t('recipes.loadFile')}
      disabledReason={none}
      onClose={() => close()}
      onSubmit={() => void load()}
      aside={
        <span className={styles.acts}>
          <IconButton
            icon={HardDriveUpload}
            label={recipe === null ? t('recipes.saveThere') : t('recipes.saveThereNamed', { name: recipe })}
            disabledReason={fixed ?? (recipe === null ? t('recipes.noRecipe') : null)}
            onClick={() => void store()}
          />
          <IconButton
            icon={Download}
            label={t('recipes.downloadFile')}
            disabledReason={none}
            onClick={() => void download()}
          />
          <IconButton
            icon={Trash2}
            label={t('recipes.deleteFileThere')}
            disabledReason={fixed ?? none}
            onClick={() => void remove()}
          />
        </span>
      }
    >
      <div className={styles.list}>
        <Grid
          label={t('recipes.files')}
          columns={columns}
          count={found.length}
          keyOf={(at) => found[at]?.name ?? ''}
          cell={(at, { id }) => {
            const row = found[at];
            if (row === undefined) return null;
            if (id === 'size') return row.size.toLocaleString(language());
            if (id === 'modified')
              return new Date(row.modified).toLocaleString(language(), { dateStyle: 'short', timeStyle: 'medium' });
            return id === 'name' ? row.name : row.recipe;
          }}
          selected={selection.selected}
          cursor={selection.cursor}
          onCursor={selection.move}
          onEdit={() => void load()}
          onKey={(event) => event.key === 'Delete' && fixed === null && file !== null && (void remove(), true)}
          empty={
            <Empty
              title={error ? (explain(error).text ?? explain(error).title) : t('recipes.noFiles')}
              text={error ? undefined : t('recipes.noFilesText')}
            />
          }
        />
      </div>
      {fault !== null && (
        <p className={styles.fault} role="alert">
          {fault}
        </p>
      )}
    </FormDialog>
  );
}
