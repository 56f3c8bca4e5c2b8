// The page, part by part.
"use strict";

const section = (id) => document.getElementById(id);

const kFamilies = {
  fracture: "Fracture", colliders: "Colliders", patterns: "Patterns of sites", dynamics: "Dynamics",
};

function showLead() {
  if (results.measurements.length === 0) {
    section("lead").append("Nothing but hard cases was run, on ", words("/machine/device"), ", ", words("/machine/date"), " UTC. " +
        "What accuracy costs in time, brittle accuracy measures.");
    return;
  }
  section("lead").append("Every knob of Brittle that trades accuracy for time, turned alone and some two at a time, on ",
      words("/machine/device"), ", ", words("/machine/date"), " UTC. Below and to the left is better. ",
      at("/machine/is_quick") ? "A quick run: small workloads, few rounds." : "");
}

function showUseful() {
  const lines = results.useful.map((line, k) => make("li", {}, words(`/useful/${k}/text`), ". ",
      words(`/measurements/${line.measurement}/loses`)));
  section("useful").querySelector("ol").append(...lines);
}

function showFamilies() {
  const families = [...new Set(results.workloads.map((w) => w.family))];
  for (const family of families) {
    section("families").append(make("h2", { id: family }, kFamilies[family] ?? family));
    results.workloads.forEach((workload, k) => {
      if (workload.family !== family) return;
      const path = `/workloads/${k}`;
      section("families").append(make("article", { class: "workload" },
          make("header", {}, words(path + "/name", "h3"), words(path + "/what", "p")), paretoFigure(workload, path),
          priceList(workload, path)));
    });
  }
}

const kDashes = ["", "7 4", "2 3", "10 3 2 3", "1 5"];

// `how`: the coordinates of a point, the axes, and what is said of the point at a place.
function lineFigure(figure, path, how) {
  const b = kBounds, all = figure.series.flatMap((s) => s.points);
  const x = scaleOf(all.map(how.x), b.left, b.width - b.right, how.isLogarithmicX);
  const y = scaleOf(all.map(how.y), b.height - b.bottom, b.top, how.isLogarithmicY);
  const details = make("div", { class: "details", "aria-live": "polite" });
  const points = [], sources = [], lines = [];
  figure.series.forEach((series, s) => {
    const corners = series.points.map((p) => `${x.place(how.x(p))},${y.place(how.y(p))}`).join(" ");
    lines.push(make("polyline", { class: "line", points: corners, "stroke-dasharray": kDashes[s % kDashes.length] }));
    series.points.forEach((p, k) => {
      sources.push({ s, path: `${path}/series/${s}/points/${k}` });
      points.push(make("g", { class: "point", role: "img", "aria-label": `${series.label}: ${how.spoken(p)}` },
                       make("circle", { class: "halo", cx: x.place(how.x(p)), cy: y.place(how.y(p)), r: 11 }),
                       make("path", { class: "mark", d: kShapes[s],
                                      transform: `translate(${x.place(how.x(p))} ${y.place(how.y(p))}) scale(.8)` })));
    });
  });
  const show = (k) => details.replaceChildren(words(`${path}/series/${sources[k].s}/label`), ": ", ...how.shown(sources[k].path));
  walkable(points, show);
  show(0);
  return make("figure", { "data-name": how.name }, words(path + "/title", "h3"),
              make("svg", { viewBox: `0 0 ${b.width} ${b.height}`, role: "group",
                            "aria-label": figure.title + "; arrow keys walk along the points" },
                   axes(x, y, how.labels), lines, points),
              seriesLegend(figure, path), details, words(path + "/caption", "figcaption"), how.endings);
}

