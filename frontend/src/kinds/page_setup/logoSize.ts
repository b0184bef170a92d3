/** The size of a logo, as the browser decodes it. */
import { useEffect, useState } from 'react';
import { logoAddress } from './model';

export interface PictureSize {
  width: number;
  height: number;
}

/** In pixels; rejects a picture that is damaged. */
export async function logoSize(logo: string): Promise<PictureSize> {
  const image = new Image();
  image.src = logoAddress(logo);
  await image.decode();
  return { width: image.naturalWidth, height: image.naturalHeight };
}

/** Null: there is none, or its size is not known yet. */
export function useLogoSize(logo: string | null): PictureSize | null {
  const [known, setKnown] = useState<{ logo: string; size: PictureSize } | null>(null);
  useEffect(() => {
    let gone = false;
    if (logo !== null)
      logoSize(logo).then(
        (size) => !gone && setKnown({ logo, size }),
        () => undefined,
      );
    return () => {
      gone = true;
    };
  }, [logo]);
  return known !== null && known.logo === logo ? known.size : null;
}
