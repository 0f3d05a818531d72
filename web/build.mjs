// Bundles src/ into dist/report.js and stores the hash of everything it was made from, so that
// tools/check_web can tell without Node whether the committed bundle is the one of these sources.
import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { dirname, join } from 'node:path';

const here = dirname(fileURLToPath(import.meta.url));
const license = readFileSync(join(here, 'node_modules/uplot/LICENSE'), 'utf8').trim();
const result = await build({
  absWorkingDir: here,
  entryPoints: ['src/main.js'],
  outfile: 'dist/report.js',
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  charset: 'ascii',
  banner: { js: `/* Contains uPlot.\n${license}\n*/` },
  loader: { '.css': 'text' },
  metafile: true,
});
const bytes = result.metafile.outputs['dist/report.js'].bytes;
execFileSync(join(here, '../tools/check_web'), ['--write'], { stdio: 'inherit' });
console.log(`dist/report.js: ${(bytes / 1024).toFixed(1)} KiB`);
