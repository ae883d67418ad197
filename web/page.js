// The page: an editor, a worker that can be stopped, and the case in the address.

import { failures, named, reported, searched, verdicts } from "./show.js";
import { pack, unpack } from "./address.js";

const KEYS = "α β γ δ ε λ μ ν ρ σ φ ψ ω Γ Δ Ω × · √ ∂ ∫ ² ³ ⁻¹ −".split(" ");
const MOST_LISTED = 60;
const COMMANDS = ["check", "search", "report", "names"];

const at = (id) => document.getElementById(id);
const editor = at("editor");
let worker;
let waiting = new Map();
let count = 0;
let catalogue = { cases: [], templates: [] };
/** The case of the catalogue that the editor holds unchanged. */
let shownCase = null;

function start() {
  worker = new Worker("worker.js", { type: "module" });
  worker.onmessage = ({ data: { id, answer, fault } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (fault === undefined) resolve(answer);
    else reject(new Error(fault));
  };
  worker.onerror = (event) => {
    event.preventDefault();
    const error = new Error(event.message || "the worker cannot be loaded");
    for (const { reject } of waiting.values()) reject(error);
    waiting.clear();
  };
}

/** The compiled verifier, for this worker and those after a stop. */
const compiled = fetch("liouville.wasm").then(async (response) => {
  if (!response.ok) throw new Error(`liouville.wasm: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
});

async function ask(request) {
  const own = worker;
  const module = await compiled;
  if (own !== worker) throw new Error("stopped");
  return new Promise((resolve, reject) => {
    waiting.set(++count, { resolve, reject });
    worker.postMessage({ id: count, module, request });
  });
}

function state(name, words) {
  document.body.dataset.state = name;
  for (const command of COMMANDS) at(command).disabled = name === "working" || name === "loading";
  at("stop").disabled = name !== "working";
  at("status").textContent = words;
}

function path() {
  const own = shownCase && shownCase.text === editor.value && shownCase.name.includes("/");
  return own ? `cases/${shownCase.name}.toml` : "case.toml";
}

/** Selects a place in the editor; lines and columns count characters from 1. */
function select(line, column) {
  const lines = editor.value.split("\n");
  const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  const inLine = [...(lines[line - 1] ?? "")].slice(0, column - 1).join("").length;
  const from = before + inLine;
  editor.focus();
  editor.setSelectionRange(from, from + (String.fromCodePoint(editor.value.codePointAt(from) ?? 32)).length);
}

const ANSWERS = {
  check: (answer) => verdicts(answer, select),
  search: searched,
  report: reported,
  names: named,
};

async function run(command) {
  if (document.body.dataset.state === "working") return;
  const request = { ask: command, path: path(), text: editor.value };
  if (command === "search") {
    request.degree = Math.min(10, Math.max(0, Math.round(Number(at("degree").value) || 0)));
    request.seconds = Math.max(0.001, Number(at("steps").value) || 5);
    request.blind = at("blind").checked;
  }
  state("working", `${command} …`);
  at("answer").replaceChildren();
  await remember(command);
  if (document.body.dataset.state !== "working") return;
  const began = performance.now();
  try {
    const answer = await ask(request);
    const seconds = ((performance.now() - began) / 1000).toFixed(2);
    const wrong = answer.failures?.length > 0;
    const { words, nodes } = wrong ? failures(answer.failures, select) : ANSWERS[command](answer);
    at("answer").replaceChildren(...nodes);
    state(wrong ? "wrong" : "done", wrong ? words : `${words}; ${seconds} s`);
  } catch (error) {
    if (error.message === "stopped") return;
    const text = document.createElement("pre");
    text.className = "wrong";
    text.textContent = error.message;
    at("answer").replaceChildren(text);
    state("failed", "the verifier failed: please report this case with the message");
  }
}

function stop() {
  worker.terminate();
  const stopped = [...waiting.values()];
  waiting = new Map();
  start();
  state("stopped", "stopped");
  for (const { reject } of stopped) reject(new Error("stopped"));
}

/** Puts the case into the address. */
async function remember(command) {
  const own = shownCase && shownCase.text === editor.value;
  const held = own ? `case=${shownCase.name}` : await pack(editor.value);
  const fragment = `#${held}${command && command !== "check" ? `&do=${command}` : ""}`;
  history.replaceState(null, "", fragment);
}

async function open(name) {
  const answer = await ask({ ask: "show", name });
  if (answer.text === undefined) {
    const { words, nodes } = failures(answer.failures, select);
    at("answer").replaceChildren(...nodes);
    state("wrong", words);
    return false;
  }
  shownCase = { name, text: answer.text };
  editor.value = answer.text;
  editor.scrollTop = 0;
  return true;
}

function button(words, small, action) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = words;
  if (small) made.append(Object.assign(document.createElement("small"), { textContent: small }));
  made.onclick = action;
  return made;
}

function choose(name) {
  if (document.body.dataset.state === "working") stop();
  at("examples").open = false;
  open(name).then((is) => is && run("check"));
}

function list() {
  const words = at("filter").value.toLowerCase().split(/\s+/);
  const meant = ([name, title]) => words.every((word) => `${name} ${title}`.toLowerCase().includes(word));
  const found = catalogue.cases.filter(meant);
  const rows = found.slice(0, MOST_LISTED).map(([name, title]) => {
    const row = document.createElement("li");
    row.append(button(title, name, () => choose(name)));
    return row;
  });
  if (found.length > MOST_LISTED) {
    const more = document.createElement("li");
    more.className = "pale";
    more.textContent = `and ${found.length - MOST_LISTED} more`;
    rows.push(more);
  }
  at("cases").replaceChildren(...rows);
}

/** Opens what the address holds; true if there was a case. */
async function follow() {
  const held = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  const command = COMMANDS.includes(held.get("do")) ? held.get("do") : "check";
  try {
    if (held.has("case")) {
      if (!(await open(held.get("case")))) return;
    } else {
      const text = await unpack(held);
      if (text === null) {
        await open("field");
        state("done", "ready: change the case, or choose another");
        return;
      }
      shownCase = null;
      editor.value = text;
    }
    await run(command);
  } catch (error) {
    if (error.message !== "stopped") state("failed", error.message);
  }
}

function insert(letter) {
  editor.focus();
  editor.setRangeText(letter, editor.selectionStart, editor.selectionEnd, "end");
}

for (const letter of KEYS) at("keys").append(button(letter, "", () => insert(letter)));
for (const command of COMMANDS) at(command).onclick = () => run(command);
at("stop").onclick = stop;
at("filter").oninput = list;
at("link").onclick = async () => {
  await remember();
  try {
    await navigator.clipboard.writeText(location.href);
    at("status").textContent = "the address of this case is copied";
  } catch {
    at("status").textContent = "the address of this page holds the case";
  }
};
editor.onkeydown = (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) run("check");
};
addEventListener("hashchange", () => {
  if (document.body.dataset.state === "working") stop();
  follow();
});

start();
state("loading", "loading the verifier …");
try {
  catalogue = await ask({ ask: "cases" });
  const starts = catalogue.templates.map(([name]) => button(name, "", () => choose(name)));
  at("starts").replaceChildren("start from: ", ...starts);
  list();
  await follow();
} catch (error) {
  state("failed", `the verifier cannot be loaded: ${error.message}`);
}
