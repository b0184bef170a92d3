import { ofKind, shaped } from '@/api/objects';
import type { SettingsProps } from '@/project/kinds';
import { Failed, Loading } from '@/ui/Empty';
import { useLibraries } from '@/workbench/libraries/useLibraries';
import { LibraryParameters } from './LibraryParameters';
import styles from './LibraryManager.module.css';

/** The project settings of a library manager: values of the parameters of its libraries. */
export default function ParametersPage({ object, readOnly, change }: SettingsProps) {
  const installed = useLibraries();
  const { references } = shaped(object, ofKind('library_manager')).data;
  if (installed.error) return <Failed error={installed.error} />;
  if (!installed.data) return <Loading />;
  return (
    <div className={styles.settings}>
      <LibraryParameters
        references={references}
        installed={installed.data}
        readOnly={readOnly}
        change={(at, edited) =>
          change({ references: references.map((reference, place) => (place === at ? edited : reference)) })
        }
      />
    </div>
  );
}
