// A text in the fragment of an address: compressed, or typed by hand.

const through = async (bytes, stream) => {
  const made = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(made).arrayBuffer());
};

/** Packs a text as z=… where the browser can compress, as text=… where it cannot. */
export async function pack(text) {
  if (typeof CompressionStream === "undefined") return `text=${encodeURIComponent(text)}`;
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return `z=${btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** Returns the text that a fragment holds, or null. */
export async function unpack(held) {
  if (held.has("text")) return held.get("text");
  if (!held.has("z")) return null;
  try {
    const letters = atob(held.get("z").replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
  } catch {
    throw new Error("the address is damaged: it does not hold a whole case");
  }
}
