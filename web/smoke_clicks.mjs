// Uses the reports of two runs, in the plane and in space, in headless Chromium as a person would: hovers, clicks, keys. What the
// page then says is compared with the files of the results. Fails on any console message.
//
// node smoke_clicks.mjs PROGRAM [--shot PREFIX]
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import { check, judge, picture, until } from './browser.mjs';
import { numbers } from './src/data.js';

const program = resolve(process.argv[2]);
const problems = [];
const { equal, close } = judge(problems);

const plane = `osculate: 1
title: clicked block
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [12, 6]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6}, friction: {coulomb: {mu: 0.2, penalty: 1.0e6}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.05}]}
  - {name: push, increments: 6, prescribe: [{on: block.top, ux: 0.2}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: slipping}]}
`;
const space = `osculate: 1
title: clicked cube
mesh: {generate: {cube: {box: {x: [0, 2], y: [0, 2], z: [0, 1], elements: [8, 8, 4]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: cube, material: s, element: solid}]
rigid: {ball: {sphere: {center: [1, 1, 1.61], radius: 0.6}}}
contact: [{name: c, master: ball, slave: cube.top, normal: {penalty: 1.0e5}}]
steps: [{name: press, increments: 3, prescribe: [{on: cube.bottom, ux: 0, uy: 0, uz: 0}, {on: ball, uz: -0.1}]}]
output: {history: [{on: c, of: normal_force}]}
`;

/** What the program has left: report, summary, rows of the history by column. */
function run(dir, name, model) {
  writeFileSync(join(dir, `${name}.yaml`), model);
  execFileSync(program, ['run', `${name}.yaml`, '--quiet'], { cwd: dir });
  const folder = join(dir, `${name}.results`);
  const read = (file) => readFileSync(join(folder, file), 'utf8');
  const [head, ...rows] = read('history.csv').trim().split('\n').map((line) => line.split(','));
  return {
    page: `file://${folder}/report.html`, report: JSON.parse(read('report.json')), summary: JSON.parse(read('summary.json')),
    rows: rows.map((row) => Object.fromEntries(head.map((column, i) => [column, Number(row[i])]))),
  };
}

const text = (selector) => `document.querySelector(${JSON.stringify(selector)})?.innerText ?? ''`;
const tile = (name) => `[...document.querySelectorAll('.tile')].find((t) => t.lastChild.textContent === ${JSON.stringify(name)})?.firstChild.textContent.replaceAll('\u202f', '')`;

/** {left, top, width, height} of the first element that the expression gives, after it has been scrolled into view. */
async function place(page, expression) {
  const box = await page.evaluate(`(async () => {
    const node = ${expression};
    node.scrollIntoView({ block: 'center', behavior: 'instant' });
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const { left, top, width, height } = node.getBoundingClientRect();
    return { left, top, width, height };
  })()`);
  return { ...box, at: (x, y) => [box.left + x * box.width, box.top + y * box.height] };
}
const one = (selector) => `document.querySelector(${JSON.stringify(selector)})`;
const plotOf = (title) => `[...document.querySelectorAll('.plot')].find((p) => p.ariaLabel === ${JSON.stringify(title)}).querySelector('.u-over')`;

/** Chooses an option by the keys of a user: the list with the focus, arrows. */
async function choose(page, selector, wanted) {
  const options = await page.evaluate(`[...${one(selector)}.options].map((o) => o.text)`);
  const target = options.indexOf(wanted);
  if (target < 0) throw new Error(`${selector} has no '${wanted}', but ${options}`);
  await page.evaluate(`${one(selector)}.focus()`);
  for (;;) {
    const now = await page.evaluate(`${one(selector)}.selectedIndex`);
    if (now === target) return;
    await page.key(now < target ? 'ArrowDown' : 'ArrowUp');
    if (await page.evaluate(`${one(selector)}.selectedIndex`) === now) throw new Error(`${selector}: keys do nothing`);
  }
}

/** What the page says of the frame with this number. */
function frameText({ report }, number) {
  const { step, increment } = report.frames[number];
  return [`step ${step}, increment ${increment}, time `, `(${number + 1} of ${report.frames.length})`];
}
async function compareFrame(page, results, name, number) {
  const said = await page.evaluate(text('#body .readout'));
  const [begin, end] = frameText(results, number);
  if (!said.startsWith(begin) || !said.endsWith(end)) problems.push(`${name}: '${said}', wanted '${begin}...${end}'`);
  close(`${name}: time`, /time ([^ ]+)/.exec(said)?.[1], results.report.frames[number].time, 5);
}

