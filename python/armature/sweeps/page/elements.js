// SPDX-License-Identifier: Apache-2.0
'use strict';
/** Elements of the page, numbers as people read them, axes and colours. */
const Elements = (() => {
  function fill(made, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  }
  const el = (tag, attributes = {}, ...children) => fill(document.createElement(tag), attributes, children);
  const svg = (tag, attributes = {}, ...children) =>
    fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);

  const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);

  /** Four digits that count; texts as they are. */
  function short(value, digits = 4) {
    if (typeof value === 'string') return value;
    if (!isNumber(value)) return '–';
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-4 || size >= 1e6) ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
    return text.replace(/-/g, '−');
  }

  /** On an axis, where of long texts, such as paths, only the end has room. */
  function mark(value) {
    const text = short(value, 3);
    return text.length > 14 ? `…${text.slice(-13)}` : text;
  }

  /** Numbers that span decades, all of one sign, are spread by their logarithm. */
  function numericAxis(values) {
    // Math.min(...values) has no room for the arguments of a hundred thousand runs.
    const least = values.reduce((a, b) => Math.min(a, b), Infinity);
    const most = values.reduce((a, b) => Math.max(a, b), -Infinity);
    const logarithmic = least > 0 && most / least > 20;
    const place = logarithmic ? Math.log : (x) => x;
    const back = logarithmic ? Math.exp : (x) => x;
    const from = place(least), span = place(most) - from;
    return {
      least, most, logarithmic,
      /** 0 to 1 from the least value to the most. */
      share: (value) => (span > 0 ? (place(value) - from) / span : 0.5),
      at: (share) => back(from + share * span),
    };
  }

  const kColours = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];  // viridis
  /** @param share  0, the best, is bright; 1 is dark */
  function colour(share) {
    const place = (1 - share) * (kColours.length - 1);
    const i = Math.min(kColours.length - 2, Math.floor(place));
    const mixed = kColours[i].map((from, c) => Math.round(from + (place - i) * (kColours[i + 1][c] - from)));
    return `rgb(${mixed.join(',')})`;
  }

  /** By rank: every colour has as many runs, whatever a few bad ones cost. */
  function ranks(values) {
    const sorted = values.filter(isNumber).sort((a, b) => a - b);
    return {
      least: sorted[0], middle: sorted[Math.floor((sorted.length - 1) / 2)], most: sorted[sorted.length - 1],
      share(value) {
        let low = 0, high = sorted.length;
        while (low < high) {
          const middle = (low + high) >> 1;
          if (sorted[middle] < value) low = middle + 1; else high = middle;
        }
        return sorted.length > 1 ? low / (sorted.length - 1) : 0;
      },
    };
  }

  function select(label, options, chosen, changed) {
    const made = el('select', {}, ...options.map((name, i) => el('option', {value: i}, name)));
    made.value = chosen;
    made.addEventListener('change', () => changed(Number(made.value)));
    return el('label', {}, label + ' ', made);
  }

  return {el, svg, isNumber, short, mark, numericAxis, colour, ranks, select};
})();
