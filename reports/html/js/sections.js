// Functions that render the sections of the page from the state and the data.

const MOST_ROWS = 100, MOST_OPEN = 40;  // rows of a group; number of matching tests up to which groups are opened

const link = (at, ...children) => el('a', {href: fragmentOf(emptyState(), at)}, ...children);
const linkToTest = (test) => link(`open=${test.name}`, named(test.name));

// --- tables of groups and rows by implementation

// Returns a button that unfolds the rows below its own; `name` is the name in the set `set` of the state.
function toggle(set, name, open, ...children) {
  return el('button', {type: 'button', class: 'toggle', 'aria-expanded': String(open), 'data-key': `${set}=${name}`,
                       onclick: () => unfold(set, name, !open)}, ...children);
}

const headerCell = (column) => el('th', {scope: 'col'}, named(data.columns[column].replaceAll('-', '-/')).map(
    (part) => (typeof part === 'string' ? part.replaceAll('-/', '-') : part)));

function table(name, first, columns, bodies) {
  return el('div', {class: 'scroll', role: 'region', 'aria-label': name, tabindex: '0'},
            el('table', {class: 'grid', style: `--columns: ${columns.length}`},
               el('thead', null, el('tr', null, el('th', {scope: 'col'}, first), columns.map(headerCell))),
               bodies));
}

const wide = (columns, className, ...children) =>
  el('tr', {class: className}, el('td', {colspan: columns.length + 1}, el('div', {class: 'body'}, ...children)));

// Returns a cell of a column. On a phone, its label stands in the cell.
const cell = (column, className, ...children) => el('td', {class: className, 'data-label': data.columns[column]}, ...children);

// Returns a cell with the numbers of a group in each state, in the colour of the worst one.
function summaryCell(column, counts, noun) {
  const total = counts.reduce((sum, n) => sum + n, 0);
  if (!total) return cell(column, 'absent', `no ${noun}`);
  const [bad, known, notice, good, none] = counts;
  const parts = [bad && `${bad} new`, known && `${known} known`, notice && count(notice, 'warning')].filter(Boolean);
  const worst = bad ? 'bad' : known ? 'known' : notice ? 'notice' : good ? 'good' : 'none';
  if (!parts.length) parts.push(good ? 'pass' : 'not observed');
  const rest = good === total ? `${total}` : good && worst === 'good' ? `${good} of ${total}` : `of ${total}`;
  return cell(column, worst, parts.map((part, i) => [el('span', {class: 'part'}, i < parts.length - 1 ? `${part},` : part), ' ']),
            el('small', null, rest));
}

function testCell(test, column) {
  const record = recordOf(test, column);
  if (!record) return cell(column, 'absent', 'no test');
  const notes = notesOf(record);
  return cell(column, stateClasses[stateOf(record)], symbolOf(record[VERDICT]), ` ${verdictNames[record[VERDICT]]}`,
              notes.length ? el('small', null, ` ${notes.join(', ')}`) : null);
}

function requirementCell(requirement, tests, column) {
  const on = verdictOn(requirement, tests, column);
  if (!on) return cell(column, 'absent', 'no test');
  if (on.verdict < 0) return cell(column, 'none', 'not observed', el('small', null, ' other failures hide it'));
  const notes = [on.n < on.of ? `${on.n} of ${on.of}` : '', on.known ? 'known' : ''].filter(Boolean);
  return cell(column, stateClasses[on.state], symbolOf(on.verdict), ` ${verdictNames[on.verdict]}`,
              notes.length ? el('small', null, ` ${notes.join(', ')}`) : null);
}

// Returns true if the group is open. The default is open if its theme is chosen or if at most MOST_OPEN tests match;
// the groups in state.group are not in their default state.
function isOpen(group, matching) {
  const open = state.theme === group || (isFiltered(state) && matching.length <= MOST_OPEN) ||
      (matching.length && matching.length === tests.length && matching.length <= MOST_OPEN);
  return state.group.has(group) !== Boolean(open);
}

// Returns the row of a test, and a row with its evidence if it is open.
function testRows(test) {
  const {columns} = state, open = state.open.has(test.name);
  const records = columns.map((column) => recordOf(test, column)).filter(Boolean);
  const worst = records.reduce((a, b) => (b[SEVERITY] < a[SEVERITY] ? b : a));
  const message = worst[VERDICT] === PASS ? '' : text(worst[MESSAGE]).replace(/\s+/g, ' ');
  const row = el('tr', {class: 'test'},
                 el('th', {scope: 'row'}, toggle('open', test.name, open, named(test.name)),
                    message ? el('div', {class: 'headline'}, message) : null),
                 columns.map((column) => testCell(test, column)));
  return open ? [row, wide(columns, 'detail', evidence(test))] : [row];
}