/** Hovers over the picture; every node that it tells of is compared with the data. Returns how many it was. */
async function compareNodes(page, results, dimension, name, frame, field, value) {
  const canvas = await place(page, one('#body canvas'));
  const points = numbers(results.report.mesh.points);
  const u = numbers(results.report.frames[frame].u);
  const seen = new Set();
  for (let i = 0; i < 180 && seen.size < 25; ++i) { // spread evenly, in no pattern that nodes could have
    await page.hover(canvas.at(0.05 + 0.8 * ((i * 0.7548776662) % 1), 0.05 + 0.9 * ((i * 0.5698402910) % 1)));
    const said = await page.evaluate(`${one('#body .canvas-host .tip')}.hidden ? '' : ${one('#body .canvas-host .tip')}.innerText`);
    const node = /node (\d+)\s+at ([^\n]+)/.exec(said);
    if (!node) continue;
    const index = results.report.mesh.numbers ? numbers(results.report.mesh.numbers).indexOf(Number(node[1])) : Number(node[1]) - 1;
    if (seen.has(index)) continue;
    seen.add(index);
    const places = node[2].split(', ');
    const moved = /u = ([^\n]+)/.exec(said)?.[1].split(', ');
    for (let k = 0; k < dimension; ++k) {
      const [x, d] = [points[dimension * index + k], u[dimension * index + k]];
      close(`${name}: place of node ${node[1]}`, places[k], x + d, 5);
      if (moved) close(`${name}: displacement of node ${node[1]}`, moved[k], d, 5);
    }
    close(`${name}: ${field} of node ${node[1]}`, new RegExp(`^${field.replace(/[|]/g, '\\|')}: ([^\\n]+)`).exec(said)?.[1], value(index, u), 6);
  }
  return seen.size;
}

async function tiles(page, results) {
  const { increments, iterations } = results.summary.total;
  equal('increments', await page.evaluate(tile('increments')), String(increments));
  equal('iterations', await page.evaluate(tile('iterations')), String(iterations));
  equal('unknowns', await page.evaluate(tile('unknowns')), String(results.summary.unknowns));
  equal('title', await page.evaluate(text('h1')), results.report.title);
  equal('status', await page.evaluate(text('.badge')), 'done');
}

async function open(page, results) {
  await page.send('Page.navigate', { url: results.page });
  await until('picture', () => page.evaluate(`document.querySelectorAll('#body canvas').length && document.querySelectorAll('.u-over').length`), (n) => n > 0);
  await pause(200);
}

/** The frame by the slider, by keys, by the button that plays. */
async function frames(page, results) {
  const last = results.report.frames.length - 1;
  const slider = await place(page, one('#body .player input'));
  await page.click(slider.at(0.002, 0.5));
  await compareFrame(page, results, 'slider at its beginning', 0);
  await page.click(slider.at(0.998, 0.5));
  await compareFrame(page, results, 'slider at its end', last);
  await page.evaluate(`${one('#body canvas')}.focus()`);
  await page.key('ArrowLeft');
  await compareFrame(page, results, 'arrow to the left', last - 1);
  await page.key('ArrowRight');
  await compareFrame(page, results, 'arrow to the right', last);
  const play = await place(page, one('#body .play'));
  const readout = () => page.evaluate(text('#body .readout'));
  const before = await readout();
  await page.click(play.at(0.5, 0.5));
  await until('it plays', readout, (said) => said !== before, 5);
  await page.click(play.at(0.5, 0.5));
  const stopped = await readout();
  await pause(700);
  equal('it has stopped', await readout(), stopped);
  await page.click((await place(page, one('#body .player input'))).at(0.998, 0.5));  // it may have moved beside the button
  await until('slider back at its end', readout, (said) => said.endsWith(frameText(results, last)[1]), 5);
}

/** Points of a curve: what is said of them is a row of the history; a click shows its frame. */
async function histories(page, results, column) {
  const area = await place(page, plotOf(column));
  const tip = `${plotOf(column)}.querySelector('.tip')`;
  const rows = new Set();
  for (let i = 1; i < 14; ++i) {
    for (const y of [0.1, 0.5, 0.9]) {
      await page.hover(area.at(i / 14, y));
      const said = await page.evaluate(`${tip}.hidden ? '' : ${tip}.innerText`);
      const found = /increment (\d+)/.exec(said);
      if (!found) continue;
      const step = Number(/(\d+), increment/.exec(said)?.[1]);
      const number = results.rows.findIndex((row) => row.increment === Number(found[1]) && row.step === step);
      if (rows.has(number)) continue;
      rows.add(number);
      const row = results.rows[number];
      if (!row) {
        problems.push(`${column}: '${said}' is no row of the history`);
        continue;
      }
      close(`${column} of row ${number}`, /: ([^\n]+)/.exec(said)[1], row[column], 6);
      close(`time of row ${number}`, /time: ([^\n]+)/.exec(said)?.[1], row.time, 6);
      await page.click(area.at(i / 14, y));
      const frame = results.report.frames.findIndex((f) => f.step === row.step && f.increment === row.increment);
      if (frame >= 0) await compareFrame(page, results, `click on ${column}`, frame);
      await place(page, plotOf(column));
    }
  }
  if (rows.size < 3) problems.push(`${column}: only ${rows.size} points of the curve were found`);
  return rows.size;
}

