// Prints every message of an MCAP file, read by its index with @mcap/core, all check sums compared.
//   node read_mcap.mjs FILE.mcap
import {readFileSync} from "node:fs";
import {McapIndexedReader, McapStreamReader} from "@mcap/core";
import {decompress} from "fzstd";
import {decode, print} from "./decode.mjs";

const bytes = new Uint8Array(readFileSync(process.argv[2]));
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
};
const decompressHandlers = {zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size)))};

function demand(condition, what) {
  if (condition) return;
  console.error(what);
  process.exit(1);
}

// The same file from front to back, as of a reader that has no index.
const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord());) streamed += record.type === "Message" ? 1 : 0;
demand(stream.done() && stream.bytesRemaining() === 0, "the stream reader did not come to the end");

const file = await McapIndexedReader.Initialize({readable, decompressHandlers});
demand(file.header.profile === "ros2", "the profile is not ros2");
demand(file.chunkIndexes.length === file.statistics.chunkCount && file.chunkIndexes.length > 0, "chunks lack an index");
let indexed = 0;
for await (const record of file.readMessages({validateCrcs: true})) {
  const channel = file.channelsById.get(record.channelId), schema = file.schemasById.get(channel.schemaId);
  demand(channel.messageEncoding === "cdr" && schema.encoding === "ros2msg", `${channel.topic} is no ROS 2 message`);
  const message = decode(new TextDecoder().decode(schema.data), record.data);
  print(channel.topic, record.logTime, record.sequence, message, Object.fromEntries(channel.metadata));
  ++indexed;
}
demand(indexed === streamed && BigInt(indexed) === file.statistics.messageCount, "the index does not have all messages");
