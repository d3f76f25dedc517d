// The main script of the page: it connects the sections with the filters, the address and the browser's history.

let state = emptyState();
let matching = [];

// --- rendering

// Replaces the content of a section and keeps the focus on the element with the same key.
function replace(id, ...content) {
  const section = byId(id), focused = section.contains(document.activeElement) && document.activeElement.dataset.key;
  section.replaceChildren(...content.flat(Infinity).filter(Boolean));
  if (focused) withKey(section, focused)?.focus({preventScroll: true});
}

const withKey = (within, key) => [...within.querySelectorAll('[data-key]')].find((item) => item.dataset.key === key);

function renderTests() {
  matching = matchingTests(state);
  const byRequirement = state.view === 'requirements';
  replace('table', foldedColumns(), !tests.length ? el('p', null, 'No test was recorded.') :
                   !matching.length ? el('p', null, 'No test matches the filters.') :
                   byRequirement ? requirementsBySection(matching) : testsByTheme(matching));
  const shown = new Uint8Array(rules.size);
  for (const test of matching) for (const number of test.requirements) shown[requirements[number].ruleNumber] = 1;
  const parts = [[matching.length, tests.length, 'tests'], [shown.reduce((sum, n) => sum + n, 0), rules.size, 'requirements']];
  if (data.bugs.length) parts.unshift([matchingBugs(state).length, data.bugs.length, 'bugs']);
  byId('filter-count').textContent = `${parts.map(([n, all, noun]) => `${n} of ${all} ${noun}`).join(', ')} shown`;
  fit();
}

// Renders everything that the filters act on.
function renderFiltered() {
  renderBugs();
  renderTests();
}

function showColumns(columns) {
  change({columns: [...columns].sort((a, b) => a - b)});
  render();
}

function renderForm() {
  for (const name of ['q', 'theme', 'verdict', 'level']) {
    const field = byId(`filter-${name}`);
    if (field.value !== state[name]) field.value = state[name];
  }
  byId('filter-differs').checked = state.differs;
  byId('filter-new').checked = state.new;
  for (const button of document.querySelectorAll('#views button'))
    button.setAttribute('aria-pressed', String(button.value === state.view));
  for (const box of document.querySelectorAll('.column-switch')) box.checked = state.columns.includes(Number(box.value));
}

// Returns the columns of the change view: the chosen ones, otherwise the first pair of earlier and current results.
function compared() {
  const from = data.columns.indexOf(state.from), to = data.columns.indexOf(state.to);
  if (from >= 0 && to >= 0) return [from, to];
  return data.earlier && data.since.length ? [data.comparisons[data.since[0]].from, data.comparisons[data.since[0]].to] : [from, to];
}

function renderChanges() {
  if (data.columns.length < 2) return;
  const [from, to] = compared();
  byId('from').value = from;
  byId('to').value = to;
  replace('change-list', from >= 0 && to >= 0 ? changes(from, to) : []);
}

function renderBugs() {
  if (data.bugs.length) replace('bug-table', bugTable());
  fit();
}

function renderUnobserved() {
  const any = state.columns.some((column) => data.outcomes[column].some((record) => stateOfRecord[record] === UNOBSERVED));
  byId('unobserved-section').hidden = !any;
  replace('unobserved-list', any ? fold(null, 'Reasons and tests', unobservedList) : []);
}

function render() {
  renderForm();
  renderChanges();
  renderFiltered();
  renderUnobserved();
}

// Marks tables that fit: they need no scrolling region, so that their headers can stay at the top of the window.
function fit() {
  for (const region of document.querySelectorAll('.scroll')) {
    region.classList.remove('fits');
    region.classList.toggle('fits', region.scrollWidth <= region.clientWidth);
  }
}

// --- the address

const VISITED = true;  // state of the entries of the history to which the page does not scroll again
let typed = false;  // true if the latest entry of the history is for a text that is being typed

function change(changes, typing = false) {
  Object.assign(state, changes);
  const address = fragmentOf(state);
  if (typing && typed) history.replaceState(VISITED, '', address);
  else history.pushState(VISITED, '', address);
  typed = typing;
}

function unfold(set, name, open) {
  const names = new Set(state[set]);
  // The set of groups has those that are not in their default state (see isOpen), so a click adds or removes one.
  if (set === 'group') names.has(name) ? names.delete(name) : names.add(name);
  else if (open) names.add(name);
  else names.delete(name);
  change({[set]: names});
  if (set === 'bug') renderBugs(); else renderTests();
}

const noFilters = {q: '', theme: '', verdict: '', level: '', differs: false, new: false};

// Shows the target of a link, even if filters would hide it, and moves the focus to it.
function show({kind, name}) {
  const test = kind === 'open' && testNamed.get(name);
  const requirement = kind === 'requirement' && requirementNamed.get(name);
  const bug = kind === 'bug' && bugNamed.get(name);
  if (bug) {
    if (!matchingBugs(state).includes(bug)) Object.assign(state, noFilters);
    if (!matchingBugs(state).includes(bug)) state.columns = data.columns.map((_, i) => i);
    state.bug.add(name);
    render();
    goTo('bug-table', kind, name);
    return;
  }
  if (!test && !(requirement && requirement.tests.length)) return;
  const hidden = () => (test ? !matchingTests(state).includes(test) : !matchingTests(state).some((one) => requirement.tests.includes(one)));
  if (hidden()) Object.assign(state, noFilters);
  if (hidden()) state.columns = data.columns.map((_, i) => i);
  state.view = test ? '' : 'requirements';
  state[kind].add(name);
  const group = test ? test.theme : requirement.section;
  if (!isOpen(group, matchingTests(state))) state.group.has(group) ? state.group.delete(group) : state.group.add(group);
  render();
  goTo('table', kind, name);
}

