// Functions that make parts of the page from text. They make text nodes, never markup.

const byId = (id) => document.getElementById(id);

// Returns an element. "onclick" and the like add listeners; attributes that are undefined or false are omitted.
function el(tag, attributes, ...children) {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === undefined || value === false) continue;
    if (name.startsWith('on')) out.addEventListener(name.slice(2), value);
    else out.setAttribute(name, value === true ? '' : value);
  }
  out.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== ''));
  return out;
}

// Returns the parts of a name with line break opportunities between them.
const named = (name) => name.split(/(?<=[./])/).flatMap((part, i) => (i ? [el('wbr'), part] : [part]));
const faint = (...children) => el('span', {class: 'faint'}, ...children);
const count = (n, noun) => `${n} ${noun}${n === 1 ? '' : 's'}`;
const outside = (address, name) => el('a', {href: address, rel: 'noreferrer'}, name);  // a link to another page

// --- texts

// Returns the captured text with marks on the components that differ from the expected ones, such as the last one
// of "{0, 0, 1}" for "{0, 0, 0}".
function markedDifferences(expected, captured) {
  const parts = (string) => string.split(/([{}]|, )/);
  const left = parts(expected.replace(/ as .*/s, '')), right = parts(captured);
  if (left.length !== right.length || left.length < 3) return [captured];
  return right.map((part, i) => (part === left[i] ? part : el('mark', null, part)));
}

// --- copying

async function copy(string) {
  try {
    await navigator.clipboard.writeText(string);
  } catch {  // the page has no clipboard or no permission to use it
    const field = el('textarea', {class: 'off-screen'});
    field.value = string;
    document.body.append(field);
    field.select();
    document.execCommand('copy');
    field.remove();
  }
}

function copyButton(label, string) {
  const button = el('button', {type: 'button', class: 'copy', onclick: async () => {
    await copy(typeof string === 'function' ? string() : string);
    button.textContent = 'Copied';
    setTimeout(() => { button.textContent = label; }, 2000);
    button.focus();
  }}, label);
  return button;
}

// --- lists

// Returns the first `most` items as elements, and a button that adds as many again if there are more.
function limited(items, most, make, tag = 'li') {
  const out = items.slice(0, most).map(make);
  if (items.length <= most) return out;
  const left = items.length - most;
  const line = el(tag, {class: 'more'}, el('button', {type: 'button', onclick: () => {
    const next = limited(items.slice(most), most, make, tag);
    line.replaceWith(...next);
    next[0].querySelector('a, button, summary')?.focus();
  }}, `Show ${Math.min(left, most)} more of ${left}`));
  return [...out, line];
}

// Returns a fold; `fill` makes its content when it is first opened.
function fold(attributes, summary, fill) {
  const out = el('details', attributes, el('summary', null, summary));
  const open = () => { if (out.open && out.childElementCount === 1) out.append(...[fill()].flat(Infinity)); };
  out.addEventListener('toggle', open);
  if (attributes?.open) open();
  return out;
}

// --- verdicts

const symbolOf = (verdict) => el('span', {'aria-hidden': 'true'}, data.verdicts[verdict][2]);

function notesOf(record) {
  const notes = [];
  if (record[FLAGS] & KNOWN) notes.push('known');
  if (record[FLAGS] & UNEXPECTED && record[VERDICT] === PASS) notes.push('unexpected');
  if (record[FLAGS] & FLAKE) notes.push('flake');
  return notes;
}

const chip = (record) => el('span', {class: `chip ${stateClasses[stateOf(record)]}`},
    symbolOf(record[VERDICT]), ` ${[verdictNames[record[VERDICT]], ...notesOf(record)].join(', ')}`);
const labels = (columns) => columns.map((column) => data.columns[column]).join(', ');
