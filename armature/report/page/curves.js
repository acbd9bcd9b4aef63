// SPDX-License-Identifier: Apache-2.0
'use strict';
/** Curves over time, with the moments at which something happened marked on them. */
const Curves = (() => {
  const {el, isNumber, mark} = Elements;
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(name).trim();

  const plots = [];  // all over the same time
  let following = false;

  /** Whoever is zoomed takes the others along. */
  function follow(leader, key) {
    if (key !== 'x' || following || !leader.settled) return;
    following = true;
    const {min, max} = leader.scales.x;
    for (const plot of plots) if (plot !== leader) plot.setScale('x', {min, max});
    following = false;
  }

  const padded = {min: {pad: 0.1, soft: 0, mode: 3}, max: {pad: 0.1, soft: 0, mode: 3}};

  /** A curve of report.json's page data: differences of whole numbers, `per` of them to the unit. */
  function unpacked({t, v, per}) {
    const summed = (differences, by) => {
      let sum = 0;
      return differences.map((each) => (each === null ? null : (sum += each) / by));
    };
    return {t: summed(t, 1e4), v: summed(v, per)};
  }

  // --- moments -----------------------------------------------------------------------------------

  const markFont = '11px system-ui, sans-serif';
  const markRow = 13;
  const grave = {armed: '--good', fault: '--bad', 'E-stop': '--bad'};

  const mostRows = 3;
  const measure = document.createElement('canvas').getContext('2d');
  measure.font = markFont;
  const widthOf = (text) => measure.measureText(text).width;

  /** In which of the rows each label has room; the last takes what has none. */
  function rowsOf(labels, rows) {
    const ends = [];
    return labels.map(({left, right}) => {
      let row = ends.findIndex((end) => end < left);
      if (row < 0) row = Math.min(ends.length, rows - 1);
      ends[row] = Math.max(ends[row] ?? 0, right + 6);
      return row;
    });
  }

  /** Where the labels of the moments in sight stand, in CSS pixels within the plot. */
  function labelsOf(moments, width, min, max) {
    const slack = (max - min) / 200;  // a run ends with its disarming, just behind the last sample
    return moments.filter(({time_s: t}) => t >= min - slack && t <= max + slack).map((moment) => {
      const x = Math.max(0, Math.min(width, width * (moment.time_s - min) / (max - min)));
      const left = Math.max(0, Math.min(x - widthOf(moment.kind) / 2, width - widthOf(moment.kind)));
      return {moment, x, left, right: left + widthOf(moment.kind)};
    });
  }

  function drawMoments(u, moments, most) {
    const {ctx, bbox: {left, top, width, height}} = u;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.font = markFont.replace('11', String(11 * ratio));
    ctx.textBaseline = 'bottom';
    ctx.textAlign = 'left';
    const {min, max} = u.scales.x;
    const labels = labelsOf(moments, width / ratio, min, max);
    const rows = rowsOf(labels, most);
    labels.forEach(({moment, x, left: from}, i) => {
      const own = color(grave[moment.kind] ?? '--soft');
      const place = Math.round(left + x * ratio);
      ctx.strokeStyle = moment.stroke ? color(moment.stroke) : own;
      ctx.lineWidth = ratio;
      ctx.setLineDash([4 * ratio, 3 * ratio]);
      ctx.beginPath();
      ctx.moveTo(place, top - (rows[i] * markRow + 1) * ratio);
      ctx.lineTo(place, top + height);
      ctx.stroke();
      ctx.fillStyle = own;
      ctx.fillText(moment.kind, left + from * ratio, top - (rows[i] * markRow + 2) * ratio);
    });
    ctx.restore();
  }

  /** The rows that all labels need when everything is in sight, which is when they are closest. */
  function rowsNeeded(moments, width, lines) {
    const ends = lines.flatMap((line) => (line.t.length > 0 ? [line.t[0], line.t.at(-1)] : []));
    const labels = labelsOf(moments, width, Math.min(...ends), Math.max(...ends));
    return labels.length === 0 ? 0 : Math.max(...rowsOf(labels, mostRows)) + 1;
  }

  // --- curves ------------------------------------------------------------------------------------

  /**
   * @param lines    [{label, stroke: CSS variable, broad, t, v}]
   * @param moments  [{time_s, kind, stroke: of the run that it is of, if the curves are of several}], by their time
   */
  function plot(parent, {title, unit, lines, moments = [], scale = 1, digits = 4, height = 230}) {
    const outputs = lines.map(() => el('output', {}, ''));
    const legend = el('div', {class: 'legend'});
    const marked = moments.map(({kind, time_s: t}) => `, ${kind} at ${mark(t)} s`).join('');
    const canvas = el('div', {class: 'canvas', role: 'img', 'aria-label': `${title}, ${unit} over time${marked}`});
    parent.append(el('div', {class: 'plot'},
      el('div', {class: 'head'}, el('h3', {}, title, ' ', el('span', {class: 'unit'}, unit)), legend), canvas));
    const tables = lines.map((line) => [line.t, line.v.map((v) => (v === null ? null : v * scale))]);
    const joined = tables.length > 1 ? uPlot.join(tables) : tables[0];
    const tall = canvas.clientHeight || height;
    const axis = (more) => ({stroke: () => color('--faint'), font: '12px system-ui, sans-serif',
      grid: {stroke: () => color('--grid'), width: 1}, ticks: {show: false}, ...more});
    const rows = rowsNeeded(moments, (canvas.clientWidth || 400) - 74, lines);
    const made = new uPlot({
      width: canvas.clientWidth || 400, height: tall,
      legend: {show: false},
      scales: {x: {time: false}, y: {range: (u, min, max) => (min === max ? [(min ?? 0) - 1, (max ?? 0) + 1] : uPlot.rangeNum(min, max, padded))}},
      padding: [Math.max(8, 3 + markRow * rows), 22, 0, 0],
      cursor: {sync: {key: 'time'}, points: {size: 5}, y: false, drag: {x: true, y: false, dist: 4}},
      axes: [axis({size: 26, space: 60, values: (u, splits) => splits.map((s) => `${s} s`)}),
             axis({size: 52, space: tall < 160 ? 26 : 34, values: (u, splits) => splits.map(mark)})],
      series: [{}, ...lines.map((line) => ({
        label: line.label, stroke: () => color(line.stroke), width: line.broad ? 5 : 1.5, points: {show: false},
        // Few samples are those of a port that changes now and then, and holds its value.
        paths: line.t.length < 200 ? uPlot.paths.stepped({align: 1}) : undefined}))],
      hooks: {
        setScale: [follow],
        draw: [(u) => drawMoments(u, moments, Math.max(1, rows))],
        setCursor: [(u) => outputs.forEach((output, i) => {
          const value = u.cursor.idx === null || u.cursor.idx === undefined ? null : nearest(u, i + 1);
          output.textContent = value === null ? '' : value.toFixed(digits).replace('-', '−');
        })]},
    }, joined, canvas);
    lines.forEach((line, i) => {
      if (!line.label) return;
      const button = el('button', {'aria-pressed': 'true', title: 'show or hide'},
        el('i', {class: line.broad ? 'broad' : '', style: `border-color: var(${line.stroke})`}), line.label, outputs[i]);
      button.onclick = () => {
        const show = button.getAttribute('aria-pressed') === 'false';
        button.setAttribute('aria-pressed', show);
        made.setSeries(i + 1, {show});
        // A line without a label belongs to the one before: a limit has two.
        for (let next = i + 1; next < lines.length && !lines[next].label; ++next) made.setSeries(next + 1, {show});
      };
      legend.append(button);
    });
    new ResizeObserver(() => made.setSize({width: canvas.clientWidth, height: canvas.clientHeight})).observe(canvas);
    setTimeout(() => { made.settled = true; });
    plots.push(made);
    return made;
  }

  /** Curves that were thinned have values at times of their own. */
  function nearest(u, series) {
    const values = u.data[series];
    for (let off = 0; off < 40; ++off) {
      for (const i of [u.cursor.idx - off, u.cursor.idx + off]) if (isNumber(values[i])) return values[i];
    }
    return null;
  }

  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => plots.forEach((p) => p.redraw(false)));

  return {plot, unpacked};
})();