// Returns the rows of the first items and of all open ones, and a button for more if there are any.
function rows(items, make, isItOpen) {
  const first = items.slice(0, MOST_ROWS), rest = items.slice(MOST_ROWS);
  const opened = rest.filter(isItOpen), closed = rest.filter((item) => !isItOpen(item));
  const shown = [...first, ...opened].flatMap(make);
  if (!closed.length) return shown;
  const line = wide(state.columns, 'more', el('button', {type: 'button', onclick: () => {
    const next = rows(closed, make, isItOpen);
    line.replaceWith(...next);
    next[0].querySelector('button').focus();
  }}, `Show ${Math.min(closed.length, MOST_ROWS)} more of ${closed.length}`));
  return [...shown, line];
}

function group(name, noun, cells, open, content) {
  return el('tbody', null,
            el('tr', {class: 'group'},
               el('th', {scope: 'rowgroup'}, toggle('group', name, open, named(name)), ' ', faint(noun)), cells),
            open ? content() : null);
}

function testsByTheme(matching) {
  const {columns} = state;
  return table('Tests by theme and implementation', 'Theme', columns,
               [...groupsBy(matching, (test) => test.theme)].map(([theme, some]) => group(
                   theme, count(some.length, 'test'), columns.map((column) => summaryCell(column, statesOf(some, column), 'test')),
                   isOpen(theme, matching),
                   () => rows(worstFirst(some, columns), testRows, (test) => state.open.has(test.name)))));
}

function requirementRows(requirement, some) {
  const {columns} = state, open = state.requirement.has(requirement.id);
  const row = el('tr', {class: 'requirement'},
                 el('th', {scope: 'row'}, toggle('requirement', requirement.id, open, requirement.id),
                    requirement.rule ? el('div', {class: 'headline'}, requirement.rule) : null),
                 columns.map((column) => requirementCell(requirement, some, column)));
  if (!open) return [row];
  return [row, wide(columns, 'detail',
                    sourceOf(requirement),
                    el('ul', {class: 'plain'}, testList(worstFirst(some, columns))))];
}

// Returns links to the tests, each with its verdicts.
function testList(list) {
  return limited(list, MOST_ROWS, (test) => {
    const chips = groupsBy(state.columns.filter((column) => recordOf(test, column)), (column) => {
      const record = recordOf(test, column);
      return `${record[VERDICT]} ${record[FLAGS]}`;
    });
    return el('li', null, linkToTest(test), ' ', [...chips.values()].map((columns) => [
      chip(recordOf(test, columns[0])), chips.size > 1 ? faint(` ${labels(columns)} `) : ' ']));
  });
}

function requirementsBySection(matching) {
  const {columns} = state, shown = new Set(matching);
  const found = requirements.map((requirement) => [requirement, requirement.tests.filter((test) => shown.has(test))])
      .filter(([, some]) => some.length);
  return table('Requirements by section and implementation', 'Requirement', columns,
               [...groupsBy(found, ([requirement]) => requirement.section)].map(([section, some]) => group(
                   section, count(some.length, 'requirement'),
                   columns.map((column) => {
                     const counts = [0, 0, 0, 0, 0];
                     for (const [requirement, its] of some) {
                       const on = verdictOn(requirement, its, column);
                       if (on) ++counts[on.state];
                     }
                     return summaryCell(column, counts, 'test');
                   }),
                   isOpen(section, matching),
                   () => rows(some, ([requirement, its]) => requirementRows(requirement, its),
                              ([requirement]) => state.requirement.has(requirement.id)))));
}

// --- bugs by implementation

// Returns true if the failures of the column were reduced to bugs, or if there are none.
function isSearched(column) {
  const records = data.outcomes[column].filter((record) => record >= 0).map((record) => data.records[record]);
  return data.bugs.some((bug) => bug.found.has(column)) ||
      (records.length > 0 && records.every((record) => record[VERDICT] > WARNING));
}

