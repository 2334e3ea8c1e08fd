// The programs that tell the rays of a pixel: those of ./learn trace, as patches of the steps' programs.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { patch_of } from './mistakes.mjs';
import { root } from './places.mjs';
import { program, steps } from './wasm.mjs';

/** The newest of a step's headers of this name: its own, or that of the closest earlier step. */
const header = (step, name) => steps.filter((each) => each <= step && existsSync(join(root, 'steps', each, name))).at(-1) + `/${name}`;

export const traced_program = (step) => program(step, new Map(), [
    `-DRT_STEP=${Number(step.slice(0, 2))}`, `-DRT_SCENE="${header(step, 'scene.h')}"`, `-DRT_RADIANCE="${header(step, 'radiance.h')}"`,
    '-include', join(root, 'site/twins/drawn_rays.h')]);

export const traced_patch = async (step) => patch_of(await program(step), await traced_program(step));
