// SPDX-License-Identifier: Apache-2.0
'use strict';
(() => {
  const {el, isNumber, short} = Elements;
  const sweep = JSON.parse(document.getElementById('data').textContent);
  const objective = sweep.metrics.indexOf(sweep.objective);
  const kShown = 10, kListed = 1000;
  const ranked = sweep.runs.filter((run) => isNumber(run.metrics[objective]))
    .sort((a, b) => a.metrics[objective] - b.metrics[objective] || a.number - b.number);
  const names = [...sweep.parameters.map((parameter) => parameter.name), ...sweep.metrics];
  const valuesOf = (run) => [...run.parameters, ...run.metrics];
  const percent = (share) => `${short(100 * share, 2)} %`;

  const chosen = el('aside', {id: 'chosen', 'aria-live': 'polite', hidden: ''});

  /** Shows one run, wherever on the page it was pointed at. */
  function choose(run) {
    const list = el('dl', {}, ...names.flatMap((name, i) => [el('dt', {}, name), el('dd', {}, short(valuesOf(run)[i], 7))]));
    const close = el('button', {type: 'button', 'aria-label': 'close'}, '×');
    close.addEventListener('click', () => { chosen.hidden = true; mark(null); });
    chosen.replaceChildren(el('h3', {}, `Run ${run.number}`), close, ...(run.reason ? [el('p', {class: 'bad'}, `${run.outcome}: ${run.reason}`)] : []), list, leads(run));
    chosen.hidden = false;
    mark(run);
  }

  function mark(run) {
    for (const element of document.querySelectorAll('.chosen')) element.classList.remove('chosen');
    if (run) for (const element of document.querySelectorAll(`[data-run="${run.number}"]`)) element.classList.add('chosen');
  }

  /** To what the run has left. */
  function leads(run) {
    if (!run.folder) return el('p', {class: 'note'}, `Not recorded. It takes ${short(run.seconds, 2)} s; give its point again, with record=True, for its recording.`);
    return el('p', {}, el('a', {href: run.folder}, 'recording'), ...(run.report ? [', ', el('a', {href: run.report}, 'report')] : []));
  }

  function header() {
    const counts = Object.entries(sweep.outcomes).map(([outcome, count]) => `${count} ${outcome}`).join(', ');
    return el('header', {}, el('p', {class: 'eyebrow'}, 'Sweep'), el('h1', {}, sweep.title), el('p', {class: 'lead'}, `${sweep.runs.length} runs: ${counts}.`));
  }

  function keyFigures() {
    const {effort} = sweep;
    const figure = (value, text) => el('div', {}, el('strong', {}, value), el('span', {}, text));
    const figures = [];
    if (ranked.length > 0) {
      figures.push(figure(short(ranked[0].metrics[objective]), `${sweep.objective} of the best run, ${ranked[0].number}`));
      figures.push(figure(short(ranked[Math.floor((ranked.length - 1) / 2)].metrics[objective]), `${sweep.objective} of the run in the middle`));
    }
    if (effort.runs > 0) {
      figures.push(figure(`${short(effort.wall_s, 3)} s`, `for the last ${effort.runs} runs, on ${effort.workers} worker${effort.workers === 1 ? '' : 's'}`));
      if (effort.overhead !== null) figures.push(figure(percent(effort.overhead), 'of overhead over the runs’ own time'));
    }
    return el('div', {class: 'key'}, ...figures);
  }

  function row(run) {
    const button = el('button', {type: 'button', class: 'run'}, String(run.number));
    const made = el('tr', {'data-run': run.number}, el('td', {}, button), ...valuesOf(run).map((value) => el('td', {}, short(value))),
      el('td', {class: 'text'}, ...(run.folder ? [el('a', {href: run.report ?? run.folder}, run.report ? 'report' : 'recording')] : [run.outcome === 'done' ? '' : run.outcome])));
    made.addEventListener('click', () => choose(run));
    return made;
  }
  const table = (runs) => el('div', {class: 'scroll'}, el('table', {},
    el('thead', {}, el('tr', {}, el('th', {}, 'run'), ...names.map((name) => el('th', {}, name)), el('th', {}))),
    el('tbody', {}, ...runs.map(row))));

  function best() {
    if (ranked.length === 0) return el('section', {id: 'best'}, el('h2', {}, 'Best'), el('p', {class: 'bad'}, 'No run has a result.'));
    return el('section', {id: 'best'}, el('h2', {}, 'Best'), el('p', {class: 'note'}, `By ${sweep.objective}: the smaller the better.`), table(ranked.slice(0, kShown)));
  }

  /** Runs without a result, by their reasons. */
  function without() {
    const byReason = new Map();
    for (const run of sweep.runs) {
      if (run.outcome === 'done') continue;
      const kind = `${run.outcome}: ${run.reason}`.replace(/[\d.]+(e[-+]?\d+)?/g, '#');  // whatever the figures are
      byReason.set(kind, [...(byReason.get(kind) ?? []), run]);
    }
    if (byReason.size === 0) return null;
    const few = (runs) => runs.slice(0, 12).flatMap((run) => {
      const button = el('button', {type: 'button', class: 'run', 'data-run': run.number}, String(run.number));
      button.addEventListener('click', () => choose(run));
      return [button, ' '];
    });
    const reasons = [...byReason].sort((a, b) => b[1].length - a[1].length);
    return el('section', {id: 'without'}, el('h2', {}, 'Without result'), el('ul', {}, ...reasons.slice(0, 50).map(([, runs]) =>
      el('li', {}, `${runs.length} × `, el('span', {class: 'reason'}, `${runs[0].outcome}: ${runs[0].reason}`), el('br'), 'runs ', ...few(runs), runs.length > 12 ? '…' : ''))),
      ...(reasons.length > 50 ? [el('p', {class: 'note'}, `${reasons.length - 50} more reasons are in runs.csv.`)] : []));
  }

  function all() {
    const details = el('details', {id: 'all'}, el('summary', {}, 'All runs'));
    details.addEventListener('toggle', () => {
      if (!details.open || details.children.length > 1) return;
      details.append(table(sweep.runs.slice(0, kListed)));
      if (sweep.runs.length > kListed) details.append(el('p', {class: 'note'}, `The first ${kListed} of ${sweep.runs.length}; all of them are in runs.csv.`));
    });
    return details;
  }

  const parts = [header(), keyFigures(), best(), HeatMap.show(sweep, choose), Parallel.show(sweep, choose), without(), all(), chosen];
  document.getElementById('sweep').replaceChildren(...parts.filter(Boolean));
})();
