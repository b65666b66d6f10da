"use strict";
// Makes tables sortable and, where they are long, searchable. The page says all that it has to say without this.

const SORT_FROM_ROWS = 3;
const FILTER_FROM_ROWS = 12;

/// What a row is sorted by in a column: a number where the cell has one, missing values last.
function keyOf(row, column) {
  const cell = row.cells[column];
  const text = (cell.dataset.key ?? cell.textContent).trim();
  const number = text === "inf" ? Infinity : text === "-inf" ? -Infinity : Number(text);
  if (text === "" || text === "-" || text === "nan") return { missing: true };
  return Number.isNaN(number) ? { text } : { number };
}

function compare(a, b) {
  if ("number" in a && "number" in b) return a.number - b.number || 0;
  return String(a.text ?? a.number).localeCompare(String(b.text ?? b.number), undefined, { numeric: true });
}

function sort(table, column, descending) {
  const body = table.tBodies[0];
  const rows = Array.from(body.rows, (row) => ({ row, key: keyOf(row, column) }));
  rows.sort((a, b) => {
    if (a.key.missing || b.key.missing) return (a.key.missing ? 1 : 0) - (b.key.missing ? 1 : 0);
    return descending ? compare(b.key, a.key) : compare(a.key, b.key);
  });
  body.append(...rows.map((entry) => entry.row));
}

function addSorting(table) {
  const heads = Array.from(table.tHead.rows[0].cells);
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const descending = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", descending ? "descending" : "ascending");
      sort(table, column, descending);
    });
  });
}

/// Shows the rows that have all words of a search.
function addFilter(table) {
  const rows = Array.from(table.tBodies[0].rows, (row) => ({
    row,
    text: Array.from(row.cells, (cell) => cell.textContent.toLowerCase()).join(" "),
  }));
  const label = document.createElement("label");
  const input = document.createElement("input");
  const count = document.createElement("output");
  label.className = "filter";
  input.type = "search";
  input.placeholder = "words in a row";
  label.append("Filter ", input, " ", count);
  input.addEventListener("input", () => {
    const words = input.value.toLowerCase().split(/\s+/);
    let shown = 0;
    for (const { row, text } of rows) {
      row.hidden = !words.every((word) => text.includes(word));
      shown += row.hidden ? 0 : 1;
    }
    count.textContent = input.value === "" ? "" : `${shown} of ${rows.length} rows`;
  });
  table.parentElement.before(label);
}

for (const table of document.querySelectorAll(".scroll > table")) {
  if (table.tBodies[0].rows.length >= SORT_FROM_ROWS) addSorting(table);
  if (table.tBodies[0].rows.length >= FILTER_FROM_ROWS) addFilter(table);
}
