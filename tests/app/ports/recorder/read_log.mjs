// SPDX-License-Identifier: Apache-2.0
// read_log.mjs FILE: prints the messages of a recording by the definitions in it, as others read them: a line for
// each figure, with the bits of its value, for each lossless picture, with the CRC-32 of its pixels, and for each
// attachment.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { crc32 } from 'node:zlib';

const require = createRequire(join(process.env.NODE_PATH, 'here.js'));
const { McapStreamReader } = require('@mcap/core');
const { parse } = require('@foxglove/rosmsg');
const { MessageReader } = require('@foxglove/rosmsg2-serialization');
const { decompress } = require('fzstd');

const bits = (value) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  return Number.isNaN(value) ? 'nan' : view.getBigUint64(0).toString(16);
};

const schemas = new Map(), channels = new Map();
const stream = new McapStreamReader({
  decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) }, validateCrcs: true });
stream.append(new Uint8Array(readFileSync(process.argv[2])));
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === 'Schema') {
    const definition = parse(new TextDecoder().decode(record.data), { ros2: true });
    schemas.set(record.id, { name: record.name, reader: new MessageReader(definition) });
  } else if (record.type === 'Channel') {
    channels.set(record.id, { topic: record.topic, ...schemas.get(record.schemaId) });
  } else if (record.type === 'Attachment') {
    console.log(`attachment ${record.name} ${new TextDecoder().decode(record.data)}`);
  } else if (record.type === 'Metadata') {
    for (const [key, value] of record.metadata) console.log(`${record.name} ${key} ${value}`);
  } else if (record.type === 'Message') {
    const { topic, name, reader } = channels.get(record.channelId);
    const message = reader.readMessage(record.data);
    const { sec, nsec, nanosec = nsec } = message.header.stamp;
    if (message.encoding !== undefined) {
      const { width, height, encoding, is_bigendian: order, step, data } = message;
      console.log(`${topic} ${name} ${record.sequence} ${sec}.${String(nanosec).padStart(9, '0')} ` +
                  `${width}x${height} ${encoding} ${order} ${step} ${crc32(data)}`);
      continue;
    }
    const at = `${topic} ${name} ${message.frame_set ?? message.number} ${sec}.${String(nanosec).padStart(9, '0')}`;
    if (message.components === undefined) console.log(`${at} ${message.source} ${message.severity} ${message.text}`);
    for (const { kind, name: part, figures } of message.components ?? []) {
      for (const one of figures) {
        console.log(`${at} ${kind} ${part} ${one.name} ${bits(one.value)} ${one.unit} ${one.text}`);
      }
    }
  }
}
