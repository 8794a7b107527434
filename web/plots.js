// Plots of the last seconds, one small row for each finger, glove channel or speed.
import {kGloveChannels} from "./lcm.js";

const kSeconds = 10, kDegree = 180 / Math.PI;
const kColours = {light: ["#0f766e", "#c2410c", "#4f46e5", "#8a6d00"], dark: ["#2dd4bf", "#fb923c", "#a5b4fc", "#e5c453"]};
const kFingers = ["thumb", "index", "middle", "ring", "little"];

const norm = (v) => Math.hypot(...v);

// The rows of every plot: {name, lines: [[name, value(sample)], ...], low, high, unit}.
const kPlots = {
  joints: kFingers.map((finger, f) => ({
    name: finger, low: -30, high: 110, unit: "°",
    lines: (f === 0 ? [["cmc", 0], ["mcp", 2], ["ip", 4], ["abd", 1]]
                    : [["mcp", 1 + 4 * f], ["pip", 3 + 4 * f], ["dip", 4 + 4 * f], ["abd", 2 + 4 * f]])
      .map(([name, joint]) => [name, (s) => s.glove.joint_angle[joint] * kDegree]),
  })),
  glove: kGloveChannels.slice(0, 19).map((name, c) => ({
    name, low: -30, high: 110, unit: "°", slim: true, lines: [["", (s) => s.glove.channel[c] * kDegree]],
  })),
  speeds: [["palm", 0], ...kFingers.map((finger, f) => [`${finger} tip`, 3 + 3 * f])].map(([name, segment]) => ({
    name, low: 0, high: 1, unit: " m/s", lines: [["", (s) => norm(s.state.segments[segment].linear_velocity)]],
  })),
};

export class Plots {
  constructor(canvas) {
    this.canvas = canvas;
    this.samples = [[], []];  // samples of the left hand (0) and of the right hand (1)
    this.kind = "joints";
    this.side = 1;
  }

  // Stores the states of a frame. If time goes back, as after seeking in a log, the earlier samples are deleted.
  add(frame) {
    const time = frame.header.utime * 1e-6;
    for (const side of [0, 1]) {
      const samples = this.samples[side];
      if (samples.length > 0 && samples[samples.length - 1].time > time) samples.length = 0;
      const state = frame.states.find((s) => s.handedness === side), glove = frame.gloves.find((g) => g.handedness === side);
      if (state) samples.push({time, state, glove, known: state.has_pose && glove !== undefined});
      while (samples.length > 0 && time - samples[0].time > kSeconds) samples.shift();
    }
    if (this.samples[this.side].length === 0 && this.samples[1 - this.side].length > 0) this.side = 1 - this.side;
  }

  draw(theme) {
    const rows = kPlots[this.kind], ratio = window.devicePixelRatio || 1;
    const columns = rows[0].slim ? 2 : 1, rowHeight = rows[0].slim ? 34 : rows.length > 5 ? 46 : 56;
    const width = this.canvas.clientWidth, height = Math.ceil(rows.length / columns) * rowHeight;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
      this.canvas.style.height = `${height}px`;
    }
    const draw = this.canvas.getContext("2d"), colours = getComputedStyle(document.documentElement);
    this.ink = {text: colours.getPropertyValue("--text"), quiet: colours.getPropertyValue("--quiet"),
                line: colours.getPropertyValue("--line"), lines: kColours[theme]};
    draw.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw.clearRect(0, 0, width, height);
    draw.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    const cell = width / columns;
    rows.forEach((row, i) => this.drawRow(draw, row, {x: (i % columns) * cell, y: Math.floor(i / columns) * rowHeight,
                                                      width: cell - (columns > 1 ? 8 : 0), height: rowHeight - 5}));
  }

  drawRow(draw, row, box) {
    const samples = this.samples[this.side], textHeight = 14;
    const top = box.y + textHeight, bottom = box.y + box.height;
    const last = samples.length > 0 ? samples[samples.length - 1] : null;
    const y = (value) => bottom - (Math.min(Math.max(value, row.low), row.high) - row.low) / (row.high - row.low) * (bottom - top);
    const x = (time) => box.x + box.width * (1 - (last.time - time) / kSeconds);
    draw.strokeStyle = this.ink.line;
    draw.lineWidth = 1;
    draw.strokeRect(box.x + 0.5, top + 0.5, box.width - 1, bottom - top - 1);
    if (row.low < 0) this.path(draw, [[box.x, y(0)], [box.x + box.width, y(0)]]);
    draw.fillStyle = this.ink.text;
    draw.fillText(row.name, box.x, box.y + 10);

    let right = box.x + box.width;
    [...row.lines.entries()].reverse().forEach(([k, [name, value]]) => {
      draw.strokeStyle = draw.fillStyle = this.ink.lines[k];
      draw.lineWidth = 1.4;
      if (last) this.curve(draw, samples, x, (s) => y(value(s)), value);
      const now = last && last.known ? value(last) : NaN;
      const digits = row.unit === "°" ? 0 : 2;
      const shown = now.toFixed(digits).replace(/^-(0(\.0+)?)$/, "$1");  // no minus zero
      const text = `${name} ${Number.isFinite(now) ? shown + row.unit : "–"}`;
      right -= row.lines.length > 1 ? 62 : 0;
      draw.textAlign = row.lines.length > 1 ? "left" : "right";
      draw.fillText(text, right, box.y + 10);
      draw.textAlign = "left";
    });
  }

  path(draw, points) {
    draw.beginPath();
    points.forEach(([px, py], i) => i === 0 ? draw.moveTo(px, py) : draw.lineTo(px, py));
    draw.stroke();
  }

  // Draws a curve with gaps at unknown values.
  curve(draw, samples, x, y, value) {
    draw.beginPath();
    let pen = false;
    for (const sample of samples) {
      const known = sample.known && Number.isFinite(value(sample));
      if (known && pen) draw.lineTo(x(sample.time), y(sample));
      else if (known) draw.moveTo(x(sample.time), y(sample));
      pen = known;
    }
    draw.stroke();
  }
}
