// The verifier beside the page, so that the page never waits.

import { ask } from "./call.js";

let compiled;
let instance;

async function load() {
  const response = await fetch("liouville.wasm");
  if (!response.ok) throw new Error(`liouville.wasm cannot be loaded: ${response.status}`);
  compiled = await WebAssembly.compile(await response.arrayBuffer());
}

const loaded = load();

addEventListener("message", async ({ data: { id, request } }) => {
  try {
    await loaded;
    instance ??= await WebAssembly.instantiate(compiled, {});
    postMessage({ id, answer: ask(instance, request) });
  } catch (error) {
    instance = undefined;
    postMessage({ id, fault: error.message });
  }
});
