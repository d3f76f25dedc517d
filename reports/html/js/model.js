// The data of the page, which html/data.cpp writes, and functions on it. Except for reading the data, they do not
// use the document.

const data = JSON.parse(document.getElementById('data').textContent);
const text = (number) => data.strings[number];
const words = data.verdicts.map(([word]) => word);  // in addresses
const verdictNames = data.verdicts.map(([, name]) => name);
const FAIL = words.indexOf('fail'), WARNING = words.indexOf('quality-warning'), PASS = words.indexOf('pass');

// The indices of the fields of records and failures.
const VERDICT = 0, SEVERITY = 1, FLAGS = 2, MESSAGE = 3, BASELINE = 4, FACTS = 5, ACCURACY = 6, VIOLATED = 7, FAILURES = 8;
const UNEXPECTED = 1, KNOWN = 2, FLAKE = 4;  // bits of FLAGS
const CASE = 0, MESSAGE_OF_FAILURE = 1, WHAT = 2, EXPECTED = 3, CAPTURED = 4, EXACT = 5, CAPTURE = 6, DISTANCE = 7, CALLS = 8, PLOT = 9;

const tests = data.tests.map(([name, level, source, ...requirements], number) => ({
  number, name: text(name), theme: text(name).split('.')[0], level: data.levels[level], source: text(source), requirements}));
const testNamed = new Map(tests.map((test) => [test.name, test]));
const requirements = data.requirements.map(([id, section, rule, source, since], number) => ({
  number, id: text(id), section: text(section) || 'Not in the catalogue', rule: text(rule), source: text(source),
  since: text(since), documents: data.documentsOf[number].map((document) => data.documents[document]), tests: []}));
// Each requirement gets the tests that name it and those that found it violated.
for (const test of tests) {
  const its = new Set(test.requirements);
  for (const outcomes of data.outcomes)
    for (const number of data.violations[data.records[outcomes[test.number]]?.[VIOLATED]] || []) its.add(number);
  for (const number of its) requirements[number].tests.push(test);
}
const rules = new Map();  // the two halves of a requirement, "/1-D" and "/2-D", are one rule
for (const requirement of requirements) {
  const rule = requirement.id.split('/')[0];
  if (!rules.has(rule)) rules.set(rule, rules.size);
  requirement.ruleNumber = rules.get(rule);
}
const requirementNamed = new Map(requirements.map((requirement) => [requirement.id, requirement]));
const bugNamed = new Map(data.bugs.map((bug) => [bug.id, bug]));
for (const bug of data.bugs) {
  bug.documents = bug.documents.map((document) => data.documents[document]);
  bug.found = new Map(bug.found.map(([column, known, ...numbers]) => [column, {known, tests: numbers.map((number) => tests[number])}]));
}
const current = data.columns.length - data.earlier;  // number of current columns; the earlier results follow

const recordOf = (test, column) => data.records[data.outcomes[column][test.number]];

// The states that colour cells, worst first. Every unexpected result is BAD, even a pass.
const BAD = 0, EXPECTED_FAILURE = 1, NOTICE = 2, GOOD = 3, UNOBSERVED = 4;
const stateClasses = ['bad', 'known', 'notice', 'good', 'none'];
function stateOf(record) {
  if (record[FLAGS] & UNEXPECTED) return BAD;
  if (record[FLAGS] & KNOWN) return EXPECTED_FAILURE;
  if (record[VERDICT] === WARNING) return NOTICE;
  return record[VERDICT] === PASS ? GOOD : UNOBSERVED;
}
const stateOfRecord = Uint8Array.from(data.records, stateOf);

// The columns that are shown first: the current ones in which a test failed or gave a warning, or all if there is none.
const currentColumns = data.columns.map((_, column) => column).slice(0, current);
const remarkable = currentColumns.filter((column) => data.outcomes[column].some((record) => record >= 0 && stateOfRecord[record] < GOOD));
const firstColumns = remarkable.length ? remarkable : currentColumns;

// --- text search