function bugCell(bug, column) {
  const found = bug.found.get(column);
  if (!found) return cell(column, 'good', 'not found');
  return cell(column, found.known ? 'known' : 'bad', el('span', {class: 'part'}, count(found.tests.length, 'test')), ' ',
              el('small', null, found.known ? 'known' : 'new'));
}

const listed = (documents) => documents.map(([name, address], i) => [i ? ', ' : '', outside(address, name)]);

// Returns the line with the source of a requirement and links to its documents; null if it has no source.
function sourceOf(requirement) {
  if (!requirement.source) return null;
  const {source, since, documents} = requirement;
  return el('p', null, faint(`Source: ${source}${since ? `, since ${since}` : ''}`), documents.length ? [' (', listed(documents), ')'] : null);
}

function requirementLine(id) {
  const known = requirementNamed.get(id);
  if (!known) return el('p', {class: 'rule'}, id);
  return el('div', {class: 'rule'}, known.tests.length ? link(`requirement=${id}`, id) : id, ' ', faint(known.section),
            known.rule ? [el('br'), known.rule] : null, sourceOf(known));
}

function bugDetails(bug) {
  const failure = data.failures[bug.failure], found = state.columns.filter((column) => bug.found.has(column));
  const lines = callsOf(failure);
  return [
    el('p', {class: 'tools'}, faint(`${bug.id}, level: ${data.levels[bug.level]}`), linkButton(`bug=${bug.id}`),
       lines.length ? copyButton('Copy reproducer', lines.join('\n')) : null),
    definitions([
      ['Known bug', bug.known], ['Affected', bug.affects || bug.knownIn],
      [bug.isSuspected ? 'Suspected cause' : 'Cause', bug.cause],
      ['Real programs', bug.realPrograms || (bug.breaksPrograms && 'a real program fails because of this bug')],
      ['Clause', bug.clause && el('span', null, bug.clause, bug.documents.length ? [' (', listed(bug.documents), ')'] : null)],
      ['Verified', bug.verified]]),
    bug.outside ? el('p', null, 'Explicit vertices instead of evaluations show the bug as well, so it is not only in the evaluator.') : null,
    bug.requirements.map(requirementLine),
    failureDetails(failure),
    bug.whyNotReduced ? el('p', null, `Not reduced to a minimal program: ${bug.whyNotReduced}. The calls are those of one failing case.`) : null,
    program('Program that shows the bug', bug.whyNotReduced && bug.example.length ? bug.example : lines, null),
    found.map((column) => fold({class: 'case'}, `${count(bug.found.get(column).tests.length, 'test')} of ${data.columns[column]}`,
                               () => el('ul', {class: 'plain'}, limited(bug.found.get(column).tests, MOST_ROWS,
                                                                        (test) => el('li', null, linkToTest(test), ' ', chip(recordOf(test, column)))))))];
}

// Returns the minimal program of the bug for the evidence of its tests, because their own cases may be long; null
// if there is none.
function reducedCase(bug) {
  const failure = data.failures[bug.failure], lines = callsOf(failure);
  if (bug.whyNotReduced || !lines.length) return null;
  return fold({class: 'case', open: true}, ['Reduced case ', faint('of the bug')],
              () => [failureDetails(failure), program('Program that shows the bug', lines, 'Copy reduced case')].filter(Boolean));
}

// Returns a sentence about the current columns without a bug; null if there is none.
function withoutBugs() {
  const others = currentColumns.filter((column) => !data.bugs.some((bug) => bug.found.has(column)));
  const searched = others.filter(isSearched), rest = others.filter((column) => !isSearched(column));
  const sentences = [searched.length && `No bug was found in: ${labels(searched)}.`, rest.length && `Not searched: ${labels(rest)}.`];
  return others.length ? el('p', null, faint(sentences.filter(Boolean).join(' '))) : null;
}

function bugTable() {
  const shown = matchingBugs(state), columns = state.columns.filter((column) => data.bugs.some((bug) => bug.found.has(column)));
  if (!shown.length) return [el('p', null, isFiltered(state) ? 'No bug matches the filters.' : 'No bug was found in these implementations.')];
  const notes = columns.filter((column) => data.bugNotes[column]);
  return [
    table('Bugs by implementation', count(shown.length, 'distinct bug') + ', most important first', columns,
          el('tbody', null, shown.map((bug) => {
            const open = state.bug.has(bug.id);
            return [el('tr', {class: 'bug'},
                       el('th', {scope: 'row'}, toggle('bug', bug.id, open, bug.title),
                          el('div', {class: 'headline'}, [verdictNames[bug.verdict], bug.requirements.join(', '), bug.knownIn && `known in ${bug.knownIn}`,
                                                          bug.breaksPrograms && 'breaks real programs'].filter(Boolean).join(' · '))),
                       columns.map((column) => bugCell(bug, column))),
                    open ? wide(columns, 'detail', bugDetails(bug)) : null];
          }))),
    withoutBugs(),
    notes.map((column) => el('p', null, faint(`${data.columns[column]}: ${data.bugNotes[column]}`)))].flat().filter(Boolean);
}

