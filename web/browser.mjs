// Headless Chromium over its pipe, for the checks of the page: what it says is kept, clicks and keys are those of a user. And what
// the checks have in common: a folder, a verdict, pictures.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';

/** Chromium has ended, or the process that draws the page has: nothing that the page could do. */
export class BrowserCrashed extends Error {}

/** {send(method, params), evaluate(expression), click(x, y), hover(x, y), drag(from, to), key(name), process}. */
export async function openBrowser(dir, problems) {
  const child = spawn(process.env.CHROMIUM ?? 'chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--remote-debugging-pipe', '--hide-scrollbars',
    `--user-data-dir=${join(dir, 'profile')}`, '--window-size=1200,1600', 'about:blank'],
  { cwd: dir, stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
  const started = new Promise((resolve, reject) => {
    child.once('error', reject);
    child.once('spawn', resolve);
  });
  await started;
  const waiting = new Map();
  let [number, rest, session, crash] = [0, '', undefined, null];
  const crashed = (how) => {
    crash ??= new BrowserCrashed(how);
    for (const settle of waiting.values()) settle({ crash });
    waiting.clear();
  };
  child.once('exit', (code, signal) => crashed(`Chromium has ended by itself (${signal ?? `exit code ${code}`})`));
  child.stdio[3].on('error', () => crashed('Chromium takes no more commands'));
  child.stdio[4].on('data', (bytes) => {
    const parts = (rest + bytes).split('\0');
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) {
        waiting.get(message.id)?.(message);
        waiting.delete(message.id);
      }
      if (message.method === 'Inspector.targetCrashed') crashed('the page\'s process has crashed');
      if (message.method === 'Runtime.consoleAPICalled') problems.push(`console: ${JSON.stringify(message.params.args)}`);
      if (message.method === 'Runtime.exceptionThrown') problems.push(JSON.stringify(message.params.exceptionDetails));
      if (message.method === 'Log.entryAdded') problems.push(`log: ${message.params.entry.text} ${message.params.entry.url ?? ''}`);
    }
  });
  const send = (method, params = {}) => new Promise((resolve, reject) => {
    if (crash) {
      reject(crash);
      return;
    }
    waiting.set(++number, (answer) => {
      if (answer.crash) reject(answer.crash);
      else if (answer.error) reject(new Error(`${method}: ${answer.error.message}`));
      else resolve(answer.result);
    });
    child.stdio[3].write(`${JSON.stringify({ id: number, method, params, sessionId: session })}\0`);
  });
  const { targetInfos } = await send('Target.getTargets');
  ({ sessionId: session } = await send('Target.attachToTarget',
    { targetId: targetInfos.find((t) => t.type === 'page').targetId, flatten: true }));
  for (const domain of ['Runtime', 'Log', 'Page', 'Inspector']) await send(`${domain}.enable`);
  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(JSON.stringify(exceptionDetails));
    return result.value;
  };
  const mouse = (type, [x, y], more = {}) => send('Input.dispatchMouseEvent', { type, x, y, ...more });
  const left = { button: 'left', buttons: 1, clickCount: 1 };
  const hover = (at) => mouse('mouseMoved', at);
  return {
    process: child, send, evaluate, hover,
    async click(at) {
      await hover(at);
      await mouse('mousePressed', at, left);
      await mouse('mouseReleased', at, { ...left, buttons: 0 });
    },
    async drag(from, to) {
      await hover(from);
      await mouse('mousePressed', from, left);
      await mouse('mouseMoved', to, left);
      await mouse('mouseReleased', to, { ...left, buttons: 0 });
    },
    /** `text`: the character that the key writes. */
    async key(key, text) {
      const code = { ArrowRight: 39, ArrowLeft: 37, ArrowDown: 40, ArrowUp: 38, ' ': 32, Home: 36, End: 35 }[key];
      const event = { key, code: key === ' ' ? 'Space' : key, windowsVirtualKeyCode: code };
      await send('Input.dispatchKeyEvent', { type: 'keyDown', ...event, text });
      await send('Input.dispatchKeyEvent', { type: 'keyUp', ...event });
    },
  };
}

/** Waits until `make()` is what is wanted. */
export async function until(name, make, wanted, seconds = 30) {
  let found;
  for (let i = 0; i < 10 * seconds; ++i) {
    found = await make();
    if (wanted(found)) return found;
    await pause(100);
  }
  throw new Error(`${name}: ${JSON.stringify(found)}`);
}

/** {equal(name, found, wanted), close(name, found, wanted, digits)}: what is not so is a problem. */
export function judge(problems) {
  const equal = (name, found, wanted) => {
    if (JSON.stringify(found) !== JSON.stringify(wanted)) problems.push(`${name}: ${JSON.stringify(found)}, wanted ${JSON.stringify(wanted)}`);
  };
  const close = (name, found, wanted, digits) => {
    if (Number.isFinite(Number(found)) && Number.isFinite(wanted)) equal(name, Number(found), Number(wanted.toPrecision(digits)));
    else problems.push(`${name}: '${found}', wanted ${wanted}`);
  };
  return { equal, close };
}

/** What follows a name on the command line, or null. */
export function argument(name) {
  const at = process.argv.indexOf(name);
  return at < 0 ? null : process.argv[at + 1];
}

/** A picture of the whole page, where the command line has `--shot PREFIX`. */
export async function picture(page, name) {
  if (!argument('--shot')) return;
  const { data } = await page.send('Page.captureScreenshot', { captureBeyondViewport: true });
  writeFileSync(resolve(`${argument('--shot')}${name}`), Buffer.from(data, 'base64'));
}

/** Runs `body({dir, start, browser})` in a folder of its own, says what was found, and ends the process: 1 where there are problems, or
    it has thrown. `start` runs a command there, `browser` starts Chromium; both are ended with it. Where Chromium has crashed, and only
    then, all is done once more, which is said; what was a problem before remains one. `body` gives lines to say where all is well. */
export async function check(name, problems, body) {
  const said = [];
  for (let crashes = 0, done = false; !done;) {
    const dir = mkdtempSync(join(tmpdir(), `osculate-${name}-`));
    const children = [];
    const start = (command, args, options = {}) => {
      children.push(spawn(command, args, { cwd: dir, ...options }));
      return children.at(-1);
    };
    const browser = async () => {
      const page = await openBrowser(dir, problems);
      children.push(page.process);
      return page;
    };
    try {
      said.push(...await body({ dir, start, browser }) ?? []);
      done = true;
    } catch (error) {
      done = !(error instanceof BrowserCrashed) || ++crashes > 1;
      if (done) problems.push(error.stack);
      else said.push(`${error.message}; started once more`);
    }
    for (const child of children) {
      child.kill('SIGCONT');
      child.kill('SIGKILL');
    }
    await pause(300);
    rmSync(dir, { recursive: true, force: true, maxRetries: 20, retryDelay: 200 });
  }
  console.log([...said, ...(problems.length ? problems.slice(0, 40) : ['no errors'])].join('\n'));
  process.exit(problems.length ? 1 : 0);
}
