// Tables sort, search and copy; figures close, folds open for links and for the printer. The page works without this script.
"use strict";

const PREFIXES = {p: 1e-12, n: 1e-9, µ: 1e-6, m: 1e-3, M: 1e6, G: 1e9};
const UNIT = /\d\]? ([pnµmMG]?)(?:m|N|J\/m²|Pa)(?![A-Za-z])/;

// The text of a cell, with a mark before each further line.
function text(cell) {
  const copy = cell.cloneNode(true);
  copy.querySelectorAll("small").forEach(line => line.before("; "));
  return copy.textContent.trim().replace(/\s+/g, " ").replace(/^; /, "");
}

// The first number of a text, in the unit without prefix.
function number(words) {
  const digits = words.match(/[−-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?/);
  return digits ? Number(digits[0].replace("−", "-")) * (PREFIXES[words.match(UNIT)?.[1]] ?? 1) : NaN;
}

// How rows compare by a column: numbers before cells without one, words before empty cells.
function comparison(rows, column, direction) {
  const cells = rows.map(row => row.cells[column]), haveValues = cells.some(cell => "value" in cell.dataset);
  const numeric = haveValues || cells.every(cell => cell.className === "number" || /^$|^[<>≈×+]? ?[−-]?\d/.test(text(cell)));
  const keys = new Map(rows.map(row => [row, text(row.cells[column])]));
  if (!numeric) return (a, b) => (keys.get(a) === "") - (keys.get(b) === "")
    || direction * keys.get(a).localeCompare(keys.get(b), "en", {numeric: true});
  rows.forEach(row => keys.set(row, haveValues ? parseFloat(row.cells[column].dataset.value) : number(keys.get(row))));
  return (a, b) => Number.isNaN(keys.get(a)) - Number.isNaN(keys.get(b)) || direction * (keys.get(a) - keys.get(b));
}

// Whether a row adds to the row before it.
const follows = row => row.cells[0].className === "follows";

// Groups of rows that stay together: a row and those that follow it, and neighbours with the same first cell.
function grouped(rows) {
  const groups = [];
  rows.forEach((row, index) => {
    const continues = follows(row) || index && text(row.cells[0]) === text(rows[index - 1].cells[0]);
    if (continues) groups.at(-1).push(row);
    else groups.push([row]);
  });
  return groups;
}

function sort(table, groups, column, heading) {
  const ascending = heading.getAttribute("aria-sort") !== "ascending";
  table.querySelectorAll("th").forEach(cell => cell.removeAttribute("aria-sort"));
  heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const compare = comparison(groups.flat(), column, ascending ? 1 : -1);
  groups.forEach(rows => rows.sort((a, b) => follows(a) || follows(b) ? 0 : compare(a, b)));
  groups.sort((a, b) => compare(a[0], b[0]));
  table.tBodies[0].append(...groups.flat());
}

function button(name, act) {
  return Object.assign(document.createElement("button"), {type: "button", textContent: name, onclick: act});
}

document.querySelectorAll(".table table").forEach(table => {
  const tools = document.createElement("div"), headings = [...table.tHead.rows[0].cells];
  const groups = grouped([...table.tBodies[0].rows]);
  tools.className = "tools";
  headings.forEach((heading, column) =>
    heading.replaceChildren(button(text(heading), () => sort(table, groups, column, heading))));
  if (table.tBodies[0].rows.length > 20) {
    const search = Object.assign(document.createElement("input"), {type: "search", placeholder: "Search"});
    search.setAttribute("aria-label", `Search ${text(table.caption)}`);
    search.oninput = () => [...table.tBodies[0].rows].forEach(row => {
      row.hidden = !text(row).toLowerCase().includes(search.value.toLowerCase());
    });
    tools.append(search);
  }
  const shown = () => [...table.rows].filter(row => !row.hidden);
  tools.append(button("Copy", () => navigator.clipboard.writeText(
    shown().map(row => [...row.cells].map(text).join("\t")).join("\n"))));
  table.caption.prepend(tools);
});

function closeFigures() {
  document.querySelectorAll(".zoom[open]").forEach(figure => { figure.open = false; });
}

addEventListener("keydown", event => { if (event.key === "Escape") closeFigures(); });

// A link to something folded opens its folds.
function reveal() {
  const target = document.getElementById(location.hash.slice(1));
  for (let fold = target?.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  target?.scrollIntoView();
}

addEventListener("hashchange", reveal);
reveal();

// A page that was mailed alone has no figures beside it. It then loses its links to other pages and files, and sentences
// that are nothing but such links.
function unlink() {
  document.querySelectorAll(".linked").forEach(sentence => sentence.remove());
  document.querySelector(".menu.pages")?.remove();
  document.querySelector("footer").append(" · Other pages and files are in the folder of the study.");
  document.querySelectorAll("a:not([href^='#'], [href*='://'])").forEach(link => link.removeAttribute("href"));
}

const {figure} = document.querySelector("main").dataset;
if (figure) Object.assign(new Image(), {onerror: unlink, src: figure});

// Printed pages have nothing folded, and each figure in its place.
let folded = [];
addEventListener("beforeprint", () => {
  closeFigures();
  folded = [...document.querySelectorAll("details:not(.zoom, [open])")];
  folded.forEach(fold => { fold.open = true; });
});
addEventListener("afterprint", () => folded.forEach(fold => { fold.open = false; }));
