// The panel of a calibration: how well each segment was seen and what is still to be shown to the sensor and, at the
// end, how the lengths of the hand have changed.
const byId = (id) => document.getElementById(id);
const kFingers = ["thumb", "index", "middle", "ring", "little"];
const kDegree = 180 / Math.PI;

function element(tag, text, attributes = {}, children = []) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const words = (name) => name.replaceAll("_", " ");

// A sentence of the program in which whole fingers are named instead of their three segments: "Show the back of: palm,
// index finger."
function sentence(text) {
  const whole = kFingers.map((finger, f) => f === 0 ? finger : `${finger} finger`);
  let short = text.replace("thumb_metacarpal, thumb_proximal, thumb_distal", whole[0]);
  kFingers.slice(1).forEach((finger, f) => {
    short = short.replace(`${finger}_proximal, ${finger}_intermediate, ${finger}_distal`, whole[f + 1]);
  });
  short = short.replace(`palm, ${whole.join(", ")}`, "the whole hand").replace(whole.slice(1).join(", "), "all four fingers");
  return `${words(short[0].toUpperCase() + short.slice(1))}.`;
}

const millimetres = (metres) => (metres * 1e3).toFixed(1);

// The views and the bending that a scan needs of a segment, as a list of [name, fraction that was seen, text].
function partsOf(segment, scan) {
  const share = (value, enough) => Math.min(1, value / enough);
  const parts = [["palm side", share(segment.palm_side, scan.enough_frames), `${segment.palm_side} of ${scan.enough_frames} frames`],
                 ["back", share(segment.back_side, scan.enough_frames), `${segment.back_side} of ${scan.enough_frames} frames`]];
  if (segment.to_bend) parts.push(["bent", share(segment.bent, scan.enough_bending),
    `${(segment.bent * kDegree).toFixed(0)}° of ${(scan.enough_bending * kDegree).toFixed(0)}°`]);
  return parts;
}

// The fraction of each segment that was seen, which colours the hand; null: no scan is in progress.
export function coverage(scan) {
  if (!scan || scan.phase !== "showing") return null;
  return scan.segments.map((segment) => {
    const parts = partsOf(segment, scan);
    return parts.reduce((sum, [, share]) => sum + share, 0) / parts.length;
  });
}

function cell(segment, scan) {
  const parts = partsOf(segment, scan), complete = parts.every(([, share]) => share === 1);
  const bars = parts.map(([, share]) => {
    const filled = element("b", "");
    filled.style.width = `${(100 * share).toFixed(0)}%`;
    return element("i", "", {class: share === 1 ? "full" : ""}, [filled]);
  });
  const text = `${words(segment.name)}: ${parts.map(([what, , figure]) => `${what} ${figure}`).join(", ")}`;
  return element("div", "", {class: complete ? "cell complete" : "cell", title: text, "aria-label": text, role: "img"}, bars);
}

function seen(scan) {
  const grid = element("div", "", {class: "seen"});
  grid.append(element("span", ""), ...["root", "middle", "tip"].map((text) => element("span", text, {class: "quiet"})));
  kFingers.forEach((finger, f) => grid.append(element("span", finger),
    ...[1, 2, 3].map((phalanx) => cell(scan.segments[3 * f + phalanx], scan))));
  grid.append(element("span", "palm"), cell(scan.segments[0], scan));
  return grid;
}

function lengths(scan) {
  const table = element("table", "", {}, [element("tr", "", {}, ["segment", "before", "now", "change"].map((text) => element("th", text)))]);
  for (const segment of scan.segments) {
    const change = Number(millimetres(segment.after - segment.before));
    table.append(element("tr", "", {}, [words(segment.name), `${millimetres(segment.before)} mm`, `${millimetres(segment.after)} mm`,
      `${change < 0 ? "−" : change > 0 ? "+" : ""}${Math.abs(change).toFixed(1)}`].map((text) => element("td", text))));
  }
  return table;
}

// Shows the panel. `scan`: the state of the scan in the status; null: there is none.
export function showScan(scan) {
  byId("scan").hidden = scan === null;
  byId("legend_what").textContent = coverage(scan) ? "shown 0" : "confidence 0";
  if (!scan) return;
  const advice = {
    showing: scan.missing.length > 0 ? scan.missing.map(sentence) : ["Every part of the hand was seen. End the scan with Ctrl-C."],
    measuring: [scan.progress],
    done: [scan.progress, ...(scan.missing.length > 0
      ? ["Not everything was seen well enough. What was not stays close to the initial hand. To measure it:"] : []),
    ...scan.missing.map(sentence)],
  }[scan.phase];
  const help = scan.phase === "showing" ? [element("p", scan.how_to, {class: "quiet"})] : [];
  const key = element("div", "Bars, from above: palm side, back, bent.", {class: "quiet"});
  byId("scan_state").textContent = {showing: `${scan.frames} frames`, measuring: "measuring", done: "done"}[scan.phase];
  byId("scan_body").replaceChildren(
    ...advice.map((text, i) => element("p", text, {class: i === 0 ? "advice" : "quiet"})),
    ...(scan.phase === "done" ? [lengths(scan)] : [seen(scan), key]), ...help);
}