let joined = null;  // all strings in lower case, one on each line
let starts = null;  // the offset of each line in `joined`
function stringsWith(needle) {
  if (!joined) {
    const lower = data.strings.map((string) => string.toLowerCase().replaceAll('\n', ' '));
    joined = lower.join('\n');
    starts = new Uint32Array(lower.length + 1);
    lower.forEach((string, i) => { starts[i + 1] = starts[i] + string.length + 1; });
  }
  const hits = new Uint8Array(data.strings.length);
  let line = 0;
  for (let at = joined.indexOf(needle); at >= 0; at = joined.indexOf(needle, starts[line + 1])) {
    let low = line, high = hits.length;  // the last line that starts at or before it
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (starts[middle] <= at) low = middle; else high = middle;
    }
    hits[line = low] = 1;
  }
  return hits;
}

// Returns for each test 1 if its name, a requirement of it, or its record in one of the columns contains the text.
function testsWith(needle, columns) {
  const hit = stringsWith(needle), out = new Uint8Array(tests.length);
  const calls = Uint8Array.from(data.calls, (lines) => lines.some((line) => hit[line]));
  const failures = Uint8Array.from(data.failures, (failure) => {
    for (let i = 0; i < CALLS; ++i) if (hit[failure[i]]) return 1;
    return calls[failure[CALLS]];
  });
  const records = Uint8Array.from(data.records, (record) => {
    for (let i = MESSAGE; i < VIOLATED; ++i) if (hit[record[i]]) return 1;
    for (let i = FAILURES; i < record.length; ++i) if (failures[record[i]]) return 1;
    return 0;
  });
  const requirementHits = Uint8Array.from(data.requirements, (fields) => fields.some((field) => hit[field]));
  for (const {number, requirements: ids} of tests) {
    out[number] = hit[data.tests[number][0]] || ids.some((id) => requirementHits[id]) ||
        columns.some((column) => records[data.outcomes[column][number]]);
  }
  return out;
}

// --- filters

const verdictFilters = {
  known: (record) => record[FLAGS] & KNOWN,
  flake: (record) => record[FLAGS] & FLAKE,
  ...Object.fromEntries(words.map((word, verdict) => [word, (record) => record[VERDICT] === verdict]))};

const isFiltered = (state) => Boolean(state.q.trim() || state.theme || state.verdict || state.level || state.differs || state.new);
const needlesOf = (state) => state.q.toLowerCase().split(/\s+/).filter(Boolean);

// Returns the tests that pass the filters, in the order of the run. The latest two results are kept, with and without
// the text, because most changes of the state do not change the filters.
const latestTests = new Map();
function matchingTests(state) {
  const filters = JSON.stringify([state.columns, state.q, state.theme, state.verdict, state.level, state.differs, state.new]);
  if (latestTests.has(filters)) return latestTests.get(filters);
  const outcomes = state.columns.map((column) => data.outcomes[column]);
  const filter = Uint8Array.from(data.records, (record) => Boolean(
      (!state.verdict || verdictFilters[state.verdict](record)) && (!state.new || record[FLAGS] & UNEXPECTED)));
  const found = needlesOf(state).map((needle) => testsWith(needle, state.columns));
  const matching = tests.filter((test) => {
    if (state.theme && test.theme !== state.theme) return false;
    if (state.level && test.level !== state.level) return false;
    if (found.some((hits) => !hits[test.number])) return false;
    let any = false, first = -1, differ = false;
    for (const records of outcomes) {
      const record = records[test.number];
      if (record < 0) continue;
      any ||= filter[record] === 1;
      const verdict = data.records[record][VERDICT];
      if (first < 0) first = verdict; else differ ||= verdict !== first;
    }
    return any && (differ || !state.differs);
  });
  if (latestTests.size === 2) latestTests.delete(latestTests.keys().next().value);
  latestTests.set(filters, matching);
  return matching;
}

// Returns the bugs of the chosen columns that pass the filters: those with a test that passes them, and those whose own
// text has the text, if one of their tests passes the other filters.
function matchingBugs(state) {
  const found = data.bugs.filter((bug) => state.columns.some(
      (column) => bug.found.has(column) && !(state.new && bug.found.get(column).known)));
  if (!isFiltered(state)) return found;
  const needles = needlesOf(state), others = new Set(needles.length ? matchingTests({...state, q: ''}) : []);
  const all = new Set(matchingTests(state));
  return found.filter((bug) => {
    const some = state.columns.flatMap((column) => bug.found.get(column)?.tests || []);
    return some.some((test) => all.has(test)) ||
        (needles.length > 0 && needles.every((needle) => textOfBug(bug).includes(needle)) && some.some((test) => others.has(test)));
  });
}

