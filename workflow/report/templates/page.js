// Tables sort, filter, copy and download; curves show their values. The page works without it.
"use strict";

const cells = row => [...row.cells];
const text = cell => {
  const own = cell.cloneNode(true);
  own.querySelectorAll("small").forEach(one => one.remove());
  return own.textContent.trim().replace(/\s+/g, " ");
};
const value = cell => cell.dataset.value ?? text(cell);

function sort(table, column, heading) {
  const ascending = heading.getAttribute("aria-sort") !== "ascending";
  table.querySelectorAll("th").forEach(one => one.removeAttribute("aria-sort"));
  heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const body = table.tBodies[0], sign = ascending ? 1 : -1;
  const rows = [...body.rows].map(row => [value(row.cells[column]), row]);
  const numbers = rows.every(([one]) => one === "" || !Number.isNaN(Number(one)));
  rows.sort(([a], [b]) => {
    if (a === "" || b === "") return (a === "") - (b === "");  // what has no number comes last
    return sign * (numbers ? a - b : a.localeCompare(b));
  });
  body.append(...rows.map(([, row]) => row));
}

function filter(table, choices) {
  for (const row of table.tBodies[0].rows) {
    row.hidden = choices.some(({column, select}) => select.value && text(row.cells[column]) !== select.value);
  }
}

// Numbers are copied in the unit of the datasets, with the ends of their intervals in columns beside.
function lines(table) {
  const [heading, ...rows] = [table.tHead.rows[0], ...[...table.tBodies[0].rows].filter(row => !row.hidden)].map(cells);
  const ends = heading.map((_, column) => ["low", "high"].filter(end => rows.some(row => end in row[column].dataset)));
  const unit = column => rows.map(row => row[column].dataset.unit).find(one => one && one !== "1");
  const named = heading.flatMap((cell, column) => {
    const name = text(cell) + (unit(column) ? ` (${unit(column)})` : "");
    return [name, ...ends[column].map(end => `${name}, ${end}`)];
  });
  return [named, ...rows.map(row => row.flatMap((cell, column) =>
    [value(cell), ...ends[column].map(end => cell.dataset[end] ?? "")]))];
}

const quoted = cell => /[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;

function button(name, act) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = name;
  made.addEventListener("click", act);
  return made;
}

function download(name, content) {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(new Blob([content], {type: "text/csv"}));
  link.click();
}

function equip(table) {
  const headings = cells(table.tHead.rows[0]), tools = document.createElement("div");
  tools.className = "tools";
  const choices = table.dataset.filters.split(" ").filter(Boolean).map(column => {
    const select = document.createElement("select");
    select.setAttribute("aria-label", `show only this: ${text(headings[column])}`);
    const values = [...new Set([...table.tBodies[0].rows].map(row => text(row.cells[column])))];
    select.append(new Option(`${text(headings[column])}: all`, ""), ...values.map(one => new Option(one)));
    select.addEventListener("change", () => filter(table, choices));
    tools.append(select);
    return {column, select};
  });
  headings.forEach((heading, column) => {
    heading.replaceChildren(button(text(heading), () => sort(table, column, heading)));
  });
  tools.append(
    button("Copy", () => navigator.clipboard.writeText(lines(table).map(row => row.join("\t")).join("\n"))),
    button("CSV", () => download(
      `${table.dataset.name}.csv`, lines(table).map(row => row.map(quoted).join(",") + "\n").join(""))),
  );
  table.before(tools);
}

function draw(figure) {
  const given = JSON.parse(figure.querySelector("script").textContent);
  const place = figure.querySelector(".drawn");
  const colour = name => () => getComputedStyle(document.documentElement).getPropertyValue(name);
  const digits = one => one == null ? "–" : String(Number(one.toPrecision(3)));
  const axis = {stroke: colour("--text"), grid: {stroke: colour("--line"), width: 0.5}, ticks: {stroke: colour("--line")}};
  const series = [{label: given.x.label, value: (_, one) => digits(one)}], columns = [given.x.values], bands = [];
  for (const one of given.series) {
    const shown = (_, y, __, at) => one.low && y != null && at != null
      ? `${digits(y)} [${digits(one.low[at])}, ${digits(one.high[at])}]` : digits(y);
    const line = {label: one.label, stroke: one.colour, width: 2, value: shown, spanGaps: !one.gaps, points: {show: true, size: 5}};
    series.push(line);
    columns.push(one.values);
    if (one.low) {
      const end = {class: "end", label: one.label, stroke: one.colour + "60", width: 0.5, spanGaps: !one.gaps, points: {show: false}};
      bands.push({series: [series.length, series.length + 1], fill: one.colour + "30"});
      series.push(end, {...end});
      columns.push(one.high, one.low);
    }
  }
  const marks = plot => {
    const {ctx, bbox} = plot, at = (one, scale) => plot.valToPos(one, scale, true);
    ctx.save();
    ctx.fillStyle = "#88888830";
    for (const [low, high] of given.shaded ?? []) {
      const left = Math.max(at(low, "x"), bbox.left), right = Math.min(at(high, "x"), bbox.left + bbox.width);
      if (right > left) ctx.fillRect(left, bbox.top, right - left, bbox.height);
    }
    const [bottom, top] = given.alike ?? [];
    if (top) ctx.fillRect(bbox.left, at(top, "y"), bbox.width, at(bottom, "y") - at(top, "y"));
    ctx.fillStyle = colour("--soft")();
    for (const mark of given.marks ?? []) ctx.fillRect(at(mark, "x") - 0.5, bbox.top, 1, bbox.height);
    ctx.restore();
  };
  const short = one => one == null ? "" : one >= 1e5 || one < 1e-3 ? one.toExponential(0).replace("+", "") : String(one);
  const ticks = one => one.log ? {values: (_, splits) => splits.map(short)} : {};
  const scale = one => ({time: false, distr: one.log ? 3 : 1, ...(one.range && {range: one.range})});
  const plot = new uPlot({
    width: place.clientWidth, height: Math.min(340, Math.max(260, place.clientWidth * 0.5)),
    scales: {x: scale(given.x), y: scale(given.y)},
    axes: [{...axis, ...ticks(given.x), label: given.x.label}, {...axis, ...ticks(given.y), label: given.y.label, size: 65}],
    series, bands, hooks: {drawClear: [marks]},
  }, columns, place);
  new ResizeObserver(() => {  // also when a fold that holds it opens
    if (place.clientWidth && place.clientWidth !== plot.width) plot.setSize({width: place.clientWidth, height: plot.height});
  }).observe(place);
  const tools = document.createElement("div");
  tools.className = "tools";
  tools.append(button("CSV", () => {
    const ends = ["", ", low", ", high"], row = at => one => [one.values, one.low, one.high].map(of => of?.[at] ?? "");
    const rows = given.x.values.map((x, at) => [x, ...given.series.flatMap(row(at))]);
    rows.unshift([given.x.label, ...given.series.flatMap(one => ends.map(end => one.label + end))]);
    download(`${figure.id}.csv`, rows.map(row => row.map(one => quoted(String(one))).join(",") + "\n").join(""));
  }));
  place.after(tools);
}

document.querySelectorAll("table[data-name]").forEach(equip);
document.querySelectorAll("figure.curve").forEach(draw);
addEventListener("hashchange", () => {  // a link to a row that a filter hides shows the row
  const row = document.getElementById(location.hash.slice(1))?.closest("tr");
  if (row?.hidden) {
    row.hidden = false;
    row.scrollIntoView();
  }
});
addEventListener("beforeprint", () => {  // paper cannot be unfolded
  document.querySelectorAll("details").forEach(one => { one.open = true; });
});
