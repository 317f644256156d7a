// Tables sort, search and copy. The page works without it.
"use strict";

const text = cell => cell.textContent.trim().replace(/\s+/g, " ");
const value = cell => cell.dataset.value ?? text(cell);

function sort(table, column, heading) {
  const ascending = heading.getAttribute("aria-sort") !== "ascending";
  table.querySelectorAll("th").forEach(cell => cell.removeAttribute("aria-sort"));
  heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const rows = [...table.tBodies[0].rows], key = row => value(row.cells[column]);
  const numbers = rows.every(row => !Number.isNaN(Number(key(row))));
  const order = numbers ? (a, b) => key(a) - key(b) : (a, b) => key(a).localeCompare(key(b));
  rows.sort((a, b) => (key(a) === "") - (key(b) === "") || (ascending ? 1 : -1) * order(a, b));
  table.tBodies[0].append(...rows);
}

function button(name, act) {
  const made = document.createElement("button");
  Object.assign(made, {type: "button", textContent: name, onclick: act});
  return made;
}

document.querySelectorAll(".table table").forEach(table => {
  const tools = document.createElement("div"), headings = [...table.tHead.rows[0].cells];
  tools.className = "tools";
  headings.forEach((heading, column) =>
    heading.replaceChildren(button(text(heading), () => sort(table, column, heading))));
  if (table.tBodies[0].rows.length > 20) {
    const search = Object.assign(document.createElement("input"), {type: "search", placeholder: "Search"});
    search.oninput = () => [...table.tBodies[0].rows].forEach(row => {
      row.hidden = !text(row).toLowerCase().includes(search.value.toLowerCase());
    });
    tools.append(search);
  }
  const shown = () => [...table.rows].filter(row => !row.hidden);
  tools.append(button("Copy", () => navigator.clipboard.writeText(
    shown().map(row => [...row.cells].map(text).join("\t")).join("\n"))));
  table.before(tools);
});
