// SPDX-License-Identifier: Apache-2.0
'use strict';
/** Elements of the page, and numbers as people read them. */
const Elements = (() => {
  function el(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  }

  const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);

  /** Three digits that count, without an exponent where people read none. */
  function short(value, digits = 3) {
    if (!isNumber(value)) return '–';
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (size < 1e-4 || size >= 1e6) return times(value.toExponential(digits - 1));
    const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    return value.toLocaleString('en', {minimumFractionDigits: places, maximumFractionDigits: places,
      useGrouping: size >= 1e4}).replace('-', '−');
  }
  /** As on an axis, where 0.50 is 0.5. */
  const mark = (value) => String(Number(value.toPrecision(6))).replace('-', '−');
  const times = (text) => {
    const [mantissa, power] = text.split('e');
    const raised = String(Number(power)).replace(/[-\d]/g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻');
    return `${mantissa.replace('-', '−')}·10${raised}`;
  };
  const whole = (n) => n.toLocaleString('en');
  const duration = (us) => (us >= 1e6 ? `${short(us / 1e6)} s` : us >= 1e4 ? `${short(us / 1e3)} ms` : `${short(us)} µs`);
  const seconds = (s) => `${short(s, s >= 100 ? 4 : 3)} s`;

  return {el, isNumber, short, mark, whole, duration, seconds};
})();