const textOfBug = (bug) => [bug.id, bug.title, bug.known, bug.knownIn, bug.clause, bug.cause, bug.realPrograms, ...bug.requirements,
                            ...data.calls[data.failures[bug.failure][CALLS]].map(text)].join(' ').toLowerCase();

// --- groups

const groupsBy = (items, keyOf) => {
  const groups = new Map();
  for (const item of items) {
    const key = keyOf(item);
    if (groups.has(key)) groups.get(key).push(item); else groups.set(key, [item]);
  }
  return groups;
};

function severityOf(test, columns) {
  let least = Infinity;
  for (const column of columns) least = Math.min(least, recordOf(test, column)?.[SEVERITY] ?? Infinity);
  return least;
}

function worstFirst(some, columns) {
  const severities = new Map(some.map((test) => [test, severityOf(test, columns)]));
  return [...some].sort((a, b) => severities.get(a) - severities.get(b));
}

// Returns the number of tests of a group in each state, in one column.
function statesOf(some, column) {
  const counts = [0, 0, 0, 0, 0], outcomes = data.outcomes[column];
  for (const {number} of some) if (outcomes[number] >= 0) ++counts[stateOfRecord[outcomes[number]]];
  return counts;
}

// Returns the verdict on a requirement in one column: the worst failure that violates it, otherwise a warning,
// otherwise a pass; not observed only if this holds for all tests. Tests that fail because of other requirements are
// ignored. Returns null without a test.
function verdictOn(requirement, some, column) {
  let worst = null, all = 0, hidden = 0;
  const counts = new Array(words.length).fill(0), knownFailures = [0, 0];
  for (const test of some) {
    const record = recordOf(test, column);
    if (!record) continue;
    const bad = record[VERDICT] <= FAIL, violated = bad && data.violations[record[VIOLATED]].includes(requirement.number);
    if (!violated && !test.requirements.includes(requirement.number)) continue;
    ++all;
    if (bad && !violated) {
      ++hidden;
      continue;
    }
    ++counts[record[VERDICT]];
    if (bad) ++knownFailures[record[FLAGS] & KNOWN ? 1 : 0];
    if (!worst || record[SEVERITY] < worst[SEVERITY]) worst = record;
  }
  if (!all) return null;
  if (!worst) return {verdict: -1, state: UNOBSERVED, known: false, n: hidden, of: all};
  const bad = knownFailures[0] + knownFailures[1] > 0;
  const verdict = bad || !(counts[WARNING] + counts[PASS]) ? worst[VERDICT] : counts[WARNING] ? WARNING : PASS;
  const known = bad && !knownFailures[0];
  const state = bad ? (known ? EXPECTED_FAILURE : BAD) : verdict === WARNING ? NOTICE : verdict === PASS ? GOOD : UNOBSERVED;
  return {verdict, state, known, n: counts[verdict], of: all};
}

// Returns the tests that neither passed nor failed: one entry for each verdict, reason and list of tests; columns with the
// same entry share it.
function unobserved(columns) {
  const groups = new Map();
  for (const column of columns) {
    const reasons = groupsBy(tests.filter((test) => {
      const record = recordOf(test, column);
      return record && record[VERDICT] > WARNING && record[VERDICT] < PASS;
    }), (test) => `${recordOf(test, column)[VERDICT]} ${recordOf(test, column)[MESSAGE]}`);
    for (const [reason, some] of reasons) {
      const key = `${reason} ${some.map((test) => test.number)}`;
      if (!groups.has(key)) {
        const record = recordOf(some[0], column);
        groups.set(key, {verdict: record[VERDICT], why: text(record[MESSAGE]) || 'no reason given', tests: some, columns: []});
      }
      groups.get(key).columns.push(column);
    }
  }
  return [...groups.values()].sort((a, b) => a.verdict - b.verdict || (a.why < b.why ? -1 : a.why > b.why ? 1 : 0));
}

const comparisonOf = (from, to) => data.comparisons.find((pair) => pair.from === from && pair.to === to);

// Returns the bugs that explain the test in any of the columns.
const bugsOf = (test, columns) =>
  data.bugs.filter((bug) => columns.some((column) => bug.found.get(column)?.tests.includes(test)));
