/** Registers the editors of this room; their components are loaded when the first object opens. */
export {};
