// Reads a recording with the MCAP reference library, decodes every message with the schemas in the file, and prints a
// summary as one JSON object. Exit status 1 if an error is found.
//   node check_recording.mjs indexed FILE   reads by summary and indexes, and checks all CRCs
//   node check_recording.mjs stream FILE    reads from the start as far as possible, for truncated files
import { open, readFile } from 'node:fs/promises';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import protobuf from 'protobufjs';
import 'protobufjs/ext/descriptor/index.js';

const types = new Map();   // by schema id

function typeOf(schema) {
  if (!types.has(schema.id)) {
    if (schema.encoding !== 'protobuf') throw new Error(`schema ${schema.name}: encoding ${schema.encoding}`);
    const set = protobuf.descriptor.FileDescriptorSet.decode(schema.data);
    types.set(schema.id, protobuf.Root.fromDescriptor(set).lookupType(schema.name));
  }
  return types.get(schema.id);
}

function count(found, message, channel, schema) {
  const topic = (found.topics[channel.topic] ??= { schema: schema.name, messages: 0 });
  const decoded = typeOf(schema).decode(message.data);
  if (decoded.tick !== undefined) topic.last_tick = Number(decoded.tick);
  topic.messages += 1;
  const time = Number(message.logTime) * 1e-9;
  found.first_s = Math.min(found.first_s ?? time, time);
  found.last_s = Math.max(found.last_s ?? time, time);
}

async function indexed(path) {
  const file = await open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      const { bytesRead } = await file.read(bytes, 0, Number(length), Number(offset));
      if (bytesRead !== Number(length)) throw new Error('short read');
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const found = { library: reader.header.library, topics: {}, chunks: reader.chunkIndexes.length, metadata: {} };
  let order = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < order) throw new Error('messages out of order');
    order = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    count(found, message, channel, reader.schemasById.get(channel.schemaId));
  }
  for await (const entry of reader.readMetadata()) found.metadata[entry.name] = Object.fromEntries(entry.metadata);
  const said = Number(reader.statistics.messageCount);
  const read = Object.values(found.topics).reduce((sum, topic) => sum + topic.messages, 0);
  if (said !== read) throw new Error(`the statistics say ${said} messages, ${read} were read`);
  if (reader.dataSectionCrc !== undefined) found.data_crc = reader.dataSectionCrc;
  await file.close();
  return found;
}

async function stream(path) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(await readFile(path));
  const found = { topics: {}, complete: false };
  const channels = new Map();
  const schemas = new Map();
  for (let record; (record = reader.nextRecord()) !== undefined; ) {
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type === 'Message') {
      const channel = channels.get(record.channelId);
      count(found, record, channel, schemas.get(channel.schemaId));
    }
    if (record.type === 'DataEnd') found.complete = true;
  }
  return found;
}

const [how, path] = process.argv.slice(2);
try {
  console.log(JSON.stringify(await { indexed, stream }[how](path)));
} catch (error) {
  console.error(String(error.stack ?? error));
  process.exit(1);
}
