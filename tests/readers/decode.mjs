// Decodes ROS 2 messages with Foxglove's reader, and prints them for agreement.py: one JSON object per line.
import rosmsg from "@foxglove/rosmsg";
import serialization from "@foxglove/rosmsg2-serialization";

const readers = new Map();  // by schema text

export function decode(schemaText, data) {
  if (!readers.has(schemaText))
    readers.set(schemaText, new serialization.MessageReader(rosmsg.parse(schemaText, {ros2: true})));
  return readers.get(schemaText).readMessage(data);
}

// Bytes become {"base64": ...}, and numbers that JSON lacks become strings.
function plain(key, value) {
  if (value instanceof Uint8Array) return {base64: Buffer.from(value).toString("base64")};
  if (ArrayBuffer.isView(value)) return Array.from(value, (number) => plain("", number));
  if (typeof value === "bigint") return Number(value);
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  return value;
}

export function print(topic, time, sequence, message, metadata = {}) {
  process.stdout.write(JSON.stringify({topic, time: Number(time), sequence, message, metadata}, plain) + "\n");
}
