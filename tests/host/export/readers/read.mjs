// usage: node read.mjs FILE...
// Reads exports with libraries that others wrote and prints what they found, one JSON document a file. Exit status 1
// with a line on stderr for each that is not as its format wants it.
import * as ros2Common from "@foxglove/rosmsg-msgs-common";
import { parse as parseDefinition } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import * as foxglove from "@foxglove/schemas/jsonschema.js";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { check } from "@placemarkio/check-geojson";
import Ajv from "ajv";
import { decompress } from "fzstd";
import gltf from "gltf-validator";
import { readFileSync } from "node:fs";

const faults = [];
const plain = (value) =>
  JSON.stringify(value, (_, v) => (typeof v === "bigint" ? Number(v) : ArrayBuffer.isView(v) ? Array.from(v) : v));

const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };

/** Fields with their types, without constants and defaults. */
const layout = (definitions) =>
  definitions.filter((f) => !f.isConstant).map((f) => [f.name, f.type, f.isArray ?? false, f.arrayLength ?? 0]);

/** Our copy of a definition against the one that the ROS packages have; vision_msgs is not among these. */
function compareDefinition(schema, text) {
  const ours = parseDefinition(text, { ros2: true });
  for (const one of ours) {
    const name = one.name ?? schema;
    const theirs = ros2Common.ros2humble[name.replace("/msg/", "/")];
    if (!theirs) {
      if (!name.startsWith("vision_msgs/")) faults.push(`${name}: no definition to compare with`);
      continue;
    }
    const a = JSON.stringify(layout(one.definitions)).replaceAll("/msg/", "/");
    const b = JSON.stringify(layout(theirs.definitions)).replaceAll("/msg/", "/");
    if (a !== b) faults.push(`${name}: ${a} is not ${b}`);
  }
  return ours;
}

const ajv = new Ajv({ strict: false });
const official = (name) => Object.values(foxglove).find((s) => s.title === name);

function decoder(channel, schema) {
  const text = new TextDecoder().decode(schema.data);
  if (channel.messageEncoding === "cdr") {
    const reader = new MessageReader(compareDefinition(schema.name, text));
    return (data) => reader.readMessage(data);
  }
  const own = ajv.compile(JSON.parse(text));
  const theirs = schema.name.startsWith("foxglove.") ? ajv.compile(official(schema.name)) : undefined;
  return (data) => {
    const message = JSON.parse(new TextDecoder().decode(data));
    for (const validate of [own, theirs]) {
      if (validate && !validate(message)) faults.push(`${channel.topic}: ${ajv.errorsText(validate.errors)}`);
    }
    return message;
  };
}

async function readMcap(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const topics = {};
  const decoders = new Map();
  for await (const message of indexed.readMessages({ validateCrcs: true })) {
    const channel = indexed.channelsById.get(message.channelId);
    const schema = indexed.schemasById.get(channel.schemaId);
    if (!decoders.has(channel.id)) decoders.set(channel.id, decoder(channel, schema));
    const topic = (topics[channel.topic] ??= {
      schema: schema.name, metadata: Object.fromEntries(channel.metadata), times: [], messages: [],
    });
    topic.times.push(Number(message.logTime) / 1e9);
    topic.messages.push(decoders.get(channel.id)(message.data));
  }
  const attachments = [];
  for await (const one of indexed.readAttachments({ validateCrcs: true })) {
    attachments.push({ name: one.name, mediaType: one.mediaType, text: new TextDecoder().decode(one.data) });
  }
  const metadata = [];
  for await (const one of indexed.readMetadata()) metadata.push(Object.fromEntries(one.metadata));
  // The same from the front, as a pipe would be read, every checksum looked at.
  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(bytes);
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;
  if (!stream.done()) faults.push("the stream reader does not see the end");
  return {
    profile: indexed.header.profile,
    streamed,
    counted: Number(indexed.statistics.messageCount),
    chunks: indexed.chunkIndexes.length,
    topics,
    attachments,
    metadata,
  };
}

async function readGlb(bytes) {
  const report = await gltf.validateBytes(new Uint8Array(bytes), { maxIssues: 100 });
  for (const issue of report.issues.messages) faults.push(`glb: ${issue.code} ${issue.message} ${issue.pointer ?? ""}`);
  const length = bytes.readUInt32LE(12);
  return { info: report.info, json: JSON.parse(bytes.subarray(20, 20 + length).toString()) };
}

for (const file of process.argv.slice(2)) {
  const bytes = readFileSync(file);
  let found;
  try {
    if (file.endsWith(".mcap")) found = await readMcap(bytes);
    else if (file.endsWith(".glb")) found = await readGlb(bytes);
    else found = check(bytes.toString());
  } catch (error) {
    faults.push(`${file}: ${error.issues ? plain(error.issues) : error.message}`);
  }
  console.log(plain(found ?? null));
}
for (const fault of [...new Set(faults)].slice(0, 20)) console.error(fault);
process.exitCode = faults.length > 0 ? 1 : 0;