// Returns a sentence about the current columns that are not shown because nothing is wrong with them, with a button
// that shows them; null if there is none.
function foldedColumns() {
  const folded = currentColumns.filter((column) => !firstColumns.includes(column) && !state.columns.includes(column));
  if (!folded.length) return null;
  const passing = folded.filter((column) => data.outcomes[column].some((record) => record >= 0));
  const rest = folded.filter((column) => !passing.includes(column));
  const sentences = [passing.length && `Nothing failed in: ${labels(passing)}.`, rest.length && `Not judged: ${labels(rest)}.`];
  return el('p', {class: 'tools'}, faint(sentences.filter(Boolean).join(' ')),
            el('button', {type: 'button', class: 'copy', onclick: () => showColumns([...state.columns, ...folded])}, 'Show them'));
}

// --- the evidence of a test

function definitions(pairs) {
  const shown = pairs.filter(([, value]) => value && String(value) !== '');
  return shown.length ? el('dl', null, shown.map(([term, value]) => [el('dt', null, term), el('dd', null, value)])) : null;
}

const code = (string) => (string ? el('code', null, string) : '');

function callsOf(failure) {
  return data.calls[failure[CALLS]].map(text);
}

function program(name, lines, button) {
  if (!lines.length) return null;
  return el('div', {class: 'program'}, button ? copyButton(button, lines.join('\n')) : null,
            el('pre', {tabindex: '0', 'aria-label': name}, el('code', null, lines.join('\n'))));
}

function failureDetails(failure) {
  const [message, expected, captured] = [MESSAGE_OF_FAILURE, EXPECTED, CAPTURED].map((field) => text(failure[field]));
  return definitions([['Message', message === expected ? '' : message], ['What', text(failure[WHAT])],
                      ['Expected', code(expected)],
                      ['Captured', captured ? el('code', null, markedDifferences(expected, captured)) : ''],
                      ['Exact', code(text(failure[EXACT]))], ['Capture', text(failure[CAPTURE])]]);
}

// Returns a failure. `above` is the failure before it; several failures of one case have the same calls.
function failureOf(number, above) {
  const failure = data.failures[number], lines = callsOf(failure);
  const same = above !== undefined && data.failures[above][CALLS] === failure[CALLS] && lines.length;
  return fold({class: 'case', open: above === undefined},
              [text(failure[CASE]) || 'this test', ' ', faint(text(failure[DISTANCE]))],
              () => [failureDetails(failure), plotOf(failure),
                     same ? el('p', null, 'The GL calls are those of the failure above.') :
                            program('GL calls of this case', lines, 'Copy calls')].flat().filter(Boolean));
}

const commandsOf = (test, column) =>
  data.commands[data.commandsOf[column][test.number]].map((command) => text(command).replaceAll('\u0000', test.name));

function commandLine(purpose, command, button) {
  return command ? el('p', {class: 'run'}, faint(`${purpose}: `), el('code', null, command), ' ', copyButton(button, command)) : null;
}

// Returns the requirements that the failure violates, and those of the test that are not observed because of it.
function violations(test, record) {
  if (record[VERDICT] > FAIL) return null;
  const ids = (numbers) => numbers.map((number, i) => [i ? ', ' : '', link(`requirement=${requirements[number].id}`, requirements[number].id)]);
  const violated = data.violations[record[VIOLATED]], hidden = test.requirements.filter((number) => !violated.includes(number));
  return [violated.length ? el('p', null, 'Violated: ', ids(violated)) : null,
          hidden.length ? el('p', null, 'Not observed because of this failure: ', ids(hidden)) : null];
}