function timeFigure(figure, path) {
  return lineFigure(figure, path, {
    name: "time-" + figure.name, x: (p) => p.sites, y: (p) => p.ms.median,
    isLogarithmicX: figure.is_logarithmic, isLogarithmicY: figure.is_logarithmic,
    labels: { x: "sites", y: "ms, whole break" },
    spoken: (p) => `${inWords(p.sites)} sites, ${inWords(p.ms.median)} milliseconds`,
    shown: (at) => [number(at + "/sites"), " sites, ", number(at + "/ms/median"), " ms (", number(at + "/ms/low"), " to ",
                    number(at + "/ms/high"), ")"],
    endings: endings(figure, path),
  });
}

function curveFigure(curve, path) {
  return lineFigure(curve, path, {
    name: "curve-" + curve.name, x: (p) => p.x, y: (p) => p.y,
    isLogarithmicX: curve.is_logarithmic_x, isLogarithmicY: curve.is_logarithmic_y,
    labels: { x: words(path + "/x_label", "tspan"), y: words(path + "/y_label", "tspan") },
    spoken: (p) => `${curve.x_label} ${inWords(p.x)}, ${curve.y_label} ${inWords(p.y)}`,
    shown: (at) => [words(path + "/x_label"), " ", number(at + "/x"), ", ", words(path + "/y_label"), " ", number(at + "/y")],
  });
}

function seriesLegend(figure, path) {
  return make("ul", { class: "legend" }, figure.series.map((series, s) => make("li", {},
      make("svg", { viewBox: "0 0 24 16", class: "point", "aria-hidden": "true" },
           make("line", { class: "line", x1: 0, x2: 24, y1: 8, y2: 8, "stroke-dasharray": kDashes[s % kDashes.length] }),
           make("path", { class: "mark", d: kShapes[s], transform: "translate(12 8) scale(.8)" })),
      words(`${path}/series/${s}/label`))));
}

function endings(figure, path) {
  const ended = figure.series.map((series, s) => ({ series, s })).filter(({ series }) => series.ended !== "");
  if (ended.length === 0) return undefined;
  return make("ul", { class: "missing" }, ended.map(({ s }) => make("li", {}, words(`${path}/series/${s}/label`), " goes no further: ",
                                                                     words(`${path}/series/${s}/ended`))));
}

// Stages down, numbers of sites across; the longest bar is the whole.
function sharesTable() {
  const stages = [...new Set(results.shares.flatMap((shares) => shares.stages.map((stage) => stage.stage)))];
  const cell = (k, name) => {
    const s = results.shares[k].stages.findIndex((stage) => stage.stage === name);
    if (s < 0) return make("td", { class: "share" }, "–");
    const all = results.shares[k].stages.reduce((sum, stage) => sum + stage.ms, 0);
    const bar = make("i");
    bar.style.width = (100 * results.shares[k].stages[s].ms) / all + "%";
    return make("td", { class: "share" }, number(`/shares/${k}/stages/${s}/ms`), bar);
  };
  const chosen = results.shares.map((shares, k) => k).filter((k) => {
    const sites = results.shares[k].sites;
    return sites === 10 || Math.log10(sites) % 1 === 0;
  });
  const named = (name) => {
    const k = results.shares.findIndex((shares) => shares.stages.some((stage) => stage.stage === name));
    return words(`/shares/${k}/stages/${results.shares[k].stages.findIndex((stage) => stage.stage === name)}/stage`);
  };
  return make("div", { class: "scroll", "data-name": "shares" }, make("h3", {}, "The share of each part"), make("table", {},
      make("caption", {}, "Milliseconds on the device, by stage and number of sites, even sites found by grid; bars are shares of the column."),
      make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "Stage"),
                             chosen.map((k) => make("th", { scope: "col" }, number(`/shares/${k}/sites`), " sites")))),
      make("tbody", {}, stages.map((name) => make("tr", {}, make("td", {}, named(name)), chosen.map((k) => cell(k, name)))))));
}

function showFigures() {
  section("figures").append(make("div", { class: "pair" }, results.figures.map((figure, k) => timeFigure(figure, `/figures/${k}`))),
                            results.shares.length > 0 ? sharesTable() : "");
}

