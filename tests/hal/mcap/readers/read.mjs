// SPDX-License-Identifier: Apache-2.0
// read.mjs FILE indexed|streamed: prints what @mcap/core reads of a recording, one line for each
// schema, channel, message and attachment: by the index of a finished file, or in the order of any file up
// to a torn record.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const require = createRequire(join(process.env.NODE_PATH, 'here.js'));
const { McapIndexedReader, McapStreamReader } = require('@mcap/core');
const { decompress } = require('fzstd');

const [file, how] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(file));
const decompressHandlers = {
  zstd: (data, size) => decompress(data, new Uint8Array(Number(size))),
};
const hex = (data) => Buffer.from(data).toString('hex');

const lines = new Set();
function print(record) {
  switch (record.type) {
    case 'Schema':
      lines.add(`schema ${record.id} ${record.name} ${record.encoding} ${hex(record.data)}`);
      break;
    case 'Channel':
      lines.add(`channel ${record.id} ${record.schemaId} ${record.topic} ${record.messageEncoding}`);
      break;
    case 'Message':
      lines.add(`message ${record.channelId} ${record.sequence} ${record.logTime} ` +
                `${record.publishTime} ${hex(record.data)}`);
      break;
    case 'Attachment':
      lines.add(`attachment ${record.name} ${record.mediaType} ${hex(record.data)}`);
      break;
    case 'Metadata':
      lines.add(`metadata ${record.name} ${JSON.stringify(Object.fromEntries(record.metadata))}`);
      break;
  }
}

if (how === 'indexed') {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  reader.schemasById.forEach(print);
  reader.channelsById.forEach(print);
  for await (const message of reader.readMessages()) print(message);
  for await (const attachment of reader.readAttachments()) print(attachment);
  for await (const metadata of reader.readMetadata()) print(metadata);
  const { messageCount, chunkCount } = reader.statistics;
  lines.add(`statistics ${messageCount} ${chunkCount}`);
} else {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) print(record);
}
console.log([...lines].sort().join('\n'));
