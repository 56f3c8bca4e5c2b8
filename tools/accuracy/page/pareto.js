// Error against milliseconds: a figure for each workload, and its price list beside it.
"use strict";

function rowsOf(workload) {
  return results.measurements.map((m, index) => ({ m, index, path: `/measurements/${index}` }))
      .filter((row) => row.m.workload === workload);
}

function errorOf(row, kind) {
  const index = row.m.errors.findIndex((e) => e.kind === kind);
  return index < 0 ? undefined : { ...row.m.errors[index], path: `${row.path}/errors/${index}` };
}

const told = (error) => (error.value > error.resolution ? error.value : 0);

// As the results have it for the first kind of error; by the same rule for others.
function isDominated(row, rows, kind, isFirst) {
  if (isFirst) return row.m.is_dominated;
  const own = told(errorOf(row, kind));
  return rows.some((other) => {
    const error = told(errorOf(other, kind));
    return error < own ? other.m.ms.median <= row.m.ms.median : error === own && other.m.ms.high < row.m.ms.low;
  });
}

function settingName(row, tag = "span") {
  if (row.m.is_default) return [make(tag, {}, "default")];
  return [words(row.path + "/knob", tag), " ", words(row.path + "/setting", tag)];
}

function timeText(row) {
  return [number(row.path + "/ms/median"), " ms"];
}

function detailsOf(row) {
  const errors = row.m.errors.map((error, k) => make("li", {}, words(kindPath(error.kind) + "/label"), ": ",
                                                     errorText(`${row.path}/errors/${k}`)));
  return [make("b", {}, settingName(row)), ": ", timeText(row), ", the middle half ", number(row.path + "/ms/low"), " to ",
          number(row.path + "/ms/high"), " of ", number(row.path + "/ms/raw/length"), " runs; ",
          number(row.path + "/times_default"), " times the default’s. What one loses: ", words(row.path + "/loses"),
          make("ul", {}, errors)];
}

function spokenOf(row, error) {
  const limit = told(error) > 0 ? inWords(error.value) : "below " + inWords(error.resolution, 2);
  const kind = results.kinds.find((k) => k.name === error.kind);
  return `${shownName(row)}: ${inWords(row.m.ms.median)} milliseconds, ` +
      `${kind.label} ${limit} ${kind.unit}`;
}

// Beside the point, or wherever there is room for it; nothing where there is none.
function labelFor(x, y, text, taken) {
  const width = 6.4 * text.length;
  for (const [dx, dy, anchor] of [[11, 4, "start"], [-11, 4, "end"], [0, -11, "middle"], [0, 19, "middle"], [11, -9, "start"],
                                  [-11, -9, "end"], [11, 17, "start"], [-11, 17, "end"]]) {
    const left = x + dx - (anchor === "end" ? width : anchor === "middle" ? width / 2 : 0);
    const box = { left, right: left + width, top: y + dy - 11, bottom: y + dy + 3 };
    const isInside = box.left > kBounds.left && box.right < kBounds.width && box.top > 2 && box.bottom < kBounds.height - 24;
    const isFree = taken.every((other) => other.right < box.left || other.left > box.right || other.bottom < box.top ||
                                          other.top > box.bottom);
    if (!isInside || !isFree) continue;
    taken.push(box);
    return { x: x + dx, y: y + dy, "text-anchor": anchor };
  }
  return undefined;
}

