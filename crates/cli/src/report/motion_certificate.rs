//! Certificates of proofs about motion, as JSON: the numbers by which a proof can be replayed.

use liouville::case::{Case, MotionClaim, Setting};
use liouville::verdict::{ClaimReport, Options};
use liouville_flow::{Enclosure, ProofData, ProvedOrbit, observe};
use serde_json::{Value, json};

use super::certificate::{CaseOrigin, canonical, hex};
use super::hexadecimal::{read, written};

/// Name and version of the format.
pub const FORMAT: &str = "liouville motion certificate 1";
/// Factor by which the enclosures stated are wider than those of the first proof: in other
/// arithmetic they come out somewhat different.
const MARGIN: f64 = 1.0625;

/// Makes the certificate of a claim about a closed orbit that is proved.
pub fn motion_certificate(
    claim: &MotionClaim,
    origin: &CaseOrigin<'_>,
    report: &ClaimReport,
    found: &ProvedOrbit,
) -> Value {
    let wider = |x: Enclosure| ball(Enclosure { rad: x.rad * MARGIN, ..x });
    let statement = json!({
        "case": { "path": origin.path, "sha256": hex(origin.text), "text": origin.text },
        "settings": origin.settings,
        "claim": stated(claim, report),
        "orbit": {
            "start": found.start.iter().copied().map(wider).collect::<Vec<_>>(),
            "period": wider(found.period),
            "volume": wider(found.volume),
            "multipliers": found.sum.map(wider),
        },
    });
    let data = &found.data;
    let proof = json!({
        "order": data.order,
        "functions": data.functions,
        "values": list(&data.values),
        "nodes": data.nodes.iter().map(|node| list(node)).collect::<Vec<_>>(),
        "shares": list(&data.shares),
        "period": written(data.period),
        "radii": list(&data.radii),
        "tails": list(&data.tails),
    });
    sealed(statement, proof)
}

/// Puts a statement and a proof together with their digest.
pub fn sealed(statement: Value, proof: Value) -> Value {
    let digest = digest(&statement, &proof);
    json!({ "format": FORMAT, "statement": statement, "proof": proof, "digest": digest })
}

fn stated(claim: &MotionClaim, report: &ClaimReport) -> Value {
    json!({
        "name": claim.name,
        "kind": claim.kind.name(),
        "formula": claim.kind.text(),
        "where": report.place,
        "verdict": report.verdict.word(),
    })
}

fn list(numbers: &[f64]) -> Vec<String> {
    numbers.iter().copied().map(written).collect()
}

fn ball(x: Enclosure) -> [String; 2] {
    [written(x.mid), written(x.rad)]
}

fn digest(statement: &Value, proof: &Value) -> String {
    hex(&canonical(&json!({ "statement": statement, "proof": proof })))
}

/// Reader of values given to parameters, as `--set` takes them.
pub type Settings<'s> = dyn Fn(&[String]) -> Result<Vec<Setting>, String> + Sync + 's;

/// Checks a certificate by replaying its proof in balls of 256 bits; returns the report on the
/// claim.
///
/// # Errors
/// The reason why the certificate proves nothing.
pub fn verify(
    text: &str,
    options: &Options,
    settings: &Settings<'_>,
) -> Result<ClaimReport, String> {
    let whole: Value =
        serde_json::from_str(text).map_err(|error| format!("it is not JSON: {error}"))?;
    let own = CertificatePart { value: &whole, path: String::new() };
    own.only(&["format", "statement", "proof", "digest"])?;
    if own.text("format")? != FORMAT {
        return Err(format!("its format is not `{FORMAT}`"));
    }
    let (statement, proof) = (own.at("statement")?, own.at("proof")?);
    if own.text("digest")? != digest(statement.value, proof.value) {
        return Err("the digest does not fit the statement and the proof".to_string());
    }
    statement.only(&["case", "settings", "claim", "orbit"])?;
    let source = statement.at("case")?;
    source.only(&["path", "sha256", "text"])?;
    let text = source.text("text")?;
    if source.text("sha256")? != hex(text) {
        return Err("the digest of the case does not fit its text".to_string());
    }
    let given = statement.at("settings")?.all()?;
    let given = given.iter().map(|one| Ok(one.as_text()?.to_string()));
    let given = given.collect::<Result<Vec<String>, String>>()?;
    let case =
        Case::parse(text, &settings(&given)?).map_err(|error| format!("the case: {error}"))?;
    let about = statement.at("claim")?;
    let name = about.text("name")?;
    let claim = case.motions.iter().find(|own| own.name == name);
    let claim = claim.ok_or_else(|| format!("the case has no claim `{name}` about motion"))?;
    let data = data(&proof)?;
    let (report, found) = observe::verify(&case, claim, &data, options)?;
    if *about.value != stated(claim, &report) {
        return Err("the claim of the case is another".to_string());
    }
    let orbit = statement.at("orbit")?;
    orbit.only(&["start", "period", "volume", "multipliers"])?;
    let start = orbit.at("start")?.all()?;
    if start.len() != found.start.len() {
        return Err("the start has other components".to_string());
    }
    for (own, x) in start.iter().zip(&found.start) {
        own.contains(*x)?;
    }
    orbit.at("period")?.contains(found.period)?;
    orbit.at("volume")?.contains(found.volume)?;
    let multipliers = orbit.at("multipliers")?;
    match (multipliers.value.is_null(), found.sum) {
        (true, None) => {}
        (false, Some(sum)) => multipliers.contains(sum)?,
        _ => return Err("the multipliers are stated otherwise".to_string()),
    }
    Ok(report)
}

