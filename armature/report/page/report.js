// SPDX-License-Identifier: Apache-2.0
'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const root = document.getElementById('report');
  const {el, isNumber, short, mark, whole, duration, seconds} = Elements;
  const {plot, unpacked} = Curves;
  const tracked = data.runs.filter((run) => run.joints.length > 0);
  const colorOf = new Map(tracked.map((run, i) => [run, `--run-${i % 6}`]));

  // --- tables ------------------------------------------------------------------------------------

  function table(columns, rows) {
    const head = el('tr', {}, ...columns.map(([name, unit, kind]) =>
      el('th', kind ? {class: kind} : {}, name, ...(unit ? [el('small', {}, unit)] : []))));
    return el('div', {class: 'scroll'}, el('table', {}, el('thead', {}, head), el('tbody', {}, ...rows)));
  }
  const row = (cells, attributes = {}) => el('tr', attributes, ...cells.map((cell) =>
    cell instanceof Node && cell.nodeName === 'TD' ? cell : el('td', {}, cell)));
  const section = (title, note) => {
    const made = el('section', {}, el('h2', {}, title));
    if (note) made.append(el('p', {class: 'note'}, note));
    root.append(made);
    return made;
  };
  const named = (run) => el('td', {}, el('span', {class: 'dot', style: `background: var(${colorOf.get(run)})`}), run.name);

  // --- the page's parts --------------------------------------------------------------------------

  function begin() {
    const runs = data.runs.map((run) => run.name).filter((name) => name !== data.name);
    root.append(el('header', {}, el('p', {class: 'eyebrow'}, 'Armature report'), el('h1', {}, data.title),
      el('p', {class: 'lead'}, runs.length > 0 ? `${data.name}: ${runs.join(', ')}` : data.name)));
    if (data.what_if) root.append(el('p', {class: 'note'}, whatIf(data.what_if)));
    if (tracked.length > 0) keyFigures();
  }

  /** What the runs of a replay with changes have to do with each other. */
  const whatIf = ({changes, only = []}) => `What if: ${changes.join(', ')}. “was” is what was recorded. ` + (only.length > 0
    ? `“what-if” is what ${only.join(', ')} alone would have said with these changes to what was recorded: nothing follows it, ` +
      'so positions and errors are what they were.'
    : '“what-if” is the same run with these changes, simulated anew with its plant: what operators and scripts did is done at the same times.');

  /** Errors are shown in mrad, unless they are large. */
  const largest = Math.max(0, ...tracked.flatMap((run) => run.joints.map((joint) => joint.max_abs_error_rad)));
  const [angle, scale] = largest < 0.1 ? ['mrad', 1e3] : ['rad', 1];

  /** The worst joint of each run, at one look. */
  function keyFigures() {
    const worst = (run, figure) => Math.max(...run.joints.map((joint) => Math.abs(joint[figure])));
    root.append(el('div', {class: 'key'}, ...tracked.slice(0, 4).flatMap((run) => [
      ['iae', `${angle} s`, 'integral of |error|'], ['max_abs_error_rad', angle, 'largest error'],
    ].map(([figure, unit, says]) => el('div', {style: `border-color: var(${colorOf.get(run)})`},
      el('strong', {}, `${short(worst(run, figure) * scale)} `, el('small', {}, unit)),
      el('span', {}, `${run.name}: ${says}, worst joint`))))));
  }

  function toReach() {
    if (!data.to_reach) return;
    const part = section('What is to be reached');
    part.append(table([['', ''], ['found', ''], ['bound', ''], ['', '', 'text']], data.to_reach.map((goal) => {
      const [unit, by] = goal.unit === 'rad' ? ['mrad', 1e3] : [goal.unit, 1];
      const bound = isNumber(goal.most) ? `at most ${mark(goal.most * by)}` : `at least ${mark(goal.least * by)}`;
      return row([el('td', {class: 'long'}, goal.name), isNumber(goal.value) ? `${short(goal.value * by)} ${unit}` : 'not measured', `${bound} ${unit}`,
        el('td', {class: `text ${goal.reached ? 'good' : 'bad'}`}, goal.reached ? 'reached' : 'not reached')]);
    })));
  }

  const jointNames = [...new Set(tracked.flatMap((run) => run.joints.map((joint) => joint.joint)))];
  const jointOf = (run, name) => run.joints.find((joint) => joint.joint === name);
  const grid = (parent, count) => {
    const made = el('div', {class: count > 1 ? 'plots' : 'plots single'});
    parent.append(made);
    return made;
  };

  function errors() {
    const part = section('Position error', 'Desired minus measured position. ');
    part.lastChild.append(el('span', {class: 'fine'}, 'Drag over a stretch to see it closely, in all curves; double-click for all of it.'));
    const parent = grid(part, jointNames.length);
    for (const name of jointNames) {
      const lines = tracked.filter((run) => jointOf(run, name)).map((run) => ({
        label: run.name, stroke: colorOf.get(run), ...unpacked(jointOf(run, name).curves.error)}));
      plot(parent, {title: `Joint ${name}`, unit: angle, scale, digits: 3, lines, moments: momentsOf(tracked.filter((run) => jointOf(run, name)))});
    }
  }

  function figures() {
    const part = section('How well the joints follow',
      'While the joints were armed. At rest: the largest error from two seconds after a motion on. Counts are the encoder’s.');
    const kinds = [['iae', 'IAE', `${angle} s`, scale], ['itae', 'ITAE', `${angle} s²`, scale], ['ise', 'ISE', `${angle}² s`, scale ** 2],
                   ['itse', 'ITSE', `${angle}² s²`, scale ** 2], ['max_abs_error_rad', 'largest', angle, scale],
                   ['final_error_rad', 'final', angle], ['final_error_counts', 'final', 'counts'], ['at_rest_error_counts', 'at rest', 'counts']];
    const rows = jointNames.flatMap((name) => {
      const runs = tracked.filter((run) => jointOf(run, name));
      return runs.map((run, i) => {
        const joint = jointOf(run, name);
        const cells = kinds.map(([kind, , , by]) => {
          const best = by && runs.length > 1 && isNumber(joint[kind]) &&
            runs.every((other) => !(Math.abs(jointOf(other, name)[kind]) <= Math.abs(joint[kind])) || other === run);
          return el('td', best ? {class: 'best'} : {}, by ? short(joint[kind] * by) : small(joint[kind], kind.endsWith('counts') ? 1 : scale));
        });
        return row([el('td', {}, i === 0 ? `Joint ${name}` : ''), Object.assign(named(run), {className: 'text'}), ...cells],
          i === 0 ? {class: 'first'} : {});
      });
    });
    part.append(table([['', ''], ['', '', 'text'], ...kinds.map(([, title, unit]) => [title, unit])], rows));
    const moved = tracked.flatMap((run) => run.joints.filter((j) => j.moved_arming_rad > 1e-3)
      .map((j) => `${run.name}, joint ${j.joint}: ${short(j.moved_arming_rad * scale)} ${angle}`));
    if (moved.length > 0) part.append(el('p', {class: 'note'}, `Moved while the joints were being armed: ${moved.join('; ')}.`));
    const missing = tracked.flatMap((run) => run.joints.filter((j) => j.samples_missing > 0)
      .map((j) => `${run.name}, joint ${j.joint}: ${whole(j.samples_missing)} of ${whole(j.samples + j.samples_missing)}`));
    if (missing.length > 0) part.append(el('p', {class: 'note bad'}, `Samples missing, for which the one before stands: ${missing.join('; ')}.`));
  }
  /** What is next to nothing is 0. */
  const small = (value, by) => (isNumber(value) ? (value * by).toFixed(3).replace('-', '−').replace(/^−?0\.000$/, '0') : '–');

  function positions() {
    const part = section('Position', 'Desired and measured.');
    if (data.what_if) return positionsTogether(part);
    for (const run of tracked) {
      part.append(el('p', {class: 'eyebrow', style: 'margin: 18px 0 0'}, run.name));
      const parent = grid(part, run.joints.length);
      for (const joint of run.joints) {
        plot(parent, {title: `Joint ${joint.joint}`, unit: 'rad', moments: run.moments, lines: [
          {label: 'desired', stroke: '--desired', broad: true, ...unpacked(joint.curves.desired)},
          {label: 'measured', stroke: colorOf.get(run), ...unpacked(joint.curves.measured)}]});
      }
    }
  }

  /** What was beside what would have been. */
  function positionsTogether(part) {
    const parent = grid(part, jointNames.length);
    for (const name of jointNames) {
      const runs = tracked.filter((run) => jointOf(run, name));
      plot(parent, {title: `Joint ${name}`, unit: 'rad', moments: momentsOf(runs), lines: [
        {label: 'desired', stroke: '--desired', broad: true, ...unpacked(jointOf(runs[0], name).curves.desired)},
        ...runs.map((run) => ({label: run.name, stroke: colorOf.get(run), ...unpacked(jointOf(run, name).curves.measured)}))]});
    }
  }

  function velocities() {
    const desired = (run, joint) => (tracked.length > 1 ? [] :
      [{label: 'desired', stroke: '--desired', broad: true, ...unpacked(joint.curves.desired)}]);
    limited('Velocity', 'Measured, and the most that is allowed.', 'velocities',
      (run, joint) => [...desired(run, joint), {label: run.name, stroke: strokeOf(run), ...unpacked(joint.curves.measured)}],
      (joint) => ({unit: 'rad/s', largest: joint.largest_rad_s, limit: joint.limit_rad_s}));
  }

  function efforts() {
    limited('Effort', 'What drove the joints, and the most that was allowed.', 'efforts',
      (run, joint) => [{label: run.name, stroke: strokeOf(run), ...unpacked(joint.curve)}],
      ({unit, largest, limit}) => ({unit, largest, limit}));
  }

  const strokeOf = (run) => colorOf.get(run) ?? '--run-0';

  /** Curves of each joint between its limits, then how near they came. */
  function limited(title, note, kind, linesOf, figuresOf) {
    const runs = data.runs.filter((run) => run[kind].length > 0);
    if (runs.length === 0) return;
    const part = section(title, note);
    const names = [...new Set(runs.flatMap((run) => run[kind].map((joint) => joint.joint)))];
    const jointIn = (run, name) => run[kind].find((joint) => joint.joint === name);
    const parent = grid(part, names.length);
    for (const name of names) {
      const those = runs.filter((run) => jointIn(run, name));
      const {unit, limit} = figuresOf(jointIn(those[0], name));
      const lines = those.flatMap((run) => linesOf(run, jointIn(run, name)));
      plot(parent, {title: `Joint ${name}`, unit, digits: 2, moments: momentsOf(those), lines: [...lines, ...limitLines(limit, lines)]});
    }
    part.append(table([['', ''], ['', '', 'text'], ['largest', ''], ['limit', ''], ['of it', '']],
      names.flatMap((name) => runs.filter((run) => jointIn(run, name)).map((run, i) => {
        const {unit, largest, limit} = figuresOf(jointIn(run, name));
        return row([el('td', {}, i === 0 ? `Joint ${name}` : ''), Object.assign(named(run), {className: 'text'}),
          `${short(largest)} ${unit}`, isNumber(limit) ? `${mark(limit)} ${unit}` : '–',
          isNumber(limit) ? `${Math.round(100 * largest / limit)} %` : '–'], i === 0 ? {class: 'first'} : {});
      }))));
  }

  function limitLines(limit, lines) {
    const times = lines.flatMap((line) => (line.t.length > 0 ? [line.t[0], line.t.at(-1)] : []));
    if (!isNumber(limit) || times.length === 0) return [];
    const t = [Math.min(...times), Math.max(...times)];
    return [1, -1].map((sign) => ({label: sign > 0 ? 'limit' : '', stroke: '--limit', t, v: [sign * limit, sign * limit]}));
  }

  /** Of several runs: what they have in common once, of the others whose it is. */
  function momentsOf(runs) {
    const all = runs.flatMap((run) => run.moments.map((moment) => ({...moment, run})));
    all.sort((a, b) => a.time_s - b.time_s);
    const same = (a, b) => a.kind === b.kind && Math.abs(a.time_s - b.time_s) < 0.05;
    const first = all.filter((moment, i) => all.findIndex((other) => same(other, moment)) === i);
    return first.map((moment) => {
      const shared = runs.every((run) => run.moments.some((other) => same(other, moment)));
      return shared ? moment : {...moment, stroke: strokeOf(moment.run)};
    });
  }

  function timelines() {
    const runs = data.runs.filter((run) => run.timeline);
    if (runs.length === 0) return;
    const part = section('A cycle', 'What each component did, in the cycle of median length; time that others used in between is theirs. ');
    part.lastChild.append(el('span', {class: 'fine'}, 'Drag over a part to see it closely; double-click for all of it.'));
    for (const run of runs) {
      part.append(el('p', {class: 'eyebrow', style: 'margin: 16px 0 0'},
        `${run.name}: ${duration(run.timeline.length_us)}, one of ${whole(run.timeline.cycles)} cycles`), timeline(run.timeline));
    }
  }

  function timeline({lanes, end_us: end}) {
    const tracks = lanes.map(() => el('div', {class: 'track'}));
    const scale = el('div', {class: 'track'});
    const made = el('div', {class: 'timeline'});
    lanes.forEach((lane, i) => {
      const took = lane.bars.reduce((sum, bar) => sum + bar.length, 0);
      const says = lane.thread ? `${lane.component}, in thread ${lane.thread}` : lane.component;
      made.append(el('div', {class: 'lane'}, el('div', {class: 'name', title: says}, lane.component), tracks[i],
        el('div', {class: 'took'}, duration(took))));
    });
    made.append(el('div', {class: 'lane scale'}, el('div'), scale, el('div')));
    const show = (from, to) => {
      const percent = (us) => `${(100 * us / (to - from)).toFixed(3)}%`;
      lanes.forEach((lane, i) => tracks[i].replaceChildren(...lane.bars
        .filter((bar) => bar.begin + bar.length >= from && bar.begin <= to)
        .map((bar) => el('b', {title: `${duration(bar.length)}, from ${duration(bar.begin)} on`,
          style: `left: ${percent(bar.begin - from)}; width: ${percent(bar.length)}`}))));
      const step = stepOf((to - from) / 6);
      const first = Math.ceil(from / step - 1e-9);
      const marks = [];
      for (let k = first; k * step <= from + (to - from) * 0.97; ++k) {
        marks.push(el('span', {class: (k - first) % 2 === 1 ? 'fine' : '', style: `left: ${percent(k * step - from)}`},
          k === 0 ? '0' : `${mark(k * step)} µs`));
        tracks.forEach((track) => track.prepend(el('s', {style: `left: ${percent(k * step - from)}`})));
      }
      scale.replaceChildren(...marks);
      made.range = [from, to];
    };
    show(0, end);
    selectable(made, scale, (from, to) => show(...[from, to].map((share) => made.range[0] + share * (made.range[1] - made.range[0]))), () => show(0, end));
    return made;
  }

  /** The round step next to `raw`. */
  function stepOf(raw) {
    const power = 10 ** Math.floor(Math.log10(raw));
    return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= raw * (1 - 1e-9));
  }

  /** Calls `choose` with the part of `ruler`'s width over which somebody drags, `reset` at a double-click. */
  function selectable(area, ruler, choose, reset) {
    const shade = el('u', {hidden: ''});
    area.append(shade);
    let begin = null;
    const share = (event) => {
      const box = ruler.getBoundingClientRect();
      return Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    };
    area.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || event.pointerType === 'touch') return;
      begin = share(event);
      area.setPointerCapture(event.pointerId);
    });
    area.addEventListener('pointermove', (event) => {
      if (begin === null) return;
      const offset = ruler.offsetLeft - area.offsetLeft;
      const [from, to] = [begin, share(event)].sort((x, y) => x - y);
      shade.hidden = false;
      shade.style.left = `${offset + from * ruler.clientWidth}px`;
      shade.style.width = `${(to - from) * ruler.clientWidth}px`;
    });
    area.addEventListener('pointerup', (event) => {
      if (begin === null) return;
      const [from, to] = [begin, share(event)].sort((x, y) => x - y);
      begin = null;
      shade.hidden = true;
      if ((to - from) * ruler.clientWidth > 4) choose(from, to);
    });
    area.addEventListener('dblclick', reset);
  }

  function phases() {
    const runs = data.runs.filter((run) => run.phases);
    if (runs.length === 0) return;
    const part = section('The phases of a cycle',
      'Computing: the median of the traced cycles. On the bus: simulated time, the median of its cycles.');
    for (const run of runs) {
      part.append(el('p', {class: 'eyebrow', style: 'margin: 16px 0 0'}, run.name), table(
        [['phase', ''], ['here', 'µs'], ['of it computing', 'µs'], ['on the bus', 'µs'], [data.elsewhere || 'elsewhere', 'µs', 'wide']],
        run.phases.map((phase) => row([phase.name,
          ...[phase.us, phase.computing_us, phase.bus_us, phase.elsewhere_us].map((us) => short(us))]))));
    }
  }

  function busCycle() {
    if (!data.io) return;
    const part = section('The cycle on the bus', data.io.doc ?? '');
    const modes = Object.entries(data.io).filter(([, mode]) => isNumber(mode?.cycle_us ?? mode?.monolithic_cycle_us));
    const columns = [
      ['cycle', 'µs', (mode) => mode.cycle_us && short(mode.cycle_us, 4)],
      ['of it computed', 'µs', (mode) => mode.computing_us && short(mode.computing_us, 3)],
      ['hand-written loop', 'µs', (mode) => mode.monolithic_cycle_us && short(mode.monolithic_cycle_us, 4)],
      ['ratio', '', (mode) => mode.cycle_us && mode.monolithic_cycle_us && (mode.cycle_us / mode.monolithic_cycle_us).toFixed(4)],
      ['on the bus', 'µs', (mode) => mode.bus_us && short(mode.bus_us, 4)],
      ['frames on the wire', 'µs', (mode) => short(mode.wire_us, 4)],
      ['of wire + 90 µs', '', (mode, name) => name === 'synchronous' && mode.cycle_us && (mode.cycle_us / (mode.wire_us + 90)).toFixed(4)],
      ['load of the bus', '', (mode) => mode.period_us && `${Math.round(100 * mode.wire_us / mode.period_us)} %`],
    ].filter(([, , text]) => modes.some(([name, mode]) => text(mode, name)));
    part.append(table([['mode', ''], ...columns.map(([title, unit]) => [title, unit])],
      modes.map(([name, mode]) => row([name, ...columns.map(([, , text]) => text(mode, name) || '–')]))));
  }

  function health() {
    const part = section('Runs');
    for (const run of data.runs) part.append(oneRun(run));
  }

  function oneRun(run) {
    const made = el('div', {class: 'run'}, el('h3', {}, run.name));
    if (run.cut_off) made.append(el('p', {class: 'bad'}, 'The recording has no end, as after a crash; what is whole of it is shown.'));
    const s = run.summary;
    if (!s) {
      made.append(el('p', {class: 'note'}, 'No run.json: nothing is known of faults, of what was lost and of times. `armature run --out` leaves one.'));
      return made;
    }
    const pace = s.time === 'simulated' ? `${seconds(s.duration_s)} in simulated time, which took ${seconds(s.wall_time_s)}` : `${seconds(s.duration_s)} in real time`;
    made.append(el('p', {class: 'note'}, `${s.application}, ${s.components} components: ${pace}. End: ${s.end}.`));
    made.append(...troubles(s), ...happened(run));
    if (s.time === 'real') made.append(threads(s), ...granted(s));
    return made;
  }

  function troubles(s) {
    const found = [];
    if (s.faults > 0) found.push(`${s.faults} ${s.faults === 1 ? 'fault' : 'faults'}`);
    if (s.reactions > 0) found.push(`${s.reactions} safety ${s.reactions === 1 ? 'reaction' : 'reactions'}`);
    const skipped = s.threads.reduce((sum, thread) => sum + thread.cycles_skipped, 0);
    if (skipped > 0) found.push(`${whole(skipped)} cycles skipped`);
    for (const [name, counter] of Object.entries(s.counters)) {
      if (/[._](dropped|lost|not_written|missing|missed|late)/.test(name)) found.push(`${name} = ${whole(counter.value)}`);
    }
    const lines = s.complaints.map((c) => `${c.time_s.toFixed(3)} s, ${c.component}: ${c.message}`);
    const told = new Set(s.complaints.map((c) => c.component));
    lines.push(...s.casualties.filter((c) => !told.has(c.component)).map((c) => `${c.component} (${c.state}): ${c.reason}`));
    if (s.complaints_left_out > 0) lines.push(`and ${whole(s.complaints_left_out)} more`);
    const verdict = el('div', {}, found.length === 0 ? el('p', {class: 'good'}, 'No fault, no reaction, nothing lost.') : el('p', {class: 'bad'}, `${found.join(', ')}.`));
    const list = (some) => el('ul', {}, ...some.map((line) => el('li', {}, line)));
    const first = lines.slice(0, 4);  // the cause comes first, and takes others along
    if (first.length > 0) verdict.append(list(first));
    return lines.length <= 4 ? [verdict] : [verdict, el('details', {}, el('summary', {}, `${whole(lines.length - 4)} more`), list(lines.slice(4)))];
  }

  /** What the marks on the curves stand for. */
  function happened(run) {
    if (run.moments.length === 0) return [];
    const line = ({time_s: t, kind, told}) => el('li', {}, `${t.toFixed(3)} s, ${kind}`,
      el('small', {class: 'told'}, told.slice(0, 6).join('; '), told.length > 6 ? ` and ${told.length - 6} more` : ''));
    const more = run.moments_left_out > 0 ? [el('li', {}, `and ${whole(run.moments_left_out)} more, which no curve marks`)] : [];
    return [el('details', {}, el('summary', {}, `Marked: ${[...new Set(run.moments.map((moment) => moment.kind))].join(', ')}`),
      el('ul', {}, ...run.moments.map(line), ...more))];
  }

  function threads(s) {
    const periodic = s.threads.filter((thread) => thread.period_s);
    const rows = periodic.map((thread) => {
      const due = thread.cycles_due ?? 0;
      return row([thread.name, `${mark(thread.period_s * 1e3)} ms`, whole(thread.cycles_run), whole(thread.cycles_skipped),
        whole(Math.max(0, due - thread.cycles_run - thread.cycles_skipped)),
        ...[thread.cycle_us, thread.late_us].flatMap((d) => (d ? [duration(d.median), duration(d.p99_9), duration(d.most)] : ['–', '–', '–']))]);
    });
    return table([['thread', ''], ['period', ''], ['cycles run', ''], ['skipped', ''], ['unaccounted', ''],
      ['cycle', 'median'], ['', '99.9 %'], ['', 'most'], ['woke late', 'median'], ['', '99.9 %'], ['', 'most']], rows);
  }

  const granted = (s) => {
    const refused = s.verdict.flatMap((line) => line.refusals.map((why) => `${line.subject}: ${why}`));
    return refused.length === 0 ? [] : [el('p', {class: 'note', style: 'margin-top: 10px'}, `Not granted by this machine: ${[...new Set(refused)].join('; ')}.`)];
  };

  function others() {
    const runs = data.runs.filter((run) => run.others.length > 0);
    if (runs.length === 0) return;
    const part = section('Everything else that was recorded');
    for (const run of runs) {
      const details = el('details', {}, el('summary', {}, `${run.name}: ${run.others.length} signals`));
      const fill = () => {
        const parent = el('div', {class: 'multiples'});
        details.append(parent);
        for (const one of run.others) {
          const holder = el('div', {class: 'small', title: one.doc});
          parent.append(holder);
          plot(holder, {title: one.name, unit: one.unit, height: 120, moments: run.moments, lines: [{label: '', stroke: strokeOf(run), ...unpacked(one)}]});
        }
      };
      details.addEventListener('toggle', fill, {once: true});
      part.append(details);
      if (tracked.length === 0) details.open = true;
    }
  }

  begin();
  toReach();
  Found.show(data, section);
  if (tracked.length > 0) { errors(); figures(); positions(); }
  velocities();
  efforts();
  timelines();
  phases();
  busCycle();
  health();
  others();
  root.append(el('footer', {}, 'Made by armature report. This page is one file and loads nothing; its figures are in report.json.'));
})();