function paretoPlot(workload, kind, isFirst, show) {
  const all = rowsOf(workload.name), b = kBounds;
  const rows = all.filter((row) => row.m.failed === "" && errorOf(row, kind)).sort((p, q) => p.m.ms.median - q.m.ms.median);
  const knobs = [...new Set(all.map((row) => row.m.knob))];
  const above = rows.map((row) => told(errorOf(row, kind))).filter((value) => value > 0);
  const hasBand = above.length < rows.length, bandHeight = hasBand ? (above.length > 0 ? 64 : 150) : 0;
  const floor = b.height - b.bottom - bandHeight;
  const x = scaleOf(rows.flatMap((row) => [row.m.ms.low, row.m.ms.high]), b.left, b.width - b.right, true);
  const y = above.length > 0 ? scaleOf(above, floor - 4, b.top + 12, true) : { place: () => floor, ticks: [] };
  const top = above.length > 0 ? b.top : floor;
  const parts = axes(x, y, { x: "milliseconds, " + workload.time_of,
                              y: above.length > 0 ? words(kindPath(kind) + "/unit", "tspan") : undefined }, top);
  if (hasBand) parts.unshift(make("rect", { class: "band", x: b.left, y: floor, width: b.width - b.left - b.right,
                                            height: bandHeight }));
  if (hasBand) parts.push(bandText(rows, kind, floor));
  let inBand = 0;
  const placed = rows.map((row) => {
    const error = errorOf(row, kind), isTold = told(error) > 0;
    const place = isTold ? y.place(error.value) : floor + 30 + (inBand++ % (bandHeight > 100 ? 7 : 2)) * 17;
    return { row, error, x: x.place(row.m.ms.median), y: place, isTold,
             isDominated: isDominated(row, rows, kind, isFirst) };
  });
  parts.push(frontLine(placed.filter((p) => !p.isDominated)));
  const taken = placed.map((p) => ({ left: p.x - 7, right: p.x + 7, top: p.y - 7, bottom: p.y + 7 }));
  if (hasBand) taken.push({ left: b.left, right: b.left + 260, top: floor + 3, bottom: floor + 18 });
  const labels = new Map([...placed].sort((p, q) => q.row.m.is_default - p.row.m.is_default)
      .map((p) => [p, p.row.m.is_default || !p.isDominated ? labelFor(p.x, p.y, shownName(p.row), taken) : undefined]));
  const points = placed.map((p) => paretoPoint(p, x, shapeOf(knobs, p.row.m.knob), labels.get(p)));
  walkable(points, (k) => show(placed[k].row));
  const svg = make("svg", { viewBox: `0 ${top === b.top ? 0 : floor - 16} ${b.width} ${top === b.top ? b.height :
                                     b.height - floor + 16}`, role: "group",
                            "aria-label": "Error against time; arrow keys walk along the settings" }, parts, points);
  return [svg, legend(knobs, all)];
}

function bandText(rows, kind, floor) {
  const row = rows.find((r) => told(errorOf(r, kind)) === 0);
  const path = errorOf(row, kind).path;
  return make("text", { x: kBounds.left + 6, y: floor + 15 }, "below ", number(path + "/resolution", { tag: "tspan", digits: 2 }),
              ": what the reference resolves");
}

// Of the settings that are worth their time.
function frontLine(front) {
  const corners = [];
  front.forEach((p, k) => {
    if (k > 0 && p.y > front[k - 1].y) corners.push(`${p.x},${front[k - 1].y}`);
    if (k === 0 || p.y >= front[k - 1].y) corners.push(`${p.x},${p.y}`);
  });
  return make("polyline", { class: "front", points: corners.join(" ") });
}

function shownName(row) {
  return row.m.is_default ? "default" : row.m.knob + " " + row.m.setting;
}

function paretoPoint(p, x, shape, label) {
  const { row, error } = p;
  return make("g", { class: "point" + (p.isDominated ? " dominated" : ""), role: "img", "aria-label": spokenOf(row, error),
                     "data-measurement": row.index },
              make("line", { class: "whisker", x1: x.place(row.m.ms.low), x2: x.place(row.m.ms.high), y1: p.y, y2: p.y }),
              make("circle", { class: "halo", cx: p.x, cy: p.y, r: 12 }),
              row.m.is_default ? make("circle", { class: "ring", cx: p.x, cy: p.y, r: 9 }) : undefined,
              make("path", { class: "mark", d: shape, transform: `translate(${p.x.toFixed(1)} ${p.y.toFixed(1)})` }),
              label ? make("text", { class: "name", ...label }, settingName(row, "tspan")) : undefined);
}

function legend(knobs, rows) {
  const items = knobs.map((knob) => {
    const row = rows.find((r) => r.m.knob === knob);
    const mark = make("path", { class: "mark", d: shapeOf(knobs, knob), transform: "translate(12 8)" });
    const ring = row.m.is_default ? [make("circle", { class: "ring", cx: 12, cy: 8, r: 7.5 })] : [];
    return make("li", {}, make("svg", { viewBox: "0 0 24 16", class: "point", "aria-hidden": "true" }, mark, ring),
                words(row.path + "/knob"));
  });
  items.push(make("li", {}, make("svg", { viewBox: "0 0 24 16", class: "point dominated", "aria-hidden": "true" },
                                 make("path", { class: "mark", d: kShapes[0], transform: "translate(12 8)" })),
                  "hollow: another is as good and faster"));
  return make("ul", { class: "legend" }, items);
}