fn data(proof: &CertificatePart<'_>) -> Result<ProofData, String> {
    let keys = ["order", "functions", "values", "nodes", "shares", "period", "radii", "tails"];
    proof.only(&keys)?;
    let nodes = proof.at("nodes")?.all()?;
    let functions = proof.at("functions")?.all()?;
    Ok(ProofData {
        order: proof.at("order")?.whole()?,
        functions: functions.iter().map(CertificatePart::whole).collect::<Result<_, _>>()?,
        values: proof.at("values")?.numbers()?,
        nodes: nodes.iter().map(CertificatePart::numbers).collect::<Result<_, _>>()?,
        shares: proof.at("shares")?.numbers()?,
        period: proof.at("period")?.number()?,
        radii: proof.at("radii")?.numbers()?,
        tails: proof.at("tails")?.numbers()?,
    })
}

/// Part of a certificate, with its path for complaints.
struct CertificatePart<'v> {
    value: &'v Value,
    path: String,
}

impl<'v> CertificatePart<'v> {
    fn complaint<T>(&self, what: &str) -> Result<T, String> {
        let path = match self.path.trim_start_matches('.') {
            "" => "the certificate".to_string(),
            path => format!("`{path}`"),
        };
        Err(format!("{path} {what}"))
    }

    fn at(&self, key: &str) -> Result<CertificatePart<'v>, String> {
        let path = format!("{}.{key}", self.path);
        match self.value.get(key) {
            Some(value) => Ok(CertificatePart { value, path }),
            None => CertificatePart { value: self.value, path }.complaint("is missing"),
        }
    }

    /// Checks that there are no other keys.
    fn only(&self, keys: &[&str]) -> Result<(), String> {
        let Some(table) = self.value.as_object() else { return self.complaint("is not a table") };
        match table.keys().find(|key| !keys.contains(&key.as_str())) {
            Some(other) => self.complaint(&format!("has no key `{other}`")),
            None => Ok(()),
        }
    }

    fn all(&self) -> Result<Vec<CertificatePart<'v>>, String> {
        let Some(all) = self.value.as_array() else { return self.complaint("is not a list") };
        let one =
            |(index, value)| CertificatePart { value, path: format!("{}[{index}]", self.path) };
        Ok(all.iter().enumerate().map(one).collect())
    }

    fn as_text(&self) -> Result<&'v str, String> {
        match self.value.as_str() {
            Some(text) => Ok(text),
            None => self.complaint("is not a text"),
        }
    }

    fn text(&self, key: &str) -> Result<&'v str, String> {
        self.at(key)?.as_text()
    }

    fn whole(&self) -> Result<usize, String> {
        match self.value.as_u64().and_then(|n| usize::try_from(n).ok()) {
            Some(number) => Ok(number),
            None => self.complaint("is not a whole number"),
        }
    }

    fn number(&self) -> Result<f64, String> {
        match read(self.as_text()?) {
            Some(number) => Ok(number),
            None => self.complaint("is not a number in hexadecimal"),
        }
    }

    fn numbers(&self) -> Result<Vec<f64>, String> {
        self.all()?.iter().map(CertificatePart::number).collect()
    }

    /// Checks that an enclosure lies in the one stated here.
    fn contains(&self, x: Enclosure) -> Result<(), String> {
        let numbers = self.numbers()?;
        let [mid, rad] = numbers.as_slice() else { return self.complaint("is not a ball") };
        let reach = ((x.mid - mid).abs() + x.rad) * (1.0 + 8.0 * f64::EPSILON);
        match reach <= *rad {
            true => Ok(()),
            false => self.complaint("does not contain what the proof encloses"),
        }
    }
}
