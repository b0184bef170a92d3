/** The diagrams of a trace as one picture (PNG). */

/** What is seen of the diagrams in `place`: their names, canvases and cursors. */
export async function pictureOf(place: HTMLElement): Promise<Blob> {
  const frame = place.getBoundingClientRect();
  const ratio = window.devicePixelRatio || 1;
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(place.scrollWidth * ratio);
  canvas.height = Math.round(place.scrollHeight * ratio);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('no canvas');
  const style = getComputedStyle(document.documentElement);
  context.scale(ratio, ratio);
  context.fillStyle = style.getPropertyValue('--bg');
  context.fillRect(0, 0, place.scrollWidth, place.scrollHeight);
  const at = (element: Element) => {
    const { left, top, width, height } = element.getBoundingClientRect();
    return { x: left - frame.left + place.scrollLeft, y: top - frame.top + place.scrollTop, width, height };
  };
  for (const figure of place.querySelectorAll('figure')) {
    const { x, y, width, height } = at(figure);
    context.fillStyle = getComputedStyle(figure).backgroundColor;
    context.fillRect(x, y, width, height);
  }
  for (const drawn of place.querySelectorAll('canvas')) {
    const { x, y, width, height } = at(drawn);
    context.drawImage(drawn, x, y, width, height);
  }
  context.font = `12px ${style.getPropertyValue('--font-ui')}`;
  context.textBaseline = 'middle';
  for (const entry of place.querySelectorAll('figcaption > *')) {
    const { x, y, height } = at(entry);
    const sign = entry.querySelector('i');
    if (sign) {
      const box = at(sign);
      context.fillStyle = getComputedStyle(sign).backgroundColor;
      context.fillRect(box.x, box.y, box.width, box.height);
    }
    context.fillStyle = style.getPropertyValue('--fg');
    context.fillText(entry.textContent ?? '', sign ? x + 18 : x, y + height / 2);
  }
  for (const cursor of place.querySelectorAll('[data-cursor]')) {
    const { x, y, height } = at(cursor);
    context.strokeStyle = style.getPropertyValue('--fg');
    context.beginPath();
    context.moveTo(x + 0.5, y);
    context.lineTo(x + 0.5, y + height);
    context.stroke();
    context.fillStyle = style.getPropertyValue('--fg');
    context.fillText(cursor.textContent ?? '', x + 6, y + 10);
  }
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture'))), 'image/png');
  });
}
