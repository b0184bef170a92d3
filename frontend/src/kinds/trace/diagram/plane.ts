/** Where a curve is drawn, in pixels of the canvas. */
export interface Plane {
  left: number;
  top: number;
  width: number;
  height: number;
  toX: (ns: number) => number;
  toY: (value: number) => number;
}
