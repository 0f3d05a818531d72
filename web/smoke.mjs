// Opens a report in headless Chromium and fails on any console message or missing part.
//
// node smoke.mjs [REPORT.html] [--shot FILE.png] [--size 1280x2400]; without REPORT, examples are made.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { example } from './example.mjs';

const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--enable-logging=stderr', '--hide-scrollbars', '--virtual-time-budget=4000'];

function chromium(extra, dir) {
  return spawnSync(process.env.CHROMIUM ?? 'chromium', [...flags, `--user-data-dir=${join(dir, 'profile')}`, ...extra],
    { encoding: 'utf8', maxBuffer: 1 << 28, timeout: 120000 });
}

/** Problems of one page: console messages and missing parts. */
function problems(file, dir, wanted) {
  const run = chromium(['--dump-dom', `file://${resolve(file)}`], dir);
  if (run.error) return [run.error.message];
  const said = run.stderr.split('\n').filter((line) => line.includes(':CONSOLE'));
  const dom = run.stdout.replace(/<script[\s\S]*?<\/script>/g, '');
  return [...said, ...wanted.filter((part) => !dom.includes(part)).map((part) => `missing: ${part}`)];
}

function argument(name) {
  const at = process.argv.indexOf(name);
  return at < 0 ? null : process.argv[at + 1];
}

const dir = mkdtempSync(join(tmpdir(), 'osculate-smoke-'));
let failed = false;
const given = process.argv[2]?.endsWith('.html') ? process.argv[2] : null;
const pages = given ? [[given, ['<h1>']]] : [];
if (!given) {
  const parts = ['<h1>', 'id="body"', 'id="histories"', 'id="convergence"', 'id="model"', 'id="run"', 'u-over'];
  for (const [name, options] of Object.entries({ done: {}, failed: { failed: true }, one: { frames: 2, cells: 12 } })) {
    const file = join(dir, `${name}.html`);
    writeFileSync(file, example(options));
    pages.push([file, parts]);
  }
}
for (const [file, parts] of pages) {
  const found = problems(file, dir, parts);
  console.log(`${file}: ${found.length ? found.join('\n  ') : 'no errors'}`);
  failed ||= found.length > 0;
  if (argument('--shot')) {
    chromium([`--screenshot=${resolve(argument('--shot'))}`,
      `--window-size=${(argument('--size') ?? '1280x2400').replace('x', ',')}`, `file://${resolve(file)}`], dir);
  }
}
rmSync(dir, { recursive: true, force: true });
process.exit(failed ? 1 : 0);
