// The timeline of a log that is played: its position, and where the hand was lost.
const byId = (id) => document.getElementById(id);

export class Timeline {
  // send({type, value}) sends a command to the program.
  constructor(send) {
    this.send = send;
    this.log = null;
    byId("play").onclick = () => this.toggle();
    byId("step_back").onclick = () => this.step(-1);
    byId("step_on").onclick = () => this.step(1);
    byId("lost_before").onclick = () => this.lost(-1);
    byId("lost_next").onclick = () => this.lost(1);
    byId("speed").onchange = () => send({type: "speed", value: Number(byId("speed").value)});
    byId("position").oninput = () => send({type: "seek", value: Number(byId("position").value)});
  }

  get active() { return this.log !== null; }
  toggle() { this.send({type: this.log && this.log.playing ? "pause" : "play"}); }
  step(frames) { this.send({type: "step", value: frames}); }
  lost(direction) { this.send({type: "lost", value: direction}); }

  // `log`: of the status; null: no log is played.
  show(log) {
    this.log = log;
    byId("timeline").hidden = log === null;
    if (!log) return;
    byId("position").max = Math.max(0, log.frames - 1);
    byId("play").textContent = log.playing ? "❚❚" : "▶";
    byId("speed").value = String(log.speed);
    this.mark();
  }

  // Shows the place of the frame that is shown (null: none yet). It may be older than that of the status, which a slow
  // browser gets before the frame.
  place(frame) {
    const log = this.log;
    if (!log || !frame || !frame.place) return;
    const {position, at} = frame.place;
    if (document.activeElement !== byId("position") || log.playing) byId("position").value = position;
    byId("lost_before").disabled = !log.lost.some(([first]) => first < position);
    byId("lost_next").disabled = !log.lost.some(([first]) => first > position);
    const lost = log.lost.reduce((sum, [first, last]) => sum + last - first + 1, 0);
    const hands = lost > 0 ? `${lost} frames without a hand` : frame.states.length > 0 ? "a hand in every frame" : "no states of hands";
    byId("log_time").textContent = `frame ${position + 1} of ${log.frames}, ${at.toFixed(2)} s of ${log.seconds.toFixed(2)} s; ${hands}`;
  }

  // Marks where the hand was lost, in the colours of the theme.
  mark() {
    const log = this.log;
    if (!log) return;
    const canvas = byId("lost_marks"), draw = canvas.getContext("2d");
    canvas.width = canvas.clientWidth;
    canvas.height = 10;
    const style = getComputedStyle(document.documentElement);
    const x = (frame) => canvas.width * frame / Math.max(1, log.frames - 1);  // where the middle of the slider's knob is
    draw.fillStyle = style.getPropertyValue("--good");
    draw.fillRect(0, 3, canvas.width, 4);
    draw.fillStyle = style.getPropertyValue("--bad");
    for (const [first, last] of log.lost) {
      const left = x(first - 0.5), width = Math.max(2, x(last + 0.5) - left);
      draw.clearRect(left, 0, width, 10);
      draw.fillRect(left, 1, width, 8);
    }
  }
}