/** The bars of the iterations: what they say is in the summary. */
async function bars(page, results) {
  const title = await page.evaluate(`[...document.querySelectorAll('.plot')].map((p) => p.ariaLabel).find((t) => t?.startsWith('Iterations per'))`);
  const area = await place(page, plotOf(title));
  const all = results.summary.steps.flatMap((step) => step.increments.map((i, k) => ({ ...i, step: step.name, index: i.increment ?? k + 1 })));
  for (let k = 0; k < all.length; ++k) {
    await page.hover(area.at((k + 0.5) / all.length, 0.9));
    const said = await page.evaluate(`${plotOf(title)}.querySelector('.tip').innerText`);
    const wanted = [`${all[k].step}, increment ${all[k].index}`, `${all[k].iterations} iterations`];
    for (const words of wanted) if (!said.includes(words)) problems.push(`bar ${k}: '${said}' lacks '${words}'`);
    close(`residual of bar ${k}`, /residual ([^,]+)/.exec(said)?.[1], all[k].residual, 3);
  }
}

async function table(page, results) {
  const summary = await place(page, one('#run details summary'));
  await page.click(summary.at(0.1, 0.5));
  const rows = await page.evaluate(`[...document.querySelectorAll('#run table.increments tbody tr')].map((r) => [...r.children].map((c) => c.innerText))`);
  const all = results.summary.steps.flatMap((step) => step.increments.map((i) => [step.name, i.iterations]));
  equal('rows of the table', rows.map((r) => [r[0], Number(r[3])]), all);
}

async function inPlane(page, results) {
  const last = results.report.frames.length - 1;
  await choose(page, '#body select', 'displacement ux');
  const value = (i, u) => u[2 * i];
  const nodes = await compareNodes(page, results, 2, 'plane', last, 'displacement ux', value);
  await choose(page, '#body select', 'stress yy');
  const tensors = numbers(results.report.frames[last].stress);
  const stressed = await compareNodes(page, results, 2, 'plane', last, 'stress yy', (i) => tensors[4 * i + 1]);
  if (Math.min(nodes, stressed) < 20) problems.push(`plane: only ${nodes} and ${stressed} nodes were found`);
  // nearer: another node is under the same place; and back
  const canvas = await place(page, one('#body canvas'));
  const near = async () => {
    await page.hover(canvas.at(0.2, 0.3));
    return page.evaluate(text('#body .canvas-host .tip'));
  };
  const whole = await near();
  const button = async (name) => page.click((await place(page, one(`#body button[title="${name}"]`))).at(0.5, 0.5));
  await button('zoom in');
  await button('zoom in');
  await place(page, one('#body canvas'));
  if (await near() === whole) problems.push('zoom in does nothing');
  await button('show everything');
  await place(page, one('#body canvas'));
  equal('fit', await near(), whole);
  const points = await histories(page, results, 'c.normal_force');
  return `plane: ${nodes} + ${stressed} nodes, ${points} points of a curve`;
}

async function inSpace(page, results) {
  const last = results.report.frames.length - 1;
  await choose(page, '#body select', 'displacement uz');
  const nodes = await compareNodes(page, results, 3, 'space', last, 'displacement uz', (i, u) => u[3 * i + 2]);
  // turned: other nodes are seen
  const canvas = await place(page, one('#body canvas'));
  await page.drag(canvas.at(0.5, 0.5), canvas.at(0.9, 0.7));
  await pause(100);
  const turned = await compareNodes(page, results, 3, 'turned', last, 'displacement uz', (i, u) => u[3 * i + 2]);
  if (Math.min(nodes, turned) < 12) problems.push(`space: only ${nodes} and ${turned} nodes were found`);
  return `space: ${nodes} + ${turned} nodes`;
}

/** What every report has, and in between what `look` looks at; it says what it has found. */
async function report(dir, page, name, model, look) {
  const results = run(dir, name, model);
  await open(page, results);
  await tiles(page, results);
  await frames(page, results);
  const found = await look(page, results);
  await bars(page, results);
  await table(page, results);
  await picture(page, `${name}.png`);
  return found;
}

await check('clicks', problems, async ({ dir, browser }) => {
  const page = await browser();
  return [await report(dir, page, 'plane', plane, inPlane), await report(dir, page, 'space', space, inSpace)];
});
