// SPDX-License-Identifier: Apache-2.0
'use strict';
/** Two parameters as axes; each cell has the colour of its best run. */
const HeatMap = (() => {
  const {el, svg, isNumber, short, numericAxis, colour, ranks, select} = Elements;
  const kMostSteps = 24, kBins = 14;

  /** The steps of an axis: its values if they are few, else equal parts of its range. */
  function stepsOf(sweep, index) {
    const values = sweep.runs.map((run) => run.parameters[index]);
    const distinct = [...new Set(values)];
    const numeric = sweep.parameters[index].numeric;
    if (numeric) distinct.sort((a, b) => a - b);
    if (!numeric || distinct.length <= kMostSteps) {
      return {labels: distinct.map((value) => short(value)), of: (value) => distinct.indexOf(value)};
    }
    const axis = numericAxis(values);
    const labels = Array.from({length: kBins}, (_, i) => short(axis.at((i + 0.5) / kBins), 3));
    return {labels, of: (value) => Math.min(kBins - 1, Math.floor(axis.share(value) * kBins))};
  }

  /** Its runs, of each cell that has any, by `row * columns + column`. */
  function cellsOf(sweep, x, y, xSteps, ySteps) {
    const cells = new Map();
    for (const run of sweep.runs) {
      const at = ySteps.of(run.parameters[y]) * xSteps.labels.length + xSteps.of(run.parameters[x]);
      if (!cells.has(at)) cells.set(at, []);
      cells.get(at).push(run);
    }
    return cells;
  }

  function bestOf(runs, metric) {
    const having = runs.filter((run) => isNumber(run.metrics[metric]));
    return having.reduce((best, run) => (best && best.metrics[metric] <= run.metrics[metric] ? best : run), null);
  }

  function drawn(sweep, x, y, metric, choose) {
    const xSteps = stepsOf(sweep, x), ySteps = stepsOf(sweep, y);
    const columns = xSteps.labels.length, rows = ySteps.labels.length;
    const cells = cellsOf(sweep, x, y, xSteps, ySteps);
    const bests = new Map([...cells].map(([at, runs]) => [at, bestOf(runs, metric)]));
    const scale = ranks([...bests.values()].filter(Boolean).map((run) => run.metrics[metric]));
    const left = 92, top = 8, width = 900 - left, height = Math.min(460, Math.max(120, rows * 34));
    const w = width / columns, h = height / rows;
    const picture = svg('svg', {viewBox: `0 0 908 ${height + top + 58}`, role: 'img', class: 'heat',
      'aria-label': `${sweep.metrics[metric]} over ${sweep.parameters[x].name} and ${sweep.parameters[y].name}`});
    for (const [at, runs] of cells) {
      const column = at % columns, row = Math.floor(at / columns);
      const best = bests.get(at);
      picture.append(cell(left + column * w, top + (rows - 1 - row) * h, w, h, runs, best, metric, scale, sweep, choose));
    }
    const sparse = Math.ceil(columns / 12);
    xSteps.labels.forEach((label, i) => {
      if (i % sparse === 0) picture.append(svg('text', {x: left + (i + 0.5) * w, y: top + height + 18, 'text-anchor': 'middle'}, label));
    });
    const sparseRows = Math.ceil((rows * 14) / height);
    ySteps.labels.forEach((label, i) => {
      if (i % sparseRows === 0) picture.append(svg('text', {x: left - 8, y: top + (rows - i - 0.5) * h + 4, 'text-anchor': 'end'}, label));
    });
    picture.append(svg('text', {x: left + width / 2, y: top + height + 42, 'text-anchor': 'middle', class: 'axis'}, sweep.parameters[x].name),
      svg('text', {x: 12, y: top + height / 2, 'text-anchor': 'middle', class: 'axis', transform: `rotate(-90 12 ${top + height / 2})`}, sweep.parameters[y].name));
    return [picture, legend(sweep.metrics[metric], scale, [...bests.values()].some((best) => !best))];
  }

  function cell(x, y, w, h, runs, best, metric, scale, sweep, choose) {
    const shown = best ?? runs[0];
    const text = best ? `${sweep.metrics[metric]} ${short(best.metrics[metric])}, run ${best.number}` : `${runs[0].outcome}: ${runs[0].reason}`;
    const share = best ? scale.share(best.metrics[metric]) : 1;
    const made = svg('g', {class: 'cell', tabindex: 0, 'data-run': shown.number, role: 'button', 'aria-label': text},
      svg('title', {}, runs.length > 1 ? `${text}; the best of ${runs.length} runs` : text),
      svg('rect', {x: x + 1, y: y + 1, width: Math.max(1, w - 2), height: Math.max(1, h - 2), rx: 2,
        ...(best ? {fill: colour(share)} : {class: 'without'})}));
    if (w >= 48 && h >= 18 && best) {
      made.append(svg('text', {x: x + w / 2, y: y + h / 2 + 4, 'text-anchor': 'middle', style: `fill: ${share < 0.45 ? '#111' : '#fff'}`}, short(best.metrics[metric], 3)));
    }
    made.addEventListener('click', () => choose(shown));
    made.addEventListener('keydown', (event) => event.key === 'Enter' && choose(shown));
    return made;
  }

  function legend(name, scale, hasWithout) {
    const bar = el('span', {class: 'ramp', style: `background: linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map(colour).join(', ')})`});
    return el('p', {class: 'ramp-line'}, `${name}: best ${short(scale.least)} `, bar, ` worst ${short(scale.most)}, median ${short(scale.middle)}. Colours follow the rank.`,
      ...(hasWithout ? [' ', el('span', {class: 'without-key'}), ' no result']: []));
  }

  /** @param choose  is told the run that is clicked */
  function show(sweep, choose) {
    const varied = sweep.parameters.map((_, i) => i).filter((i) => new Set(sweep.runs.map((run) => run.parameters[i])).size > 1);
    if (varied.length < 2 || sweep.metrics.length === 0) return null;
    let [x, y] = varied, metric = Math.max(0, sweep.metrics.indexOf(sweep.objective));
    const picture = el('div', {class: 'scroll'});
    const redraw = () => picture.replaceChildren(...drawn(sweep, x, y, metric, choose));
    const names = sweep.parameters.map((parameter) => parameter.name);
    redraw();
    return el('section', {id: 'heat-map'}, el('h2', {}, 'Heat map'),
      el('p', {class: 'note'}, 'Each cell shows the best of its runs, over all values of the other parameters. Choose a cell to see its run.'),
      el('p', {class: 'choices'}, select('across', names, x, (i) => { x = i; redraw(); }), select('up', names, y, (i) => { y = i; redraw(); }),
        select('colour', sweep.metrics, metric, (i) => { metric = i; redraw(); })), picture);
  }

  return {show, stepsOf, cellsOf, bestOf};
})();
