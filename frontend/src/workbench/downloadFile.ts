import { api } from '@/api/client';

/** Fetches a file of the API and hands it to the browser as a download; the name may depend on the media type. */
export async function downloadUrl(path: string, name: string | ((type: string) => string)): Promise<void> {
  const blob = await api.get<Blob>(path);
  saveBlob(blob, typeof name === 'string' ? name : name(blob.type));
}

export function saveBlob(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name.replace(/[\\/:*?"<>|]/g, '_');
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
