// Reads the endless answer of /points, message by message; LiveMap.h says what they hold.
const kHead = 8, kPoint = 8;
export const kPerMetre = 100;

function readPoints(view, at, count) {
  const cm = new Int16Array(count * 3), reflectivity = new Uint8Array(count), lidar = new Uint8Array(count);
  for (let i = 0; i < count; ++i, at += kPoint) {
    for (let k = 0; k < 3; ++k) cm[3 * i + k] = view.getInt16(at + 2 * k, true);
    reflectivity[i] = view.getUint8(at + 6);
    lidar[i] = view.getUint8(at + 7);
  }
  return { count, cm, reflectivity, lidar };
}

function readFloats(view, at, count) {
  return Array.from({ length: count }, (_, i) => view.getFloat64(at + 8 * i, true));
}

function readPath(view, count) {
  const positions = new Float32Array(count * 3), health = new Uint8Array(count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 3; ++k) positions[3 * i + k] = view.getFloat32(8 + 16 * i + 4 * k, true);
    health[i] = view.getUint32(8 + 16 * i + 12, true);
  }
  return { count, positions, health };
}

function give(kind, bytes, sink) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = view.getUint32(0, true), count = view.getUint32(4, true);
  if (kind === 1) sink.map(first, readFloats(view, 8, 3), readPoints(view, 32, count));
  if (kind === 2) sink.scan(readFloats(view, 8, 3), readFloats(view, 32, 4), readPoints(view, 64, count));
  if (kind === 3) sink.path(first, readPath(view, count));
}

async function readOnce(sink) {
  const answer = await fetch("points");
  if (!answer.ok) throw new Error(await answer.text());
  const reader = answer.body.getReader();
  sink.begin();
  let rest = new Uint8Array(0);
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const bytes = new Uint8Array(rest.length + value.length);
    bytes.set(rest);
    bytes.set(value, rest.length);
    let at = 0;
    while (bytes.length - at >= kHead) {
      const head = new DataView(bytes.buffer, at);
      const size = head.getUint32(4, true);
      if (bytes.length - at - kHead < size) break;
      give(head.getUint32(0, true), bytes.subarray(at + kHead, at + kHead + size), sink);
      at += kHead + size;
    }
    rest = bytes.slice(at);
  }
}

/** Asks again for as long as the page is open: the program may be started anew. */
export async function readForEver(sink) {
  for (;;) {
    try { await readOnce(sink); } catch (error) { console.log("points:", error.message); }
    await new Promise((resume) => setTimeout(resume, 1000));
  }
}
