// Tables that sort by any column, by click or key, and mark what is best.
import { element } from './element.js';

const FITS = 15;  // rows; longer tables scroll by themselves, under their heads

// columns: { name, title, hint, first: 'ascending' | 'descending' }; rows: { head, key, cells: [{ value, content,
// best }] }, a cell a column. Values are numbers or texts; null goes last either way.
export function sortable_table(caption, columns, rows) {
  const body = element('tbody');
  for (const row of rows) {
    row.root = element('tr', { 'data-key': row.key }, row.cells.map((cell, i) => {
      const properties = { class: cell.best ? 'best' : undefined, 'data-value': cell.value ?? '' };
      return i === 0 ? element('th', { scope: 'row', ...properties }, cell.content)
        : element('td', properties,
          cell.best ? element('span', { class: 'star', role: 'img', 'aria-label': 'best' }, '★') : null, cell.content);
    }));
  }
  const heads = columns.map((column, i) => element('th', { scope: 'col', 'data-column': column.name },
    element('button', { type: 'button', title: column.hint, onclick: () => sort(i) }, column.title,
      element('span', { class: 'direction', 'aria-hidden': 'true' }))));
  let by = -1, ascending = true;

  function sort(i) {
    ascending = i === by ? !ascending : columns[i].first !== 'descending';
    by = i;
    heads.forEach((head, k) => {
      if (k === i) head.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
      else head.removeAttribute('aria-sort');
    });
    const compare = (a, b) => {
      const x = a.cells[i].value ?? null, y = b.cells[i].value ?? null;
      if (x === null || y === null) return (x === null) - (y === null);
      const order = typeof x === 'string' ? x.localeCompare(y) : x - y;
      return ascending ? order : -order;
    };
    body.append(...rows.toSorted(compare).map((row) => row.root));
  }

  body.append(...rows.map((row) => row.root));
  // The frame scrolls where the table is wider than the screen, also by keys; the caption stays.
  return element('div', {}, element('p', { class: 'hint' }, caption),
    element('div', { class: rows.length > FITS ? 'scroll tall' : 'scroll', tabindex: '0', role: 'region', 'aria-label': caption },
      element('table', { 'aria-label': caption }, element('thead', {}, element('tr', {}, heads)), body)));
}
