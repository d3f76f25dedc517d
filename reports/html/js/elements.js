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

// --- numbers, in decimal unless the switch asks for what was recorded

const HEX_FLOAT = /(-?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?p([+-]?\d+)(f?)/gi;

// Returns the shortest decimal that gives the same binary32 (if `single`) or binary64 number.
function decimalOf(value, single) {
  if (single) {
    for (let digits = 1; digits <= 9; ++digits) {
      const short = Number(value.toPrecision(digits));
      if (Math.fround(short) === value) return String(short);
    }
  }
  return String(value);
}

function valueOf(sign, whole, fraction, exponent) {
  const digits = whole + (fraction || '');
  const value = parseInt(digits, 16) * 2 ** (Number(exponent) - 4 * (fraction || '').length);
  return sign ? -value : value;
}

// "0.3 (0x1.333334p-2)" becomes "0.3", and "x = 0x1p-1" becomes "x = 0.5".
function decimalText(string) {
  return string.replace(/ \(-?0x[0-9a-f.]+p[+-]?\d+\)/gi, '').replace(HEX_FLOAT, (_, sign, whole, fraction, exponent) => {
    const value = valueOf(sign, whole, fraction, exponent);
    return decimalOf(value, Math.fround(value) === value);
  });
}

// Returns C code with decimal literals of exactly the same values: "0x1p-1 /* 0.5 */" becomes "0.5". Literals
// without an "f" are binary64.
function decimalCode(string) {
  const uncommented = string.replace(/(p[+-]?\d+f?) \/\* -?[\d.e+-]+f? \*\//gi, '$1');
  return uncommented.replace(HEX_FLOAT, (_, sign, whole, fraction, exponent, single) => {
    const number = decimalOf(valueOf(sign, whole, fraction, exponent), Boolean(single));
    return (/[.e]/.test(number) ? number : `${number}.0`) + single;
  });
}

const shownText = (string) => (state.hex ? string : decimalText(string));
const shownCode = (string) => (state.hex ? string : decimalCode(string));

// Returns the captured text with marks on the components that differ from the expected ones, such as the last one
// of "{0, 0, 1}" for "{0, 0, 0}".
function markedDifferences(expected, captured) {
  const parts = (string) => shownText(string).split(/([{}]|, )/);
  const left = parts(expected.replace(/ as .*/s, '')), right = parts(captured);
  if (left.length !== right.length || left.length < 3 || expected.startsWith('[')) return [shownText(captured)];
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

const symbolOf = (verdict) => el('span', {'aria-hidden': 'true'}, data.verdicts[verdict][1]);

function notesOf(record) {
  const notes = [];
  if (record[FLAGS] & KNOWN) notes.push('known');
  if (record[FLAGS] & UNEXPECTED && record[VERDICT] === PASS) notes.push('unexpected');
  if (record[FLAGS] & FLAKE) notes.push('flake');
  return notes;
}

const chip = (record) => el('span', {class: `chip ${stateClasses[stateOf(record)]}`},
    symbolOf(record[VERDICT]), ` ${[words[record[VERDICT]], ...notesOf(record)].join(', ')}`);
const labels = (columns) => columns.map((column) => data.columns[column]).join(', ');
