// Filters, commands to copy, links that open what they lead to, and printing with the failures open. The page reads without it.
'use strict';
(() => {
  const byId = (id) => document.getElementById(id);
  const tests = [...document.querySelectorAll('.test')];
  const rows = [...document.querySelectorAll('#matrix .row')];  // of requirements; the tests know them by number
  // Some have a row for each dimension: EV-API-ENTRY/1-D.
  const requirements = rows.map((row) => row.querySelector('summary').textContent.split('/')[0]);
  const distinct = (numbers) => new Set(numbers.map((number) => requirements[number])).size;
  const rowsOf = new Map(tests.map((test) => [test, test.dataset.rows.split(' ').filter(Boolean).map(Number)]));
  const words = new Map();  // what the text filter looks through, read when first needed

  const text = byId('filter-text'), theme = byId('filter-theme'), verdict = byId('filter-verdict');
  const level = byId('filter-level');
  const column = byId('filter-column'), differs = byId('filter-differs');  // only with several implementations

  function hasVerdict(test) {
    const columns = test.dataset.verdicts.split(' ');
    const chosen = column && column.value ? [columns[column.value]] : columns;
    return chosen.some((outcome) => (verdict.value ? outcome.split(',').includes(verdict.value) : outcome !== 'absent'));
  }

  function matches(test, needles) {
    if (theme.value && test.dataset.theme !== theme.value) return false;
    if (level.value && test.dataset.level !== level.value) return false;
    if (differs && differs.checked && !('differs' in test.dataset)) return false;
    if (!hasVerdict(test)) return false;
    if (!needles.length) return true;
    if (!words.has(test)) words.set(test, test.textContent.toLowerCase());
    return needles.every((needle) => words.get(test).includes(needle));
  }

  // A requirement is shown with any of its tests.
  function filter() {
    const needles = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    const shownRows = new Set();
    let shown = 0;
    for (const test of tests) {
      const hidden = !matches(test, needles);
      if (test.hidden !== hidden) test.hidden = hidden;
      if (hidden) continue;
      ++shown;
      for (const row of rowsOf.get(test)) shownRows.add(row);
    }
    rows.forEach((row, number) => { row.hidden = !shownRows.has(number); });
    for (const section of document.querySelectorAll('#matrix tbody'))
      section.hidden = !section.querySelector('.row:not([hidden])');
    byId('filter-count').textContent =
      `${shown} of ${tests.length} tests, ${distinct([...shownRows])} of ${distinct([...rows.keys()])} requirements shown`;
  }

  // What a link leads to is shown, whatever the filters say, opened, and has the focus.
  function openTarget() {
    let id = location.hash.slice(1);
    try {
      id = decodeURIComponent(id);
    } catch {
      return;  // no link of this page
    }
    const target = byId(id);
    if (!target || !target.matches('.test, .row')) return;
    target.hidden = false;
    target.closest('.test, tbody').hidden = false;
    const details = target.matches('details') ? target : target.querySelector('details');
    details.open = true;
    target.scrollIntoView();
    details.querySelector('summary').focus({preventScroll: true});
  }

  const form = byId('filters');
  form.hidden = tests.length === 0;
  text.addEventListener('input', filter);
  form.addEventListener('change', filter);
  form.addEventListener('reset', () => setTimeout(filter));
  form.addEventListener('submit', (event) => event.preventDefault());
  for (const link of document.querySelectorAll('.show')) {
    link.addEventListener('click', () => {
      form.reset();
      text.value = link.dataset.text;
      setTimeout(filter);
    });
  }
  addEventListener('hashchange', openTarget);
  // The same link once more changes nothing in the address.
  document.addEventListener('click', (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link && link.hash === location.hash) setTimeout(openTarget);  // after the browser has followed it
  });
  // The browser may have kept what was chosen before the page was loaded again.
  filter();
  openTarget();

  // A page opened from disk may have no clipboard; the command can be selected as well.
  if (navigator.clipboard) {
    for (const button of document.querySelectorAll('.copy')) {
      button.hidden = false;
      button.addEventListener('click', async () => {
        await navigator.clipboard.writeText(button.parentElement.querySelector('code').textContent);
        button.textContent = 'Copied';
        setTimeout(() => { button.textContent = 'Copy'; }, 2000);
      });
    }
  }

  let opened = [];
  addEventListener('beforeprint', () => {
    const bad = /\b(fail|crash|timeout|internal-error|quality-warning)\b/;
    opened = tests.filter((test) => !test.open && !test.hidden && bad.test(test.dataset.verdicts));
    for (const test of opened) test.open = true;
  });
  addEventListener('afterprint', () => {
    for (const test of opened) test.open = false;
  });
})();
