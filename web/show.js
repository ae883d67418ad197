// Answers of the verifier as elements of the page.

/** Makes an element; strings become text, never markup. */
function make(name, className, ...children) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Sets a formula that the verifier typeset and escaped. */
function formula(mathml) {
  const box = make("div", "scroll");
  box.innerHTML = mathml;
  return box;
}

function folded(words, lines) {
  if (lines.length === 0) return null;
  const rows = lines.map((line) => make("li", "mono", line));
  return make("details", "small", make("summary", "", words), make("ul", "", ...rows));
}

function definitions(shown) {
  if (!shown.definitions?.length) return null;
  const each = shown.definitions.map(({ typed, formula: set }) => {
    const item = make("li");
    if (set) item.innerHTML = set;
    else item.append(make("code", "", typed));
    return item;
  });
  return make("ul", "where", ...each);
}

const CLASSES = { proved: "holds", confirmed: "holds", refuted: "fails", undecided: "open" };
const SIGNS = { proved: "✓", confirmed: "✓", refuted: "✗", undecided: "?" };
const EXPECTED = { holds: "holds", fails: "fails", open: "open" };

/** The state at which a claim fails, and the command that evaluates it there. */
function witness(claim, shown) {
  const found = claim.evidence?.witness;
  if (!found) return null;
  const rounded = () => `${found.residual.toPrecision(4)} ± ${found.error_bound.toExponential(0)}`;
  const words = `witness: the residual is ${found.digits ?? rounded()}`;
  const made = make("details", "small", make("summary", "witness", words));
  const lines = [found.state, ...Object.entries(found.parameters ?? {}).map(([name, given]) => `${name} = ${given}`)];
  made.append(...lines.map((line) => make("div", "mono", line)), make("pre", "", shown.witness));
  return made;
}

function row(claim, shown) {
  const statement = shown.formula
    ? formula(shown.formula)
    : claim.formula && claim.formula !== claim.name && make("code", "", claim.formula);
  const against = claim.agrees ? null : make("strong", "", " against expectation");
  const source = claim.source ? make("cite", "", ` ${claim.source}`) : null;
  const remarks = shown.remarks?.length ? make("div", "pale", shown.remarks.join("; ")) : null;
  const verdict = make("td", "verdict", `${SIGNS[claim.verdict]} ${claim.verdict}`);
  const words = make("td", "claim", `${claim.kind}: ${claim.name}`, source, against, statement || null,
    definitions(shown), remarks, witness(claim, shown), folded("evidence", shown.grounds));
  const expected = make("td", "expected", EXPECTED[claim.expect] ?? claim.expect);
  const made = make("tr", `${CLASSES[claim.verdict]}${claim.agrees ? "" : " against"}`, verdict, words, expected);
  made.dataset.verdict = claim.verdict;
  return made;
}

function json(document, command) {
  const text = make("pre", "", document);
  text.id = "json";
  const words = `JSON, as liouville ${command} --json prints it`;
  return make("details", "small", make("summary", "", words), text);
}

/** Verdicts on the claims of a case. */
export function verdicts(answer) {
  const report = JSON.parse(answer.json);
  const [found] = report.cases;
  const rows = found.claims.map((claim, index) => row(claim, answer.shown[index]));
  const heads = ["verdict", "claim", "expected"].map((word) => make("th", "", word));
  const nodes = [make("h2", "", found.title)];
  for (const warning of found.warnings ?? []) nodes.push(make("p", "note", `Warning: ${warning}`));
  for (const remark of found.remarks ?? []) nodes.push(make("p", "note", `Note: ${remark}`));
  if (rows.length) {
    nodes.push(make("table", "", make("thead", "", make("tr", "", ...heads)), make("tbody", "", ...rows)));
  }
  if (report.summary.motions_left) {
    nodes.push(make("p", "pale", `${report.summary.motions_left} claims about motion: only the command judges these, with --motion`));
  }
  nodes.push(json(answer.json, "check"));
  const counts = ["proved", "confirmed", "refuted", "undecided"];
  const told = counts.filter((word) => report.summary[word]).map((word) => `${report.summary[word]} ${word}`);
  const against = report.summary.disagreements;
  if (against) told.push(`${against} against expectation`);
  return { words: told.join(", ") || "the case states no claims", nodes };
}

/** Mistakes with their places; a place selects the text in the editor. */
export function failures(list, select) {
  const nodes = list.flatMap((one) => {
    const text = make("pre", "wrong", one.rendered);
    if (!one.line) return [text];
    const place = make("button", "", `line ${one.line}, column ${one.column}`);
    place.onclick = () => select(one.line, one.column);
    return [place, text];
  });
  const words = list.length === 1 ? list[0].message : `${list.length} mistakes`;
  return { words, nodes };
}

/** Invariants that a search found. */
export function searched(answer) {
  const report = JSON.parse(answer.json);
  const rows = report.found.map((one, index) => {
    const claim = { ...one, name: one.formula, agrees: true, expect: one.known ?? "new", formula: null };
    return row(claim, answer.shown[index]);
  });
  const heads = ["verdict", "find", "claim that implies it"].map((word) => make("th", "", word));
  const nodes = [];
  if (rows.length) {
    nodes.push(make("table", "", make("thead", "", make("tr", "", ...heads)), make("tbody", "", ...rows)));
  }
  nodes.push(make("pre", "", answer.text), json(answer.json, "search"));
  const count = report.found.length;
  return { words: count === 1 ? "1 invariant found" : `${count} invariants found`, nodes };
}

/** The page of a report, in a frame of its own. */
export function reported(answer) {
  const address = URL.createObjectURL(new Blob([answer.page], { type: "text/html" }));
  const frame = make("iframe");
  frame.title = "Report";
  frame.setAttribute("sandbox", "");
  frame.src = address;
  const save = make("a", "", "save this page");
  save.href = address;
  save.download = "report.html";
  return { words: "report", nodes: [make("p", "", save), frame] };
}

/** Names that formulas may use. */
export function named(answer) {
  return { words: "names in formulas of this case", nodes: [make("pre", "", answer.text)] };
}