// Returns one description for all columns with equal records.
function outcome(test, columns) {
  const record = recordOf(test, columns[0]), failures = record.slice(FAILURES);
  return el('section', {class: 'outcome'},
            el('h3', null, chip(record), ' ', labels(columns)),
            text(record[MESSAGE]) ? el('p', null, text(record[MESSAGE])) : null,
            text(record[BASELINE]) ? el('p', null, text(record[BASELINE])) : null,
            violations(test, record),
            text(record[FACTS]) ? el('p', null, faint(text(record[FACTS]))) : null,
            text(record[ACCURACY]) ? el('p', {class: 'faint'}, text(record[ACCURACY])) : null,
            failures.map((failure, i) => failureOf(failure, failures[i - 1])),
            columns.map((column) => {
              const [rerun, debug, reproducer] = commandsOf(test, column), whose = columns.length > 1 ? `, ${data.columns[column]}` : '';
              return [commandLine(`Run just this test${whose}`, rerun, 'Copy command'),
                      commandLine(`Open it in a debugger${whose}`, debug, 'Copy command'),
                      commandLine(`Make a C program of it${whose}`, reproducer, 'Copy reproducer')];
            }));
}

const linkButton = (at) => copyButton('Copy link', () => new URL(fragmentOf(state, at), location.href).href);

// Returns "suites/map_errors.cpp:34", as a link if the page knows the place of the sources.
const sourceFile = (place) => (data.sources ? outside(`${data.sources}/${place.replace(/:\d+$/, '')}`, place) : place);

function evidence(test) {
  const alike = groupsBy(state.columns.filter((column) => recordOf(test, column)),
                         (column) => data.outcomes[column][test.number]);
  const all = [...alike.values()].sort((a, b) => recordOf(test, a[0])[SEVERITY] - recordOf(test, b[0])[SEVERITY]);
  return [
    el('p', {class: 'tools'}, faint(`Level: ${test.level} `),
       test.source ? el('span', null, faint('Source: '), sourceFile(test.source)) : null, linkButton(`open=${test.name}`)),
    bugsOf(test, state.columns).map((bug) => [el('p', null, 'Bug: ', link(`bug=${bug.id}`, bug.title)), reducedCase(bug)]),
    test.requirements.map((number) => requirementLine(requirements[number].id)),
    all.map((columns) => outcome(test, columns))];
}

// --- changes

function changesOf(pair) {
  const groups = new Map();
  for (let i = 0; i < pair.changes.length; i += 3) {
    const [test, kind, extra] = pair.changes.slice(i, i + 3);
    if (!groups.has(kind)) groups.set(kind, []);
    groups.get(kind).push({test: tests[test], extra: text(extra)});
  }
  return [...groups];
}

function changeLine(pair, {test, extra}) {
  const before = recordOf(test, pair.from), now = recordOf(test, pair.to);
  const message = extra ? `in more cases: ${extra}` : text((now || before)[MESSAGE]).replace(/\s+/g, ' ');
  return el('li', null, linkToTest(test), ' ', before ? chip(before) : faint('no test'), ' → ', now ? chip(now) : faint('no test'),
            message && now?.[VERDICT] !== PASS ? el('div', {class: 'headline'}, message) : null);
}

function changes(from, to) {
  const pair = comparisonOf(from, to);
  if (!pair) return [el('p', null, faint('Choose two different implementations.'))];
  return [
    el('p', null, el('strong', null, pair.headline)),
    pair.caveats.map((caveat) => el('p', null, caveat)),
    changesOf(pair).map(([kind, list]) => fold(
        {class: 'case', open: kind <= 2 && list.length <= MOST_OPEN / 2},
        el('span', {class: `chip ${kind < 2 ? 'bad' : kind === 2 ? 'good' : 'none'}`},
           `${list.length} ${data.changeKinds[kind][(pair.from < current ? 2 : 0) + (list.length === 1 ? 0 : 1)]}`),
        () => el('ul', {class: 'plain'}, limited(list, MOST_ROWS, (change) => changeLine(pair, change)))))].flat();
}

// --- tests that neither passed nor failed

function unobservedList() {
  return unobserved(state.columns).map((entry) => fold(
      {class: 'case'},
      [el('span', {class: 'chip none'}, symbolOf(entry.verdict), ` ${verdictNames[entry.verdict]}`),
       ` ${labels(entry.columns)}: ${entry.why} `, faint(`(${count(entry.tests.length, 'test')})`)],
      () => el('ul', {class: 'plain'}, limited(entry.tests, MOST_ROWS, (test) => el('li', null, linkToTest(test))))));
}
