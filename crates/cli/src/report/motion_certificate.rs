//! Certificates of proofs about motion, as JSON: the numbers by which a proof can be replayed.

use liouville::case::{Case, MotionClaim, Setting};
use liouville::verdict::{ClaimReport, Options};
use liouville_flow::{ProofData, ProvedHorseshoe, ProvedOrbit, observe};
use serde_json::{Value, json};

use super::certificate::{CaseOrigin, canonical};
use super::certificate_part::{CertificatePart, list, wider};
use super::hexadecimal::written;
use super::{horseshoe_certificate, sha256, unique_keys};

/// Name and version of the format for closed orbits.
pub const ORBITS: &str = "liouville motion certificate 1";
/// Name and version of the format for horseshoes.
pub const HORSESHOES: &str = "liouville horseshoe certificate 1";

/// Makes the certificate of a claim about a closed orbit that is proved.
pub fn motion_certificate(
    claim: &MotionClaim,
    origin: &CaseOrigin<'_>,
    report: &ClaimReport,
    found: &ProvedOrbit,
) -> Value {
    let orbit = json!({
        "start": found.start.iter().copied().map(wider).collect::<Vec<_>>(),
        "period": wider(found.period),
        "least": found.turns == Ok(1),
        "volume": wider(found.volume),
        "multipliers": found.sum.map(wider),
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
    sealed(statement(claim, origin, report, "orbit", orbit), proof)
}

/// Makes the certificate of a claim about a horseshoe that is proved.
pub fn horseshoe_certificate(
    claim: &MotionClaim,
    origin: &CaseOrigin<'_>,
    report: &ClaimReport,
    found: &ProvedHorseshoe,
) -> Value {
    let horseshoe = horseshoe_certificate::stated(found);
    let proof = horseshoe_certificate::proof(&found.data);
    sealed(statement(claim, origin, report, "horseshoe", horseshoe), proof)
}

fn statement(
    claim: &MotionClaim,
    origin: &CaseOrigin<'_>,
    report: &ClaimReport,
    key: &str,
    found: Value,
) -> Value {
    json!({
        "case": { "path": origin.path, "sha256": sha256(origin.text), "text": origin.text },
        "settings": origin.settings,
        "claim": stated(claim, report),
        key: found,
    })
}

/// Puts a statement and a proof together with their digest.
pub fn sealed(statement: Value, proof: Value) -> Value {
    let digest = digest(&statement, &proof);
    let format = if statement.get("horseshoe").is_some() { HORSESHOES } else { ORBITS };
    json!({ "format": format, "statement": statement, "proof": proof, "digest": digest })
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

fn digest(statement: &Value, proof: &Value) -> String {
    sha256(&canonical(&json!({ "statement": statement, "proof": proof })))
}

/// Reader of values given to parameters, as `--set` takes them.
pub type Settings<'s> = dyn Fn(&[String]) -> Result<Vec<Setting>, String> + Sync + 's;

/// Checks a certificate by replaying its proof in balls of integers; returns the report on the
/// claim.
///
/// # Errors
/// The reason why the certificate proves nothing.
pub fn verify(
    text: &str,
    options: &Options,
    settings: &Settings<'_>,
) -> Result<ClaimReport, String> {
    let whole =
        unique_keys::read(text).map_err(|error| format!("the file is not JSON: {error}"))?;
    let own = CertificatePart { value: &whole, path: String::new() };
    own.only(&["format", "statement", "proof", "digest"])?;
    let key = match own.text("format")? {
        ORBITS => "orbit",
        HORSESHOES => "horseshoe",
        _ => return Err(format!("its format is neither `{ORBITS}` nor `{HORSESHOES}`")),
    };
    let (statement, proof) = (own.at("statement")?, own.at("proof")?);
    if own.text("digest")? != digest(statement.value, proof.value) {
        return Err("the digest does not fit the statement and the proof".to_string());
    }
    statement.only(&["case", "settings", "claim", key])?;
    let source = statement.at("case")?;
    source.only(&["path", "sha256", "text"])?;
    let text = source.text("text")?;
    if source.text("sha256")? != sha256(text) {
        return Err("the digest of the case does not fit its text".to_string());
    }
    let given = statement.at("settings")?.all()?;
    let given = given.iter().map(|one| Ok(one.as_text()?.to_string()));
    let given = given.collect::<Result<Vec<String>, String>>()?;
    let case =
        Case::parse(text, &settings(&given)?).map_err(|error| format!("the case: {error}"))?;
    let about = statement.at("claim")?;
    let name = about.text("name")?;
    let claim = case.home(name).motions.iter().find(|own| own.name == name);
    let claim = claim.ok_or_else(|| format!("the case has no claim `{name}` about motion"))?;
    let (kind, formula) = (claim.kind.name(), claim.kind.text());
    for (part, own) in [("kind", kind), ("formula", formula.as_str())] {
        if about.text(part)? != own {
            return about.at(part)?.complaint("is not that of the case");
        }
    }
    let report = match key {
        "orbit" => {
            let (report, found) = observe::verify(&case, claim, &data(&proof)?, options)?;
            contains(&statement.at(key)?, &found)?;
            report
        }
        _ => {
            let data = horseshoe_certificate::read(&proof)?;
            let (report, found) = observe::verify_horseshoe(&case, claim, &data, options)?;
            horseshoe_certificate::contains(&statement.at(key)?, &found)?;
            report
        }
    };
    match *about.value == stated(claim, &report) {
        true => Ok(report),
        false => Err("the claim of the case is another".to_string()),
    }
}

/// Checks that what is stated of an orbit contains what was found.
fn contains(orbit: &CertificatePart<'_>, found: &ProvedOrbit) -> Result<(), String> {
    orbit.only(&["start", "period", "least", "volume", "multipliers"])?;
    orbit.at("start")?.contain(&found.start)?;
    orbit.at("period")?.contains(found.period)?;
    // Files without the key do not state it.
    match orbit.at("least").ok().map(|least| least.value.as_bool().ok_or(least)) {
        None | Some(Ok(false)) => {}
        Some(Ok(true)) if found.turns == Ok(1) => {}
        Some(Ok(true)) => return Err("the period is not proved to be the least".to_string()),
        Some(Err(least)) => return least.complaint("is neither true nor false"),
    }
    orbit.at("volume")?.contains(found.volume)?;
    let multipliers = orbit.at("multipliers")?;
    match (multipliers.value.is_null(), found.sum) {
        (true, None) => Ok(()),
        (false, Some(sum)) => multipliers.contains(sum),
        _ => Err("the multipliers are stated otherwise".to_string()),
    }
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
