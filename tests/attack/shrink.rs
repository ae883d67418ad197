//! Shrinking of cases with the same fault.

use std::collections::BTreeSet;

use super::claim::Claim;
use super::draw::{Drawn, Made};
use super::expr::{Expr, Tree, node, replaced, substituted, symbol, whole};
use super::print::Hand;
use super::random::Stream;
use super::scene::{Origin, Scene};
use super::told::told;
use super::wrong::{Wrong, weighed};

/// Largest number of cases judged to shrink one.
const TRIES: usize = 1500;

/// A case with one claim that shows a fault.
#[derive(Clone, Debug)]
pub struct Faulty {
    pub scene: Scene,
    pub made: Made,
    pub hand: Hand,
    pub seed: u64,
}

impl Faulty {
    /// Isolates a claim of a case, if it shows the fault alone.
    pub fn alone(drawn: &Drawn, made: &Made, wrong: Wrong) -> Option<Self> {
        let own = Self {
            scene: drawn.scene.clone(),
            made: made.clone(),
            hand: drawn.hand,
            seed: drawn.seed,
        };
        own.shows(wrong).then_some(own)
    }

    /// Replaces the claim; its residual need no longer vanish by construction.
    fn with_claim(&self, claim: Claim) -> Self {
        let made = Made { claim, vanishes: false, ..self.made.clone() };
        Self { made, ..self.clone() }
    }

    /// Writes the file.
    pub fn text(&self) -> String {
        self.scene.text(&[self.made.body(&self.scene.names(), self.hand)], self.hand)
    }

    /// Judges the case.
    pub fn told(&self) -> super::told::Told {
        told(&self.text(), self.seed, 1).swap_remove(0)
    }

    fn shows(&self, wrong: Wrong) -> bool {
        let mut stream = Stream::new(self.seed, 77);
        weighed(&self.scene, &self.made, &self.told(), &mut stream).1 == Some(wrong)
    }

    fn size(&self) -> usize {
        let trees: usize = self.made.claim.trees().iter().map(|tree| weight(tree)).sum();
        let symbols: usize = self
            .scene
            .symbols
            .iter()
            .map(|symbol| match &symbol.origin {
                Origin::Formula(tree) => 4 + weight(tree),
                Origin::List(list) => 3 + list.len(),
                Origin::Fixed(_) => 2,
                _ => 3,
            })
            .sum();
        let field: usize = self.scene.field.iter().map(|(_, tree)| 2 + weight(tree)).sum();
        let equations = self.scene.level.iter().flat_map(|level| &level.equations);
        let level: usize = equations.map(|(a, b)| 5 + weight(a) + weight(b)).sum();
        trees + symbols + field + level
    }

    /// Finds the smallest case with the same fault.
    pub fn shrunk(mut self, wrong: Wrong) -> Self {
        let mut tries = 0;
        let mut tried = BTreeSet::new();
        loop {
            let size = self.size();
            let mut smaller = self.simpler();
            smaller.retain(|one| one.size() < size);
            smaller.sort_by_key(Faulty::size);
            let mut found = None;
            for one in smaller {
                if !tried.insert(one.text()) {
                    continue;
                }
                tries += 1;
                if tries > TRIES {
                    return self;
                }
                if one.shows(wrong) {
                    found = Some(one);
                    break;
                }
            }
            match found {
                Some(one) => self = one,
                None => return self,
            }
        }
    }

    fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        let with_scene = |scene: Scene| Self { scene, ..self.clone() };
        if !self.scene.field.is_empty() {
            all.push(with_scene(Scene { field: Vec::new(), ..self.scene.clone() }));
        }
        if self.scene.level.is_some() {
            all.push(with_scene(Scene { level: None, ..self.scene.clone() }));
        }
        all.extend((0..self.scene.symbols.len()).filter_map(|place| self.without(place)));
        for place in 0..self.scene.symbols.len() {
            let mut scene = self.scene.clone();
            match &mut scene.symbols[place].origin {
                Origin::List(list) if list.len() > 1 => {
                    list.pop();
                    all.push(with_scene(scene.clone()));
                    let Origin::List(list) = &self.scene.symbols[place].origin else { continue };
                    scene.symbols[place].origin = Origin::Fixed(list[list.len() - 1]);
                    all.push(with_scene(scene));
                }
                Origin::Formula(tree) => {
                    let tree = tree.clone();
                    for simpler in simpler(&tree) {
                        scene.symbols[place].origin = Origin::Formula(simpler);
                        all.push(with_scene(scene.clone()));
                    }
                }
                _ => {}
            }
        }
        let trees: Vec<Tree> = self.made.claim.trees().into_iter().cloned().collect();
        for (k, tree) in trees.iter().enumerate() {
            for simpler in simpler(tree) {
                let mut trees = trees.clone();
                trees[k] = simpler;
                let claim = self.made.claim.with_trees(&trees);
                all.push(self.with_claim(claim));
            }
        }
        // The same part of several formulas.
        if trees.len() == 2 {
            let parts =
                |tree: &Tree| (0..tree.size()).filter_map(|k| node(tree, k)).collect::<Vec<_>>();
            let shared: Vec<Tree> = parts(&trees[0])
                .into_iter()
                .filter(|part| part.size() > 1 && trees[1].any(&mut |node| *node == **part))
                .collect();
            for part in shared {
                for by in simpler(&part) {
                    let trees: Vec<Tree> =
                        trees.iter().map(|tree| swapped(tree, &part, &by)).collect();
                    let claim = self.made.claim.with_trees(&trees);
                    all.push(self.with_claim(claim));
                }
            }
        }
        if let Claim::Independent(list) = &self.made.claim
            && list.len() > 1
        {
            for k in 0..list.len() {
                let mut list = list.clone();
                list.remove(k);
                all.push(self.with_claim(Claim::Independent(list)));
            }
        }
        all
    }

    /// Removes a symbol that nothing uses.
    fn without(&self, place: usize) -> Option<Self> {
        let scene = &self.scene;
        let uses = |tree: &Tree| tree.has(place);
        let level = scene.level.iter();
        let of_level = level.flat_map(|level| {
            let equations = level.equations.iter().flat_map(|(a, b)| [a, b]);
            let branches = level.branches.iter().chain(&level.chart).flatten();
            equations.chain(branches.map(|(_, tree)| tree))
        });
        let of_symbols = scene.symbols.iter().filter_map(|symbol| match &symbol.origin {
            Origin::Formula(tree) => Some(tree),
            _ => None,
        });
        let mut all = of_level
            .chain(of_symbols)
            .chain(scene.field.iter().map(|(_, tree)| tree))
            .chain(self.made.claim.trees());
        let assigned = scene.level.iter().flat_map(|level| level.branches.iter().flatten());
        let named = assigned.chain(&scene.field).any(|(own, _)| *own == place)
            || matches!(&self.made.claim, Claim::Limit(_, _, by) if *by == place)
            || matches!(&self.made.claim, Claim::SymmetryField(parts) if parts.iter().any(|(own, _)| *own == place));
        let last = scene.states() == [place];
        if named || last || all.any(uses) {
            return None;
        }
        let lower = |own: usize| if own > place { own - 1 } else { own };
        let moved = |tree: &Tree| substituted(tree, &|own| symbol(lower(own)));
        let pairs = |list: &[(usize, Tree)]| -> Vec<(usize, Tree)> {
            list.iter().map(|(own, tree)| (lower(*own), moved(tree))).collect()
        };
        let mut found = self.clone();
        found.scene.symbols.remove(place);
        for symbol in &mut found.scene.symbols {
            if let Origin::Formula(tree) = &mut symbol.origin {
                *tree = moved(tree);
            }
        }
        found.scene.field = pairs(&scene.field);
        if let Some(level) = &mut found.scene.level {
            for (a, b) in &mut level.equations {
                (*a, *b) = (moved(a), moved(b));
            }
            for branch in level.branches.iter_mut().chain(&mut level.chart) {
                *branch = pairs(branch);
            }
        }
        found.made.claim = match &self.made.claim {
            Claim::SymmetryField(parts) => Claim::SymmetryField(pairs(parts)),
            Claim::Limit(a, b, by) => Claim::Limit(moved(a), moved(b), lower(*by)),
            other => {
                let trees: Vec<Tree> = other.trees().into_iter().map(moved).collect();
                other.with_trees(&trees)
            }
        };
        Some(found)
    }
}

/// Counts nodes, with complicated numbers counted more.
fn weight(tree: &Tree) -> usize {
    let own = match &**tree {
        Expr::Number(n) => match (n.top, n.bottom, n.tens) {
            (0..=2, 1, 0) => 1,
            (_, 1, 0) => 2,
            _ => 3,
        },
        Expr::Of(..) => 3,
        Expr::Power(_, _, bottom) if *bottom > 1 => 4,
        _ => 2,
    };
    own + tree.parts().iter().map(|part| weight(part)).sum::<usize>()
}

fn swapped(tree: &Tree, part: &Tree, by: &Tree) -> Tree {
    if tree == part {
        return by.clone();
    }
    if tree.parts().is_empty() {
        return tree.clone();
    }
    let parts: Vec<Tree> = tree.parts().into_iter().map(|own| swapped(own, part, by)).collect();
    std::rc::Rc::new(tree.with_parts(&parts))
}

/// Lists expressions with one part replaced by a part of itself or by a small number.
fn simpler(tree: &Tree) -> Vec<Tree> {
    let mut found = Vec::new();
    for index in 0..tree.size() {
        let Some(part) = node(tree, index) else { continue };
        for own in part.parts() {
            found.push(replaced(tree, index, own));
        }
        for n in [0, 1, 2] {
            if !part.is(n) {
                found.push(replaced(tree, index, &whole(n)));
            }
        }
    }
    found
}
