//! Parts of certificates that belong to horseshoes alone.

use liouville_flow::{CoveringSet, HorseshoeData, ProvedHorseshoe};
use serde_json::{Value, json};

use super::certificate_part::{CertificatePart, list, wider};
use super::hexadecimal::written;

/// Share by which the entropy stated is below that of the first proof.
const LOWERED: f64 = 1e-6;

/// Statement about a horseshoe.
pub fn stated(found: &ProvedHorseshoe) -> Value {
    json!({
        "start": found.start.iter().copied().map(wider).collect::<Vec<_>>(),
        "times": found.times.map(wider),
        "entropy": written(found.entropy * (1.0 - LOWERED)),
    })
}

/// Checks that what is stated contains what was found.
pub fn contains(horseshoe: &CertificatePart<'_>, found: &ProvedHorseshoe) -> Result<(), String> {
    horseshoe.only(&["start", "times", "entropy"])?;
    horseshoe.at("start")?.contain(&found.start)?;
    horseshoe.at("times")?.contain(&found.times)?;
    let entropy = horseshoe.at("entropy")?;
    match entropy.number()? <= found.entropy {
        true => Ok(()),
        false => entropy.complaint("is above what the proof gives"),
    }
}

/// Writes the numbers of a proof.
pub fn proof(data: &HorseshoeData) -> Value {
    let set = |set: &CoveringSet| {
        json!({
            "origin": list(&set.origin),
            "normal": list(&set.normal),
            "rows": [list(&set.rows[0]), list(&set.rows[1])],
            "centre": list(&set.centre),
            "middle": list(&set.middle),
            "half": list(&set.half),
            "time": list(&set.time),
            "tail": written(set.tail),
        })
    };
    json!({
        "orders": data.orders,
        "functions": data.functions,
        "values": list(&data.values),
        "sets": data.sets.iter().map(set).collect::<Vec<_>>(),
        "relations": data.relations,
    })
}

/// Reads the numbers of a proof.
pub fn read(proof: &CertificatePart<'_>) -> Result<HorseshoeData, String> {
    proof.only(&["orders", "functions", "values", "sets", "relations"])?;
    let functions = proof.at("functions")?.all()?;
    let sets = proof.at("sets")?.all()?;
    let relations = proof.at("relations")?.all()?;
    Ok(HorseshoeData {
        orders: proof.at("orders")?.wholes()?,
        functions: functions.iter().map(CertificatePart::whole).collect::<Result<_, _>>()?,
        values: proof.at("values")?.numbers()?,
        sets: sets.iter().map(set).collect::<Result<_, _>>()?,
        relations: relations.iter().map(CertificatePart::wholes).collect::<Result<_, _>>()?,
    })
}

fn set(part: &CertificatePart<'_>) -> Result<CoveringSet, String> {
    part.only(&["origin", "normal", "rows", "centre", "middle", "half", "time", "tail"])?;
    let rows = part.at("rows")?;
    let numbers =
        rows.all()?.iter().map(CertificatePart::numbers).collect::<Result<Vec<_>, _>>()?;
    let Ok(both) = numbers.try_into() else { return rows.complaint("has not 2 rows") };
    Ok(CoveringSet {
        origin: part.at("origin")?.numbers()?,
        normal: part.at("normal")?.numbers()?,
        rows: both,
        centre: part.at("centre")?.numbers()?,
        middle: part.at("middle")?.array()?,
        half: part.at("half")?.array()?,
        time: part.at("time")?.array()?,
        tail: part.at("tail")?.number()?,
    })
}
