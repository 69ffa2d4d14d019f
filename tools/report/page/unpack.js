"use strict";
// Numbers that a page contains as text; see packed() of report/packed.h.

// The bytes of a zlib stream in base64.
async function unpack(text) {
  const source = new ReadableStream({start(controller) {
    controller.enqueue(Uint8Array.from(atob(text), c => c.charCodeAt(0)));
    controller.close();
  }});
  const reader = source.pipeThrough(new DecompressionStream("deflate")).getReader(), parts = [];
  for (let part = await reader.read(); !part.done; part = await reader.read()) parts.push(part.value);
  const bytes = new Uint8Array(parts.reduce((n, part) => n + part.length, 0));
  parts.reduce((at, part) => { bytes.set(part, at); return at + part.length; }, 0);
  return bytes;
}

// 32-bit floats: the lowest byte of each, then the second byte of each, and so on.
function floats(bytes) {
  const n = bytes.length / 4, ordered = new Uint8Array(bytes.length);
  for (let k = 0; k < 4; ++k) for (let i = 0; i < n; ++i) ordered[4 * i + k] = bytes[k * n + i];
  return new Float32Array(ordered.buffer);
}
