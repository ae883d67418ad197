// One request to the module, and its answer, both through its memory.

/** Answers a request. Throws what the module says if it fails: it then has to be made anew. */
export function ask(instance, request) {
  const { memory, input, call, length, output } = instance.exports;
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  const place = input(bytes.length) >>> 0;
  new Uint8Array(memory.buffer, place, bytes.length).set(bytes);
  const read = () => {
    const answer = new Uint8Array(memory.buffer, output() >>> 0, length() >>> 0);
    return new TextDecoder().decode(answer.slice());
  };
  try {
    call();
  } catch (trap) {
    // a stack that is full leaves no message
    throw new Error(read() || String(trap));
  }
  return JSON.parse(read());
}
