// The button that records live frames, and the notice about the recording over the view.
const byId = (id) => document.getElementById(id);
const kSavedMs = 20000;  // how long the page shows where a recording was saved
const kHow = "Recording is off. Start Barehand with --view-record DIR, or barehand view --lcm with --record DIR.";

const clock = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
const size = (bytes) => bytes < 1e9 ? `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
const dropped = (record) => record.dropped > 0 ? `, ${record.dropped} dropped` : "";

export class Recorder {
  // send({type, on}) sends a command to the program.
  constructor(send) {
    this.send = send;
    this.record = null;
    byId("record").onclick = () => this.press();
  }

  get on() { return this.record !== null && this.record.recording; }

  press() {
    if (!this.record) return;
    if (this.record.folder === "") return this.say(kHow, "warn");
    this.send({type: "record", on: !this.on});
  }

  // `record`: the recorder's state in the status; null: there is nothing to record.
  show(record) {
    const before = this.record;
    this.record = record || null;
    byId("record").hidden = this.record === null;
    if (!this.record) return this.say("");
    byId("record").textContent = this.on ? "Stop recording" : "Record";
    byId("record").setAttribute("aria-pressed", String(this.on));
    byId("record").classList.toggle("off", record.folder === "");
    if (this.on) return this.say(`● ${clock(record.seconds)}  ${record.frames} frames, ${size(record.bytes)}${dropped(record)}`, "lost");
    if (record.writing) return this.say("Saving …");
    if (record.failed) return this.say(record.note, "lost");
    const news = before && (before.writing || before.file !== record.file || before.note !== record.note);
    if (news) this.say(this.saved(record), "good", kSavedMs);
  }

  saved(record) {
    const where = record.file === "" ? "" : `Saved ${record.file} in ${record.folder}: ${record.frames} frames, ` +
      `${clock(record.seconds)}, ${size(record.bytes)}${dropped(record)}.`;
    return [record.note, where].filter(Boolean).join(" ");
  }

  // Shows a sentence over the view; "" hides it. `ms`: for how long; 0: until the next call.
  say(text, state = "quiet", ms = 0) {
    clearTimeout(this.timer);
    const box = byId("recording");
    box.hidden = text === "";
    box.textContent = text;
    box.dataset.state = state;
    if (ms > 0) this.timer = setTimeout(() => this.say(""), ms);
  }
}