function failures(rows) {
  const failed = rows.filter((row) => row.m.failed !== "");
  if (failed.length === 0) return undefined;
  return make("ul", { class: "missing" }, failed.map((row) => make("li", {}, "No result with ", settingName(row), ": ",
                                                                    words(row.path + "/failed"))));
}

function peersOf(workload) {
  const rows = results.peers.map((peer, k) => ({ peer, path: `/peers/${k}` })).filter((p) => p.peer.workload === workload.name);
  return rows.map(({ peer, path }) => make("p", { class: "note" }, "For comparison: ", words(path + "/name"), ", ",
      number(path + "/ms/median"), " ms", peer.errors.map((error, k) => ["; ", words(kindPath(error.kind) + "/label"), ": ",
                                                                         errorText(`${path}/errors/${k}`)]), "."));
}

function paretoFigure(workload, path) {
  const plot = make("div", { class: "plot" }), details = make("div", { class: "details", "aria-live": "polite" });
  const aside = make("div", { class: "aside" });
  const rows = rowsOf(workload.name);
  const show = (row) => details.replaceChildren(...detailsOf(row).flat(Infinity));
  const draw = (kind) => plot.replaceChildren(...paretoPlot(workload, kind, kind === workload.kinds[0], show).flat());
  const select = make("select", {}, workload.kinds.map((kind) => {
    const option = words(kindPath(kind) + "/label", "option");
    option.value = kind;
    return option;
  }));
  select.addEventListener("change", () => draw(select.value));
  draw(workload.kinds[0]);
  show(rows.find((row) => row.m.is_default));
  aside.append(details, ...[failures(rows)].filter(Boolean), ...peersOf(workload));
  return make("figure", { class: "pareto", "data-name": "pareto-" + workload.name, "aria-label": workload.what },
              make("div", {}, make("label", {}, "Error: ", select), plot), aside);
}

function priceRow(row, workload) {
  const amount = (...children) => make("td", { class: "amount" }, children);
  const isMissing = row.m.failed !== "";
  const errors = workload.kinds.map((kind) => {
    const error = errorOf(row, kind);
    return amount(error ? amountOf(error.path, "< ") : "–");
  });
  const times = [amount(number(row.path + "/ms/median"), make("span", { class: "small" }, number(row.path + "/ms/low"), " to ",
                                                              number(row.path + "/ms/high"))),
                 amount("× ", number(row.path + "/times_default")), ...errors,
                 amount(number(row.path + "/bytes", { scale: 1048576 }))];
  return make("tr", { class: row.m.is_default ? "default" : row.m.is_dominated ? "dominated" : undefined },
              make("td", { class: "setting" }, row.m.is_default ? "default " : words(row.path + "/knob"),
                   make("span", { class: "small" }, words(row.path + "/setting"))),
              make("td", { class: "loses" }, words(row.path + "/loses")),
              isMissing ? make("td", { colspan: times.length }, "no result: ", words(row.path + "/failed")) : times);
}

function priceList(workload, path) {
  const head = (name, ...more) => make("th", { scope: "col", class: "amount" }, name, more);
  const note = make("p", { class: "note" }, "Price list. Times: ", words(path + "/time_of"),
                    "; median, and below it the middle half. Memory: ", words(path + "/bytes_of"), ".");
  const table = { class: workload.kinds.length > 5 ? "wide" : undefined, "aria-label": "Price list of " + workload.name };
  return [note, make("div", { class: "scroll" }, make("table", table,
      make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "Setting"), make("th", { scope: "col" }, "What one loses"), head("ms"), head("of the default’s"),
          workload.kinds.map((kind) => head(words(kindPath(kind) + "/name"),
                                            make("span", { class: "small" }, words(kindPath(kind) + "/unit")))),
          head("MiB"))),
      make("tbody", {}, rowsOf(workload.name).map((row) => priceRow(row, workload)))))];
}
