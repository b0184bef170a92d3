/** Registers the online panels and commands. */
export {};