function showCurves() {
  section("curves").append(make("div", { class: "pair" }, results.curves.map((curve, k) => curveFigure(curve, `/curves/${k}`))));
}

function showPictures() {
  section("pictures").hidden = results.pictures.length === 0;
  results.pictures.forEach((pair, k) => {
    const path = `/pictures/${k}`;
    const shown = (name, alt, ...caption) => make("figure", {}, make("img", { src: pair[name], alt, "data-path": `${path}/${name}` }),
                                                  make("figcaption", {}, caption));
    section("pictures").append(words(path + "/title", "h3"), words(path + "/caption", "p"), make("div", { class: "triple" },
        shown("cheap", pair.title + ", cheapest", "Cheapest, ", number(path + "/cheap_ms"), " ms: ", words(path + "/cheap_setting")),
        shown("dear", pair.title + ", dearest", "Dearest, ", number(path + "/dear_ms"), " ms: ", words(path + "/dear_setting")),
        shown("marked", "Where the two differ", "Where they differ, dark: ",
              number(path + "/differing_share", { scale: 0.01 }), " % of the picture")));
  });
}

function lawFigure(law, path) {
  const b = kBounds;
  const x = scaleOf([law.bins.at(-1).to / 1.05], b.left, b.width - b.right, false);
  const y = scaleOf(law.bins.flatMap((bin) => [bin.measured, bin.law]), b.height - b.bottom, b.top, false);
  const bars = law.bins.map((bin) => make("rect", { class: "bar", x: x.place(bin.from), y: y.place(bin.measured),
      width: x.place(bin.to) - x.place(bin.from), height: y.place(0) - y.place(bin.measured) }));
  const line = law.bins.map((bin) => `${x.place((bin.from + bin.to) / 2)},${y.place(bin.law)}`).join(" ");
  return make("figure", { "data-name": "law" }, words(path + "/title", "h3"),
              make("svg", { viewBox: `0 0 ${b.width} ${b.height}`, role: "img", "aria-label": law.title },
                   axes(x, y, { x: words(path + "/quantity", "tspan"), y: "density" }), bars, make("polyline", { class: "line", points: line })),
              make("figcaption", {}, "Bars: ", number(path + "/count"), " measured. Line: ", words(path + "/law"), " (",
                   words(path + "/source"), "). The two distributions are ",
                   law.distance > law.resolution ? ["", number(path + "/distance"), " apart at most; so many tell "]
                                                 : ["less apart than ", number(path + "/resolution"), ", which is what so many tell "],
                   law.distance > law.resolution ? [number(path + "/resolution"), " from none."] : "from none."));
}

function showLaws() {
  section("laws").append(make("div", { class: "pair" }, results.laws.map((law, k) => lawFigure(law, `/laws/${k}`))));
}

// Cases down, settings across; those that have settings in common stand in one table.
function hardTable(cases) {
  const names = [...new Set(cases.map((one) => one.name))], settings = [...new Set(cases.map((one) => one.setting))];
  const pathOf = (test) => `/hard/${results.hard.findIndex(test)}`;
  const cell = (name, setting) => {
    const one = cases.find((each) => each.name === name && each.setting === setting);
    if (!one) return make("td", {}, "–");
    const path = pathOf((each) => each === one);
    const verdict = !one.has_passed ? "fails" : one.is_known_shortfall ? "short" : "passes";
    const measured = one.why !== "" ? words(path + "/why")
        : [words(path + "/worst_kind"), " ", number(path + "/worst_error"), " of ", number(path + "/allowed"), " ", words(path + "/unit")];
    return make("td", { class: verdict }, verdict, make("span", { class: "small" }, measured),
                make("span", { class: "small" }, one.exact_tests > 0 ? [number(path + "/exact_tests"), " cells cut again exactly, "] : "",
                     number(path + "/ms"), " ms"));
  };
  return make("div", { class: "scroll" }, make("table", { class: "even" },
      make("thead", {}, make("tr", {}, make("th", {}, "Case"),
          settings.map((setting) => make("th", {}, words(pathOf((each) => each.setting === setting) + "/setting"))))),
      make("tbody", {}, names.map((name) => make("tr", {}, make("td", {}, words(pathOf((each) => each.name === name) + "/name")),
                                                 settings.map((setting) => cell(name, setting)))))));
}

