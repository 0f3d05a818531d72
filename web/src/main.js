// The report page: reads the data embedded in the page and builds the sections; of a run that goes on it asks for them.
import plotStyle from 'uplot/dist/uPlot.min.css';
import style from './style.css';
import { el } from './dom.js';
import { watch } from './live.js';
import { build } from './page.js';

function start() {
  document.head.append(el('style', {}, plotStyle + style));
  const root = document.getElementById('report');
  let report;
  try {
    report = JSON.parse(document.getElementById('report-data').textContent);
  } catch (error) {
    root.append(el('p', { class: 'warning' }, `The data of this report cannot be read: ${error.message}`));
    return;
  }
  if (report.live) watch(root);
  else root.replaceChildren(...build(report).nodes);
}

start();
