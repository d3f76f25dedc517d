// Filters, commands to copy, links that open what they lead to, and printing with the failures open. The page reads without it.
'use strict';
(() => {
  const byId = (id) => document.getElementById(id);
  const tests = [...document.querySelectorAll('.test')];
  const rows = new Map([...document.querySelectorAll('[data-test]')].map((row) => [row.dataset.test, row]));
  const words = new Map();  // what the text filter looks through, read when first needed

  const text = byId('filter-text'), verdict = byId('filter-verdict'), level = byId('filter-level');
  const differs = byId('filter-differs');  // only with several implementations

  function matches(test, needles) {
    if (verdict.value && !test.dataset.verdicts.split(' ').includes(verdict.value)) return false;
    if (level.value && test.dataset.level !== level.value) return false;
    if (differs && differs.checked && !('differs' in test.dataset)) return false;
    if (!needles.length) return true;
    if (!words.has(test)) words.set(test, test.textContent.toLowerCase());
    return needles.every((needle) => words.get(test).includes(needle));
  }

  function filter() {
    const needles = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const test of tests) {
      test.hidden = !matches(test, needles);
      shown += !test.hidden;
      const row = rows.get(test.id);
      if (row) row.hidden = test.hidden;
    }
    byId('filter-count').textContent = `${shown} of ${tests.length} tests shown`;
  }

  function openTarget() {
    const target = byId(decodeURIComponent(location.hash.slice(1)));
    if (!target || !target.matches('.test')) return;
    target.hidden = false;
    target.open = true;
    target.scrollIntoView();
    target.querySelector('summary').focus({preventScroll: true});
  }

  const form = byId('filters');
  form.hidden = tests.length === 0;
  form.addEventListener('input', filter);
  form.addEventListener('submit', (event) => event.preventDefault());
  addEventListener('hashchange', openTarget);
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
