// What figures are drawn with. Every number and name that is shown carries the place in the results that it stands at, as
// data-path; only marks along axes do not.
"use strict";

const results = JSON.parse(document.getElementById("results").textContent);

function at(path) {
  return path.split("/").slice(1).reduce((value, key) => value[key], results);
}

const kSvg = new Set(["svg", "g", "path", "rect", "line", "text", "tspan", "title", "circle", "polyline"]);

function make(tag, attributes = {}, ...children) {
  const element = kSvg.has(tag) ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (value !== undefined && value !== false) element.setAttribute(name, value);
  element.append(...children.flat(Infinity).filter((child) => child !== undefined && child !== null));
  return element;
}

const kRaised = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

// Three digits that count; all of a whole number.
function inWords(value, digits = 3) {
  if (value === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(value)));
  if (power >= -3 && power < 6) {
    const decimals = Number.isInteger(value) ? 0 : Math.max(0, digits - 1 - power);
    return value.toLocaleString("en-US", { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
  }
  const [factor, exponent] = value.toExponential(digits - 2).split("e");
  return factor + "×10" + [...String(Number(exponent))].map((c) => kRaised[c]).join("");
}

// The number at a place, in units of `scale`.
function number(path, { scale = 1, digits = 3, tag = "span" } = {}) {
  return make(tag, { "data-path": path, "data-scale": scale === 1 ? undefined : scale }, inWords(at(path) / scale, digits));
}

// The words at a place.
function words(path, tag = "span") {
  return make(tag, { "data-path": path }, at(path));
}

function kindPath(name) {
  return `/kinds/${results.kinds.findIndex((kind) => kind.name === name)}`;
}

// An error is a number, or less than what its reference can tell from none.
function amountOf(path, below = "below ") {
  const error = at(path);
  return error.value > error.resolution ? number(path + "/value") : [below, number(path + "/resolution", { digits: 2 })];
}

function errorText(path) {
  return [amountOf(path), " ", words(kindPath(at(path).kind) + "/unit")];
}

// In pixels, so that letters keep their size in narrow windows.
const kBounds = { width: Math.min(720, Math.max(320, window.innerWidth - 32)), height: 400, left: 66, right: 20, top: 26, bottom: 46 };

function scaleOf(values, from, to, isLogarithmic) {
  let low = Math.min(...values), high = Math.max(...values);
  if (isLogarithmic) {
    low = Math.log10(low);
    high = Math.log10(high);
    const slack = Math.max(0.06 * (high - low), (0.6 - high + low) / 2); // what differs by little looks alike
    const place = (v) => from + ((Math.log10(v) - low + slack) / (high - low + 2 * slack)) * (to - from);
    return { place, ticks: logarithmicTicks(low - slack, high + slack), isLogarithmic };
  }
  const top = high * 1.05, step = niceStep(top / 8);
  const ticks = [];
  for (let v = 0; v <= top; v += step) ticks.push(Number(v.toPrecision(12)));
  return { place: (v) => from + (v / top) * (to - from), ticks, isLogarithmic };
}

function niceStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough);
}

function logarithmicTicks(low, high) {
  const decades = high - low;
  const factors = decades < 1 ? [1, 1.5, 2, 3, 5, 7] : decades < 2.5 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / 7));
  const ticks = [];
  for (let power = Math.floor(low); power <= high; ++power)
    for (const factor of factors) {
      const place = power + Math.log10(factor);
      if (place >= low && place <= high && (decades < 2.5 || power % every === 0)) ticks.push(factor * 10 ** power);
    }
  return ticks;
}

function tickText(tick) {
  const size = Math.abs(tick);
  if (size === 0 || (size >= 1e-3 && size < 1e6)) return tick.toLocaleString("en-US", { maximumSignificantDigits: 4 });
  const [factor, exponent] = tick.toExponential(3).split("e");
  return Number(factor) + "×10" + [...String(Number(exponent))].map((c) => kRaised[c]).join("");
}

function axes(x, y, labels, top = kBounds.top) {
  const b = kBounds, parts = [];
  for (const tick of x.ticks)
    parts.push(make("line", { class: "grid", x1: x.place(tick), x2: x.place(tick), y1: top, y2: b.height - b.bottom }),
               make("text", { "data-tick": tick, x: x.place(tick), y: b.height - b.bottom + 17, "text-anchor": "middle" },
                    tickText(tick)));
  for (const tick of y.ticks)
    parts.push(make("line", { class: "grid", x1: b.left, x2: b.width - b.right, y1: y.place(tick), y2: y.place(tick) }),
               make("text", { "data-tick": tick, x: b.left - 7, y: y.place(tick) + 4, "text-anchor": "end" },
                    tickText(tick)));
  parts.push(make("text", { x: b.width - b.right, y: b.height - 8, "text-anchor": "end" }, labels.x));
  if (labels.y) parts.push(make("text", { x: b.left, y: top - 12, "text-anchor": "start" }, labels.y));
  return parts;
}

function polygon(corners, radius, turn = -Math.PI / 2, inner = 1) {
  const points = [];
  const count = inner === 1 ? corners : 2 * corners;
  for (let k = 0; k < count; ++k) {
    const r = k % 2 === 1 && inner !== 1 ? inner * radius : radius, angle = turn + (2 * Math.PI * k) / count;
    points.push((r * Math.cos(angle)).toFixed(2) + " " + (r * Math.sin(angle)).toFixed(2));
  }
  return "M" + points.join("L") + "Z";
}

// Told apart without color.
const kShapes = [
  polygon(24, 5), polygon(4, 6, -Math.PI / 4), polygon(3, 6.5), polygon(4, 6.5), polygon(3, 6.5, Math.PI / 2),
  "M-6-2H-2V-6H2V-2H6V2H2V6H-2V2H-6Z", polygon(5, 7, -Math.PI / 2, 0.4), polygon(6, 6), "M-6-5L6 5V-5L-6 5Z",
  polygon(4, 7.5, -Math.PI / 2, 0.35), "M-6-2H6V2H-6Z", "M-2-6H2V6H-2Z", polygon(8, 6.5, 0, 0.6),
];

function shapeOf(names, name) {
  return kShapes[names.indexOf(name) % kShapes.length];
}

// One stop of the tab key for all points; arrow keys walk from one to the next.
function walkable(points, show) {
  const go = (k) => {
    points.forEach((point, other) => point.setAttribute("tabindex", other === k ? "0" : "-1"));
    points[k].focus();
  };
  points.forEach((point, k) => {
    point.setAttribute("tabindex", k === 0 ? "0" : "-1");
    const choose = () => {
      points.forEach((other) => other.classList.toggle("chosen", other === point));
      show(k);
    };
    point.addEventListener("focus", choose);
    point.addEventListener("pointerenter", choose);
    point.addEventListener("click", () => go(k));
    point.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      const to = event.key === "Home" ? 0 : event.key === "End" ? points.length - 1 : step && k + step;
      if (to === undefined || to < 0 || to >= points.length) return;
      event.preventDefault();
      go(to);
    });
  });
}
