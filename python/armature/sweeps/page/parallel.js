// SPDX-License-Identifier: Apache-2.0
'use strict';
/** Parallel coordinates: an axis for each parameter and metric, a line for each run that has a result. */
const Parallel = (() => {
  const {el, svg, isNumber, short, numericAxis, colour, ranks} = Elements;
  const kWidth = 960, kHeight = 340, kTop = 44, kBottom = 26, kSide = 60;

  function axesOf(sweep, runs) {
    const names = [...sweep.parameters.map((parameter) => parameter.name), ...sweep.metrics];
    const count = sweep.parameters.length;
    const valueOf = (run, i) => (i < count ? run.parameters[i] : run.metrics[i - count]);
    return names.map((name, i) => {
      const values = runs.map((run) => valueOf(run, i));
      const axis = {name, metric: i >= count, value: (run) => valueOf(run, i), range: null};
      if (i >= count || sweep.parameters[i].numeric) {
        const numeric = numericAxis(values.filter(isNumber));
        return {...axis, ends: [short(numeric.least, 3), short(numeric.most, 3)], share: (run) => numeric.share(valueOf(run, i))};
      }
      const distinct = [...new Set(values)].sort();
      const last = Math.max(1, distinct.length - 1);
      return {...axis, ends: [distinct[0], distinct[distinct.length - 1]], share: (run) => distinct.indexOf(valueOf(run, i)) / last};
    });
  }

  function show(sweep, choose) {
    const objective = sweep.metrics.indexOf(sweep.objective);
    const runs = sweep.runs.filter((run) => run.metrics.every(isNumber));
    if (runs.length < 2) return null;
    runs.sort((a, b) => b.metrics[objective] - a.metrics[objective]);  // the best is drawn last, on top
    const axes = axesOf(sweep, runs);
    const scale = ranks(runs.map((run) => run.metrics[objective]));
    const gap = (kWidth - 2 * kSide) / Math.max(1, axes.length - 1);
    const placeOf = (axis, i) => (run) => [kSide + i * gap, kHeight - kBottom - axis.share(run) * (kHeight - kTop - kBottom)];
    const places = axes.map(placeOf);
    const lines = runs.map((run) => {
      const points = places.map((place) => place(run).map((x) => x.toFixed(1)).join(',')).join(' ');
      const line = svg('polyline', {points, stroke: colour(scale.share(run.metrics[objective])), 'data-run': run.number},
        svg('title', {}, `run ${run.number}: ${sweep.objective} ${short(run.metrics[objective])}`));
      line.addEventListener('click', () => choose(run));
      return {run, line};
    });
    const told = el('p', {class: 'note', id: 'kept', 'aria-live': 'polite'});
    const filter = () => {
      const kept = lines.filter(({run, line}) => {
        const keeps = axes.every(({range, share}) => !range || (share(run) >= range[0] && share(run) <= range[1]));
        line.classList.toggle('out', !keeps);
        return keeps;
      });
      told.textContent = kept.length === lines.length ? `${lines.length} runs have results.` : `${kept.length} of ${lines.length} runs are within the marked ranges. Click an axis to take its range away.`;
    };
    const picture = svg('svg', {viewBox: `0 0 ${kWidth} ${kHeight}`, class: 'parallel', role: 'img', 'aria-label': 'Parallel coordinates of all runs'},
      svg('g', {class: 'lines'}, ...lines.map(({line}) => line)), ...axes.map((axis, i) => axisPicture(axis, kSide + i * gap, i, gap < 120, filter)));
    filter();
    return el('section', {id: 'parallel'}, el('h2', {}, 'Parallel coordinates'),
      el('p', {class: 'note'}, 'A line is a run; bright ones are good. Drag along an axis to keep only the runs that pass through a range.'),
      el('div', {class: 'scroll'}, picture), told);
  }

  function axisPicture(axis, x, index, isCrowded, filter) {
    const length = kHeight - kTop - kBottom;
    const brush = svg('rect', {x: x - 7, width: 14, y: kTop, height: 0, class: 'brush'});
    const grip = svg('rect', {x: x - 14, width: 28, y: kTop, height: length, class: 'grip', 'data-axis': axis.name});
    const shareAt = (event) => {
      const place = grip.getBoundingClientRect();
      const share = 1 - (event.clientY - place.top) / place.height;
      return share < 0.02 ? 0 : share > 0.98 ? 1 : share;  // the ends are easily reached
    };
    let from = null;
    const mark = (a, b) => {
      axis.range = Math.abs(a - b) < 0.02 ? null : [Math.min(a, b), Math.max(a, b)];
      const [low, high] = axis.range ?? [0, 0];
      brush.setAttribute('y', kTop + (1 - high) * length);
      brush.setAttribute('height', (high - low) * length);
      filter();
    };
    grip.addEventListener('pointerdown', (event) => { from = shareAt(event); grip.setPointerCapture(event.pointerId); mark(from, from); });
    grip.addEventListener('pointermove', (event) => from !== null && mark(from, shareAt(event)));
    grip.addEventListener('pointerup', () => { from = null; });
    return svg('g', {class: axis.metric ? 'axis metric' : 'axis'}, svg('line', {x1: x, x2: x, y1: kTop, y2: kTop + length}), brush,
      svg('text', {x, y: isCrowded && index % 2 ? kTop - 32 : kTop - 19, 'text-anchor': 'middle', class: 'name'}, axis.name),
      svg('text', {x, y: kTop - 5, 'text-anchor': 'middle'}, axis.ends[1]),
      svg('text', {x, y: kTop + length + 15, 'text-anchor': 'middle'}, axis.ends[0]), grip);
  }

  return {show};
})();
