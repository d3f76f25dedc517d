// The state of the page, which is in the fragment of its address: "#verdict=fail&on=osmesa&open=Mesh2.FillOrder".

// The members of the state that are one text, sets of names, and switches.
const TEXTS = ['view', 'q', 'theme', 'verdict', 'level', 'from', 'to'];
const SETS = ['group', 'open', 'requirement', 'bug'];  // unfolded groups, tests, requirements and bugs
const SWITCHES = ['differs', 'new'];

function emptyState() {
  const state = {columns: firstColumns};
  for (const name of TEXTS) state[name] = '';
  for (const name of SETS) state[name] = new Set();
  for (const name of SWITCHES) state[name] = false;
  return state;
}

// Returns the fragment for the state. `at` is the test, requirement or bug that the link leads to, as "open=NAME".
function fragmentOf(state, at = null) {
  const parameters = new URLSearchParams();
  if (String(state.columns) !== String(emptyState().columns))
    for (const column of state.columns) parameters.append('on', data.columns[column]);
  for (const name of TEXTS) if (state[name]) parameters.set(name, state[name]);
  for (const name of SWITCHES) if (state[name]) parameters.set(name, '1');
  for (const name of SETS) for (const value of state[name]) parameters.append(name, value);
  if (at) parameters.set('at', at);
  return `#${parameters}`;
}

// Returns the state of a fragment and its `at`. Unknown names and values are ignored, because anybody may have
// written the address.
function stateOfFragment(fragment) {
  const state = emptyState(), parameters = new URLSearchParams(fragment.replace(/^#/, ''));
  const on = parameters.getAll('on').map((label) => data.columns.indexOf(label)).filter((column) => column >= 0);
  if (on.length) state.columns = [...new Set(on)].sort((a, b) => a - b);
  for (const name of TEXTS) state[name] = parameters.get(name) || '';
  for (const name of SWITCHES) state[name] = parameters.get(name) === '1';
  for (const name of SETS) state[name] = new Set(parameters.getAll(name));
  if (state.view !== 'requirements') state.view = '';
  if (!Object.hasOwn(verdictFilters, state.verdict)) state.verdict = '';
  if (!data.levels.includes(state.level)) state.level = '';
  if (!tests.some((test) => test.theme === state.theme)) state.theme = '';
  const [, kind, name] = /^(open|requirement|bug)=(.*)$/s.exec(parameters.get('at') || '') || [];
  return {state, at: kind ? {kind, name} : null};
}
