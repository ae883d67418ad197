// The verifier beside the page, so that the page never waits.

import { ask } from "./call.js";

let instance;

addEventListener("message", async ({ data: { id, module, request } }) => {
  try {
    instance ??= await WebAssembly.instantiate(module, {});
    postMessage({ id, answer: ask(instance, request) });
  } catch (error) {
    instance = undefined;
    postMessage({ id, fault: error.message });
  }
});
