//! Families of cases, each given by one size.

/// A family of cases with a size n.
#[derive(Clone, Copy, Debug)]
pub struct CaseFamily {
    /// Name in reports, and on the command line.
    pub name: &'static str,
    /// Quantity that n counts.
    pub size: &'static str,
    /// Smallest size measured.
    pub first: u64,
    /// Largest size that case files allow, or that is of use.
    pub last: u64,
    /// Whether n is the number of states of a judgement without proofs, instead of a part of the
    /// text.
    pub counts_states: bool,
    pub(super) text: &'static str,
    /// Claim that stands in the text once for each i from 1 to n.
    pub(super) repeated: &'static str,
}

impl CaseFamily {
    /// Writes the case of size n.
    pub fn case(&self, n: u64) -> String {
        let mut text = self.text.replace("{n}", &n.to_string());
        if !self.repeated.is_empty() {
            let claims = (1..=n).map(|i| self.repeated.replace("{i}", &i.to_string()));
            text.extend(claims);
        }
        text
    }
}

/// All families, in the order of reports.
pub const FAMILIES: [CaseFamily; 10] = [
    CaseFamily {
        name: "chain",
        size: "oscillators",
        first: 5,
        last: 1000,
        counts_states: false,
        text: r#"title = "Chain of oscillators, as a Lagrangian system"
system = "nonholonomic"
[parameters]
n = {n}
m = "1..2"
k = "1..3"
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, m*q'[i]²)/2"
potential = "k*(q[1]² + q[n]² + sum(i, 1..n−1, (q[i+1] − q[i])²))/2"
[[claim]]
integral = "energy"
[[claim]]
density = "1"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "pendulum",
        size: "links",
        first: 4,
        last: 1000,
        counts_states: false,
        text: r#"title = "Pendulum of equal links in a plane"
system = "nonholonomic"
[parameters]
n = {n}
m = "1..2"
l = "1..2"
g = "1..2"
[state]
q = "vector(n, -1..1)"
"q'" = "vector(n, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, sum(j, 1..i, q'[j]*cos(q[j]))² + sum(j, 1..i, q'[j]*sin(q[j]))²)*m*l²/2"
potential = "−m*g*l*sum(i, 1..n, (n + 1 − i)*cos(q[i]))"
[[claim]]
integral = "energy"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "toda",
        size: "points",
        first: 25,
        last: 1024,
        counts_states: false,
        text: r#"title = "Open Toda lattice"
[parameters]
n = {n}
[state]
a = "vector(n−1, 0.5..2)"
b = "vector(n, -1..1)"
[field]
"a[i]'" = "a[i]*(b[i+1] − b[i])"
"b[i]'" = "2*(a[i]² − a[i−1]²)"
"b[1]'" = "2*a[1]²"
"b[n]'" = "−2*a[n−1]²"
[[claim]]
integral = "sum(i, 1..n, b[i])"
[[claim]]
integral = "sum(i, 1..n, b[i]²) + 2*sum(i, 1..n−1, a[i]²)"
[[claim]]
density = "1/product(i, 1..n−1, a[i])"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "calogero",
        size: "particles",
        first: 6,
        last: 1000,
        counts_states: false,
        text: r#"title = "System of Calogero and Moser, by its Hamiltonian"
[parameters]
n = {n}
g = "1..2"
[state]
q = "vector(n, 0..1)"
p = "vector(n, -1..1)"
[hamiltonian]
function = "sum(i, 1..n, p[i]²)/2 + g²*sum(i, 1..n−1, sum(j, i+1..n, 1/(q[i] − q[j] + 2*(i − j))²))"
pairs = [["q", "p"]]
[[claim]]
integral = "energy"
[[claim]]
integral = "sum(i, 1..n, p[i])"
[[claim]]
density = "1"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "lotka-volterra",
        size: "species",
        first: 10,
        last: 100,
        counts_states: false,
        text: r#"title = "Dense system of Lotka and Volterra"
[parameters]
n = {n}
c = "vector(n, 1..2)"
[state]
x = "vector(n, 1..2)"
[field]
"x[i]'" = "x[i]*sum(j, 1..n, (i − j)/(i + j)*(x[j] − c[j]))"
[[claim]]
integral = "sum(i, 1..n, x[i] − c[i]*log(x[i]))"
[[claim]]
density = "1/product(i, 1..n, x[i])"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "bodies",
        size: "bodies",
        first: 4,
        last: 340,
        counts_states: false,
        text: r#"title = "Bodies that attract each other, as a Lagrangian system"
system = "nonholonomic"
[parameters]
n = {n}
m = "vector(n, 1..2)"
[state]
q = "matrix(n, 3, -2..2)"
"q'" = "matrix(n, 3, -1..1)"
[lagrangian]
kinetic = "sum(i, 1..n, m[i]*q'[i]²)/2"
potential = "−sum(i, 1..n−1, sum(j, i+1..n, m[i]*m[j]/|q[i] − q[j]|))"
[[claim]]
integral = "energy"
[[claim]]
integral = "sum(i, 1..n, m[i]*q'[i])"
[[claim]]
integral = "sum(i, 1..n, m[i]*q[i] × q'[i])"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "claims",
        size: "claims",
        first: 16,
        last: 1024,
        counts_states: false,
        text: r#"title = "Euler's top, with many claims"
[parameters]
I = "inertia(0.5..5)"
[state]
M = "vector(-2..2)"
[field]
"M'" = "M × inverse(I)*M"
"#,
        repeated: "[[claim]]\nintegral = \"(M,M)² + {i}*(M,inverse(I)*M)\"\n",
    },
    CaseFamily {
        name: "terms",
        size: "terms",
        first: 250,
        last: 1_000_000,
        counts_states: false,
        text: r#"title = "Oscillator, with an integral of many terms"
[parameters]
n = {n}
k = "1..2"
[state]
x = "-1..1"
y = "-1..1"
[field]
"x'" = "k*y"
"y'" = "−k*x"
[[claim]]
integral = "sum(i, 1..n, (x² + y² + i)²)"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "roots",
        size: "roots",
        first: 4,
        last: 1000,
        counts_states: false,
        text: r#"title = "Oscillator, with an integral of many roots"
[parameters]
n = {n}
k = "1..2"
[state]
x = "-1..1"
y = "-1..1"
[field]
"x'" = "k*y"
"y'" = "−k*x"
[[claim]]
integral = "sum(i, 1..n, √(x² + y² + i))"
"#,
        repeated: "",
    },
    CaseFamily {
        name: "states",
        size: "states",
        first: 65_536,
        last: 1_000_000_000,
        counts_states: true,
        text: r#"title = "Euler's top, at many states"
[parameters]
I = "inertia(0.5..5)"
[state]
M = "vector(-2..2)"
[field]
"M'" = "M × inverse(I)*M"
[[claim]]
integral = "(M,M)"
"#,
        repeated: "",
    },
];
