// Shows the sensor's image with the skeleton of the hands drawn over it.
const kFingerColours = ["#e64980", "#f59f00", "#40c057", "#228be6", "#9c5cf0"];

export class Picture {
  constructor(canvas, note) {
    this.canvas = canvas;
    this.note = note;
    this.plain = document.createElement("canvas");  // the image without the skeleton, for the view from the sensor
  }

  // Decodes the frame's image; resolves when it can be shown.
  async decode(frame) {
    if (frame.picture) frame.picture.image = await createImageBitmap(frame.picture.jpeg).catch(() => null);
  }

  // Frees the image of a frame that will not be shown again.
  release(frame) {
    if (frame.picture && frame.picture.image) frame.picture.image.close();
  }

  // Draws the image with the skeleton. `plain`: also draws it without the skeleton, to `this.plain`.
  show(frame, smoothed, plain) {
    const image = frame.picture && frame.picture.image;
    if (!image) return;
    for (const canvas of plain ? [this.plain, this.canvas] : [this.canvas]) {
      if (canvas.width !== image.width || canvas.height !== image.height) {
        canvas.width = image.width;
        canvas.height = image.height;
      }
      canvas.getContext("2d").drawImage(image, 0, 0);
    }
    for (const state of frame.states) if (state.has_pose) this.drawSkeleton(state, frame.header, smoothed);
  }

  drawSkeleton(state, header, smoothed) {
    const draw = this.canvas.getContext("2d"), scale = this.canvas.width / header.width;
    const pixel = ([x, y, z]) => [(header.fx * x / z + header.cx + 0.5) * scale, (header.fy * y / z + header.cy + 0.5) * scale];
    draw.lineCap = "round";
    state.segments.forEach((segment, s) => {
      const from = pixel(smoothed ? segment.smoothed_position : segment.position);
      const to = pixel(smoothed ? segment.smoothed_distal : segment.distal);
      draw.strokeStyle = s === 0 ? "#ffffff" : kFingerColours[Math.floor((s - 1) / 3)];
      draw.setLineDash(segment.seen ? [] : [3, 5]);
      draw.lineWidth = Math.max(2, this.canvas.width / 200);
      draw.beginPath();
      draw.moveTo(...from);
      draw.lineTo(...to);
      draw.stroke();
    });
    draw.setLineDash([]);
  }

  // Shows why there is no image. `kind`: the requested kind of image; `frame`: the last frame, if any.
  explain(kind, frame) {
    const missing = kind !== "none" && frame && !frame.picture;
    this.canvas.hidden = kind === "none" || missing;
    this.note.hidden = kind !== "none" && !missing;
    const why = frame && frame.header.width === 0 ? "The images are not part of this log or network."
                                                   : "This sensor sends no colour.";
    this.note.textContent = kind === "none" ? "Off." : why;
  }
}
