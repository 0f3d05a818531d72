// Watches a run in headless Chromium by `osculate view`: what the page says is compared with what the server tells, with the
// run standing still, going on and done; clicks by a user in between. Fails on any console message.
//
// node smoke_live.mjs PROGRAM [--shot PREFIX]
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import { check, judge, picture, until } from './browser.mjs';

const program = resolve(process.argv[2]);
const problems = [];
const { equal } = judge(problems);

const model = `osculate: 1
title: watched block
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [24, 12]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6}, friction: {coulomb: {mu: 0.2, penalty: 1.0e6}}}]
steps:
  - {name: press, increments: 4, prescribe: [{on: block.top, ux: 0, uy: -0.05}]}
  - {name: push, increments: 400, prescribe: [{on: block.top, ux: 0.2}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: slipping}]}
`;

/** Lets the run go on until its history has so many rows more. */
async function further(run, history, more) {
  const rows = () => readFileSync(history, 'utf8').split('\n').length;
  const before = rows();
  run.kill('SIGCONT');
  while (rows() < before + more && run.exitCode === null) await pause(1);
  run.kill('SIGSTOP');
  await pause(50);
}

const text = (selector) => `document.querySelector(${JSON.stringify(selector)})?.textContent ?? ''`;
const tile = (name) => `[...document.querySelectorAll('.tile')].find((t) => t.lastChild.textContent === ${JSON.stringify(name)})?.firstChild.textContent`;
const click = (selector) => `document.querySelector(${JSON.stringify(selector)}).click()`;

async function main({ dir, start, browser }) {
  const history = join(dir, 'm.results/history.csv');
  writeFileSync(join(dir, 'm.yaml'), model);
  const run = start(program, ['run', 'm.yaml', '--quiet']);
  await until('history', () => existsSync(history), Boolean);
  await further(run, history, 6);
  const server = start(program, ['view', 'm.results'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = String(await new Promise((resolve) => { server.stdout.once('data', resolve); })).trim();
  const ask = async () => (await fetch(`${url}state.json`)).json();
  const page = await browser();
  await page.send('Page.navigate', { url });
  await until('plot', () => page.evaluate(`document.querySelectorAll('#live canvas').length`), (n) => n === 1);

  /** The page as it has to be with the run standing still. */
  const compare = async (name) => {
    const state = await ask();
    const made = state.entries.filter((e) => e.increment);
    await until(`${name}: increments`, () => page.evaluate(tile('increments')), (t) => t === String(made.length));
    equal(`${name}: iterations`, await page.evaluate(tile('iterations')),
      String(made.reduce((sum, e) => sum + e.increment.iterations, 0)));
    const [, number, , iteration] = state.iterations.at(-1);
    const now = await page.evaluate(text('#live .message'));
    equal(`${name}: residual`, Number(/residual ([-+.\de]+)/.exec(now)?.[1]), Number(state.iterations.at(-1)[4].toPrecision(3)));
    if (!now.includes(`increment ${number} `)) problems.push(`${name}: '${now}' lacks increment ${number}`);
    if (!/converged/.test(now) && !now.includes(`iteration ${iteration}`)) problems.push(`${name}: ${now}`);
    equal(`${name}: log`, await page.evaluate(text('#live .log')), state.log.join('\n'));
    equal(`${name}: status`, await page.evaluate(text('.badge')), 'still running');
    return made;
  };
  const readout = () => page.evaluate(text('#body .readout'));

  let made = await compare('first');
  equal('title', await page.evaluate(text('h1')), 'watched block');
  const last = () => `increment ${made.at(-1).row[1]}, time`;
  if (!(await readout()).includes(last())) problems.push(`first: the last frame is not shown: ${await readout()}`);
  await picture(page, 'first.png');

  // a field is chosen, the picture is moved in: both stay when the next increments come
  await page.evaluate(`{ const s = document.querySelector('#body select'); s.value = 'displacement ux'; s.dispatchEvent(new Event('change')); }`);
  await page.evaluate(click('#body button[title="zoom in"]'));
  await further(run, history, 5);
  made = await compare('second');
  equal('plot', await page.evaluate(`document.querySelectorAll('#live canvas').length`), 1); // the page has been built anew meanwhile
  equal('field', await page.evaluate(`document.querySelector('#body select').value`), 'displacement ux');
  if (!(await readout()).includes(last())) problems.push(`second: the last frame is not shown: ${await readout()}`);
  await picture(page, 'second.png');

  // an earlier frame is looked at: it stays
  await page.evaluate(`{ const s = document.querySelector('#body .player input'); s.value = 2; s.dispatchEvent(new Event('input')); }`);
  const early = (await readout()).split('(')[0];
  await further(run, history, 5);
  made = await compare('third');
  equal('frame', (await readout()).split('(')[0], early);

  // without following all but the increment under way stands still
  const shown = made.length;
  await page.evaluate(click('#live input'));
  await further(run, history, 5);
  const state = await ask();
  await until('unfollowed', () => page.evaluate(text('#live .log')), (t) => t === state.log.join('\n'));
  await pause(1500);
  equal('unfollowed', await page.evaluate(tile('increments')), String(shown));
  await page.evaluate(click('#live input'));
  await compare('followed again');

  // the end: the report
  run.kill('SIGCONT');
  await until('done', () => page.evaluate(text('.badge')), (t) => t === 'done', 120);
  const summary = JSON.parse(readFileSync(join(dir, 'm.results/summary.json'), 'utf8'));
  equal('done: iterations', await page.evaluate(tile('iterations')),
    String(summary.total.iterations).replace(/\B(?=(\d{3})+$)/g, '\u202f'));
  equal('done: live', await page.evaluate(`document.querySelector('#live').hidden`), true);
  await picture(page, 'done.png');

  // Ctrl-C
  const code = await new Promise((resolve) => { server.once('exit', resolve); server.kill('SIGINT'); });
  equal('exit code', code, 0);
  await until('lost', () => page.evaluate(`document.querySelector('#report > .warning').hidden`), (t) => t === false);
  for (let i = problems.length - 1; i >= 0; --i) if (problems[i].includes('ERR_CONNECTION_REFUSED')) problems.splice(i, 1); // it has ended
}

await check('live', problems, main);
