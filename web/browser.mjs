// Headless Chromium over its pipe, for the checks of the page: what it says is kept, clicks and keys are those of a user.
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';

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
  let [number, rest, session] = [0, '', undefined];
  child.stdio[4].on('data', (bytes) => {
    const parts = (rest + bytes).split('\0');
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) waiting.get(message.id)?.(message);
      if (message.method === 'Runtime.consoleAPICalled') problems.push(`console: ${JSON.stringify(message.params.args)}`);
      if (message.method === 'Runtime.exceptionThrown') problems.push(JSON.stringify(message.params.exceptionDetails));
      if (message.method === 'Log.entryAdded') problems.push(`log: ${message.params.entry.text} ${message.params.entry.url ?? ''}`);
    }
  });
  const send = (method, params = {}) => new Promise((resolve, reject) => {
    waiting.set(++number, ({ result, error }) => (error ? reject(new Error(`${method}: ${error.message}`)) : resolve(result)));
    child.stdio[3].write(`${JSON.stringify({ id: number, method, params, sessionId: session })}\0`);
  });
  const { targetInfos } = await send('Target.getTargets');
  ({ sessionId: session } = await send('Target.attachToTarget',
    { targetId: targetInfos.find((t) => t.type === 'page').targetId, flatten: true }));
  for (const domain of ['Runtime', 'Log', 'Page']) await send(`${domain}.enable`);
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
