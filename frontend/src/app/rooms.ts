/**
 * Every room registers its editors, panels and commands here, once at the start.
 * A room has a `register.ts` that only registers: components behind it are loaded when they are first shown.
 */
import '@/workbench/register';
import '@/editors/register';
import '@/online/register';
