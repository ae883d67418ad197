// The command, for comparison.

import { spawnSync } from "node:child_process";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const program = resolve(process.env.LIOUVILLE ?? `${root}/target/release/liouville`);

/** Runs the command; colours are off. */
export function command(args, { cwd, input }) {
  const env = { ...process.env, NO_COLOR: "1" };
  const done = spawnSync(program, args, { cwd, input, env, encoding: "utf8", maxBuffer: 1 << 30 });
  if (done.error) throw done.error;
  return done;
}

/** A document without the duration of the run. */
export const timeless = (document) => document.replace(/"seconds": [0-9.e-]+/, '"seconds": 0');