function goTo(section, kind, name) {
  const target = withKey(byId(section), `${kind}=${name}`);
  target.scrollIntoView({block: 'start'});
  target.focus({preventScroll: true});
}

// Returns the test, requirement or bug that was opened last; null if none is open.
function latestOpened() {
  const kind = ['open', 'requirement', 'bug'].find((one) => state[one].size);
  return kind ? {kind, name: [...state[kind]].pop()} : null;
}

function follow() {
  const address = stateOfFragment(location.hash);
  state = address.state;
  typed = false;
  render();
  const target = address.at || (history.state === VISITED ? null : latestOpened());
  history.replaceState(VISITED, '');
  if (target) show(target);
}

// --- the form

function options(id, pairs) {
  byId(id).append(...pairs.map(([value, label]) => el('option', {value}, label)));
}

function fillForm() {
  options('filter-theme', [...new Set(tests.map((test) => test.theme))].sort().map((theme) => [theme, theme]));
  const occurs = (filter) => data.records.some(filter);
  options('filter-verdict', Object.entries(verdictFilters).filter(([, filter]) => occurs(filter))
      .map(([word]) => [word, verdictNames[words.indexOf(word)] || word]));
  options('filter-level', [...data.levels].reverse().map((level) => [level, level]));
  const columns = data.columns.map((label, column) => [column, label]);
  options('from', columns);
  options('to', columns.slice(0, current));
  for (const box of document.querySelectorAll('.column-switch')) box.hidden = data.columns.length < 2;
  byId('filter-differs').parentElement.hidden = data.columns.length < 2;
  byId('changes-section').hidden = data.columns.length < 2;
  byId('unobserved-section').hidden = false;
  byId('filters').hidden = false;
  byId('tests-section').hidden = false;
}

function listen() {
  const filters = () => ({
    q: byId('filter-q').value, theme: byId('filter-theme').value, verdict: byId('filter-verdict').value,
    level: byId('filter-level').value, differs: byId('filter-differs').checked, new: byId('filter-new').checked});
  let timer;
  byId('filter-q').addEventListener('input', () => {
    state.q = byId('filter-q').value;
    renderFiltered();
    clearTimeout(timer);  // browsers limit how often the address may change
    timer = setTimeout(() => change({q: state.q, group: new Set()}, true), 300);
  });
  byId('filters').addEventListener('change', (event) => {
    if (event.target.id === 'filter-q') return;
    change({...filters(), group: new Set()});
    renderFiltered();
  });
  byId('filters').addEventListener('submit', (event) => event.preventDefault());
  byId('filters').addEventListener('reset', (event) => {
    event.preventDefault();
    change({...emptyState(), view: state.view, from: state.from, to: state.to});
    render();
  });
  for (const button of document.querySelectorAll('#views button')) {
    button.addEventListener('click', () => {
      change({view: button.value, group: new Set()});
      renderForm();
      renderTests();
    });
  }
  for (const box of document.querySelectorAll('.column-switch')) {
    box.addEventListener('change', () => {
      const columns = [...document.querySelectorAll('.column-switch:checked')].map((one) => Number(one.value));
      if (!columns.length) {
        box.checked = true;
        return;
      }
      showColumns(columns);
    });
  }
  for (const id of ['from', 'to']) {
    byId(id).addEventListener('change', () => {
      change({from: data.columns[byId('from').value] || '', to: data.columns[byId('to').value] || ''});
      renderChanges();
    });
  }
  byId('copy-link').replaceWith(linkButton(null));
  // Links to headings do not change the address, because it has the state.
  for (const anchor of document.querySelectorAll('nav a, .skip')) {
    anchor.addEventListener('click', (event) => {
      event.preventDefault();
      const heading = byId(anchor.hash.slice(1));
      heading.scrollIntoView();
      heading.focus({preventScroll: true});
    });
  }
  addEventListener('popstate', follow);
  addEventListener('resize', fit);
  // A link to a test, requirement or bug keeps the state of the moment when it is followed.
  document.addEventListener('click', (event) => {
    const anchor = event.target.closest('a[href^="#"]');
    const at = anchor && new URLSearchParams(anchor.hash.slice(1)).get('at');
    if (!at) return;
    anchor.href = fragmentOf(state, at);
    if (anchor.hash === location.hash) setTimeout(follow);  // browsers send no event if the address stays the same
  });
}

// --- printing: bugs and unexpected results are opened in addition to what is open

let unprinted = null;
addEventListener('beforeprint', () => {
  unprinted = state;
  const bad = matching.filter((test) => state.columns.some((column) => stateOfRecord[data.outcomes[column][test.number]] === BAD))
      .slice(0, MOST_ROWS);
  state = {...state, open: new Set([...state.open, ...bad.map((test) => test.name)]), group: new Set(state.group),
           bug: new Set(bugNamed.keys())};
  for (const theme of new Set(bad.map((test) => test.theme)))
    if (!isOpen(theme, matching)) state.group.has(theme) ? state.group.delete(theme) : state.group.add(theme);
  render();
});
addEventListener('afterprint', () => {
  state = unprinted;
  render();
});

fillForm();
listen();
follow();
