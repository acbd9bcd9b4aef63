// SPDX-License-Identifier: Apache-2.0
'use strict';
/** What another program found of the runs, figures.json: curves, ways from above, pictures. */
const Found = (() => {
  const {el} = Elements;
  const strokes = ['--run-0', '--run-1', '--run-2', '--run-3', '--run-4', '--run-5'];
  const svg = (name, attributes, ...children) => {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  /** Lines of y over x with equal scales, y upwards. */
  function way({title, unit, lines}) {
    const xs = lines.flatMap((line) => line.x), ys = lines.flatMap((line) => line.y);
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const room = 0.05 * Math.max(right - left, high - low, 1e-9);
    const box = [left - room, -high - room, right - left + 2 * room, high - low + 2 * room];
    const drawn = lines.map((line, i) => svg('polyline', {
      points: line.x.map((x, k) => `${x},${-line.y[k]}`).join(' '), fill: 'none', 'vector-effect': 'non-scaling-stroke',
      style: `stroke: var(${strokes[i % strokes.length]}); stroke-width: 1.5px`}));
    const picture = svg('svg', {viewBox: box.join(' '), role: 'img', 'aria-label': title, style: 'width: 100%'}, ...drawn);
    const legend = el('div', {class: 'legend'}, ...lines.map((line, i) => el('span', {},
      el('span', {style: `display: inline-block; width: 14px; height: 3px; margin: 0 6px 3px 12px; background: var(${strokes[i % strokes.length]})`}), line.label)));
    return el('div', {class: 'plot'}, el('div', {class: 'head'}, el('h3', {}, title, ' ', el('span', {class: 'unit'}, unit)), legend), picture);
  }

  function pictures(all) {
    return all.map(({title, png}) => el('figure', {style: 'margin: 0'},
      el('img', {src: `data:image/png;base64,${png}`, alt: title, style: 'width: 100%; image-rendering: pixelated'}),
      el('figcaption', {class: 'note'}, title)));
  }

  function show(data, section) {
    if (data.curves || data.ways) {
      const parent = el('div', {class: 'plots'});
      section('What was found').append(parent);
      for (const one of data.curves ?? []) {
        Curves.plot(parent, {...one, digits: 3, lines: one.lines.map((line, i) => ({...line, stroke: strokes[i % strokes.length]}))});
      }
      parent.append(...(data.ways ?? []).map(way));
    }
    if (data.pictures) section('Pictures').append(el('div', {class: 'plots'}, ...pictures(data.pictures)));
  }

  return {show};
})();