function showHard() {
  section("hard").hidden = results.hard.length === 0;
  const settingsOf = (one) => results.hard.filter((each) => each.name === one.name).map((each) => each.setting).join();
  const groups = Map.groupBy(results.hard, settingsOf);
  section("hard").append(...[...groups.values()].map(hardTable));
}

function showMachine() {
  const rows = [
    ["Device", words("/machine/device")], ["Driver", words("/machine/driver")],
    ["Processor", [words("/machine/processor"), ", ", number("/machine/cores"), " cores, ", number("/machine/memory_gib"), " GiB"]],
    ["System", words("/machine/system")],
    ["Brittle", [words("/machine/brittle"), ", commit ", words("/machine/commit"), ", ", words("/machine/compiler")]],
    ["When", [words("/machine/date"), " UTC, with a load of ", number("/machine/load_before"), " by other programs before"]],
    ["How long", [number("/machine/seconds"), " s, ", number("/machine/processor_seconds"), " s of processors: ",
                  results.parts.map((part, k) => [k > 0 ? ", " : "", words(`/parts/${k}/part`), " ", number(`/parts/${k}/seconds`),
                                                  " s"]).flat()]],
    ["Rounds", [number("/machine/rounds"), " of fracture and ", number("/machine/scene_rounds"),
                " of scenes at least, all settings in turn in each"]],
  ];
  section("machine").append(make("table", {}, make("tbody", {}, rows.map(([name, value]) =>
      make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, value))))));
}

function showReferences() {
  if (results.measurements.length > 0 && results.peers.length === 0)
    section("references").append(make("p", { class: "note" }, "No other library was measured: CGAL is a program of its own, " +
        "brittle_peer_cgal, which tools/accuracy.sh builds beside brittle."));
  section("references").append(make("div", { class: "scroll" }, make("table", {},
      make("thead", {}, make("tr", {}, ["Kind", "Error", "Unit", "Reference"].map((name) => make("th", { scope: "col" }, name)))),
      make("tbody", {}, results.kinds.map((kind, k) => make("tr", {},
          ["name", "label", "unit", "reference"].map((name) => words(`/kinds/${k}/${name}`, "td"))))))));
}

// Of results in which a part was not measured.
function hideEmpty() {
  for (const part of document.querySelectorAll("main > section"))
    if ([...part.children].every((child) => child.tagName === "H2" || child.children.length === 0)) part.hidden = true;
}

function showContents() {
  for (const heading of document.querySelectorAll("main h2")) {
    const place = heading.id || heading.parentElement.id;
    if (!heading.closest("[hidden]")) section("contents").append(make("a", { href: "#" + place }, heading.textContent));
  }
}

// report.html#only=NAME shows nothing but the figure of that name.
function showAlone() {
  const name = /^#only=(.+)$/.exec(decodeURIComponent(location.hash));
  const figure = name && document.querySelector(`[data-name="${CSS.escape(name[1])}"]`);
  if (!figure) return;
  const chosen = figure.querySelector("option:checked");
  document.body.replaceChildren(make("div", { class: "alone" }, chosen ? words(chosen.dataset.path, "h3") : [], figure));
}

for (const show of [showLead, showUseful, showFamilies, showFigures, showCurves, showPictures, showLaws, showHard, showMachine,
                    showReferences, hideEmpty, showContents, showAlone])
  show();
