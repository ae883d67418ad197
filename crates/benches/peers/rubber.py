"""Rubber bodies on a plane in plain formulas, over any numbers: floats or heyoka's expressions.

    Ĩω' = K + λγ,  K = Ĩω×ω − m r×(ω×r'),  γ' = γ×ω,  Ĩ = I + m r²E − m r⊗r
    ball: r = −Rγ − c      ellipsoid: r = −Bγ/√(γ,Bγ)
"""

import heyoka as hk

MASS, RADIUS, CENTRE = 1.3, 3.0, (0.7, -0.4, 1.1)
INERTIA, SQUARES = (2.6, 1.2, 1.8), (1.0, 2.0, 3.5)
INERTIA_MB_MU = tuple(MASS * b + 2.0 for b in SQUARES)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(factor, a):
    return [factor * x for x in a]


def plus(*vectors):
    return [sum(parts[1:], parts[0]) for parts in zip(*vectors)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def image(matrix, a):
    return [dot(row, a) for row in matrix]


def inertia_at(r, central):
    square = dot(r, r)
    entry = lambda i, j: central[i] + MASS * (square - r[i] * r[i]) if i == j else -MASS * r[i] * r[j]
    return [[entry(min(i, j), max(i, j)) for j in range(3)] for i in range(3)]


def adjugate(a):
    minor = lambda i, j, k, l: a[i][j] * a[k][l] - a[i][l] * a[k][j]
    upper = {(0, 0): minor(1, 1, 2, 2), (0, 1): minor(0, 2, 2, 1), (0, 2): minor(0, 1, 1, 2),
             (1, 1): minor(0, 0, 2, 2), (1, 2): minor(0, 2, 1, 0), (2, 2): minor(0, 0, 1, 1)}
    return [[upper[min(i, j), max(i, j)] for j in range(3)] for i in range(3)]


def ball(gamma):
    return [-(RADIUS * gamma[k] + CENTRE[k]) for k in range(3)]


def ellipsoid(gamma):
    """r and its derivative by γ, a symmetric matrix."""
    normal = [SQUARES[k] * gamma[k] for k in range(3)]
    inverse = 1.0 / hk.sqrt(dot(gamma, normal))
    r = scaled(-inverse, normal)
    slope = [[inverse * (r[i] * r[j] - (SQUARES[i] if i == j else 0.0)) for j in range(3)]
             for i in range(3)]
    return r, slope


def torque(inertia, omega, r, slide):
    turning = cross(image(inertia, omega), omega)
    return minus(turning, scaled(MASS, cross(r, cross(omega, slide))))


def acceleration(omega, gamma, r, slide, central):
    inertia = inertia_at(r, central)
    force = torque(inertia, omega, r, slide)
    inverse = adjugate(inertia)
    along = image(inverse, gamma)
    factor = dot(force, along) / dot(gamma, along)
    determinant = dot(inertia[0], inverse[0])
    return [x / determinant for x in image(inverse, minus(force, scaled(factor, gamma)))]


def field(omega, gamma, shape, central):
    rate = cross(gamma, omega)
    if shape == "ball":
        r, slide = ball(gamma), scaled(-RADIUS, rate)
    else:
        r, slope = ellipsoid(gamma)
        slide = image(slope, rate)
    return acceleration(omega, gamma, r, slide, central) + rate


def second_integral(omega, gamma, factor, gradient):
    """W1: the gradient of |Ĩω×γ|² − factor mR(γ,c)(Ĩω,ω) along the field."""
    momentum = image(inertia_at(ball(gamma), INERTIA), omega)
    turned = cross(momentum, gamma)
    height = dot(gamma, CENTRE)
    value = dot(turned, turned) - factor * MASS * RADIUS * height * dot(momentum, omega)
    slopes = gradient([value], [*omega, *gamma])[0]
    return sum(s * v for s, v in zip(slopes, field(omega, gamma, "ball", INERTIA)))


def second_integral_by_hand(omega, gamma, factor):
    """W1 without an inverse: (Ĩω)' = Ĩ'ω + K + λγ, (Ĩω,ω)' = ((Ĩω)',ω) + (K + λγ,ω)."""
    rate = cross(gamma, omega)
    r, slide = ball(gamma), scaled(-RADIUS, rate)
    inertia = inertia_at(r, INERTIA)
    momentum = image(inertia, omega)
    force = torque(inertia, omega, r, slide)
    along = image(adjugate(inertia), gamma)
    force = minus(force, scaled(dot(force, along) / dot(gamma, along), gamma))
    moved = minus(scaled(2.0 * dot(r, slide), omega),
                  plus(scaled(dot(r, omega), slide), scaled(dot(slide, omega), r)))
    change = plus(force, scaled(MASS, moved))
    turned = cross(momentum, gamma)
    turned_change = plus(cross(change, gamma), cross(momentum, rate))
    energy_change = dot(change, omega) + dot(force, omega)
    heights = dot(rate, CENTRE) * dot(momentum, omega) + dot(gamma, CENTRE) * energy_change
    return 2.0 * dot(turned, turned_change) - factor * MASS * RADIUS * heights


def liouville(omega, gamma, central, gradient):
    """W2: v(ln ρ) + div v for ρ = (γ, adj(Ĩ)γ)."""
    rates = field(omega, gamma, "ellipsoid", central)
    density = dot(gamma, image(adjugate(inertia_at(ellipsoid(gamma)[0], central)), gamma))
    slopes = gradient([density], gamma)[0]
    along = dot(slopes, rates[3:]) / density
    return along + divergence(rates, omega, gradient)


def divergence(rates, omega, gradient):
    slopes = gradient(rates[:3], omega)
    return slopes[0][0] + slopes[1][1] + slopes[2][2]


class OnPlane:
    """b = Ĩ⁻¹γ/(γ,Ĩ⁻¹γ), P = Ĩ⁻¹ − b⊗Ĩ⁻¹γ and tr PDJ, D = ∂r/∂γ, J = γ×."""

    def __init__(self, gamma, central):
        self.r, self.slope = ellipsoid(gamma)
        inertia = inertia_at(self.r, central)
        inverse = adjugate(inertia)
        along = image(inverse, gamma)
        self.b = scaled(1.0 / dot(gamma, along), along)
        scale = 1.0 / dot(inertia[0], inverse[0])
        entry = lambda i, j: scale * (inverse[i][j] - self.b[i] * along[j])
        self.across = [[entry(min(i, j), max(i, j)) for j in range(3)] for i in range(3)]
        product = lambda i, j: dot(self.across[i], self.slope[j])
        self.twist = (gamma[0] * (product(1, 2) - product(2, 1))
                      + gamma[1] * (product(2, 0) - product(0, 2))
                      + gamma[2] * (product(0, 1) - product(1, 0)))
        self.pull = image(self.slope, self.r)


def liouville_by_hand(omega, gamma, central):
    """W2: v(ln ρ) + div v = (b,γ') + m(X − Y)."""
    at = OnPlane(gamma, central)
    rate = cross(gamma, omega)
    slide = image(at.slope, rate)
    trace = at.across[0][0] + at.across[1][1] + at.across[2][2]
    spread = dot(at.r, slide) * trace - dot(image(at.across, at.r), slide)
    shear = dot(cross(at.pull, gamma), image(at.across, omega)) - dot(at.r, omega) * at.twist
    return dot(at.b, rate) + MASS * (spread - shear)


def criterion(omega, gamma, central, gradient):
    """W3 from the definitions: div v = (χ,ω), and (γ, rot(γ×χ))."""
    spread = divergence(field(omega, gamma, "ellipsoid", central), omega, gradient)
    return rotation(cross(gamma, gradient([spread], omega)[0]), gamma, gradient)


def criterion_of_formula(gamma, central, gradient):
    """W3: (γ, rot b)."""
    along = image(adjugate(inertia_at(ellipsoid(gamma)[0], central)), gamma)
    return rotation(scaled(1.0 / dot(gamma, along), along), gamma, gradient)


def rotation(covector, gamma, gradient):
    slopes = gradient(covector, gamma)
    return dot(gamma, [slopes[2][1] - slopes[1][2], slopes[0][2] - slopes[2][0],
                       slopes[1][0] - slopes[0][1]])


def criterion_by_hand(gamma, central):
    """W3: (γ, rot b) = m(2(γ×Pb, Dr) − (γ×Pr, Db) − (r,b) tr PDJ)."""
    at = OnPlane(gamma, central)
    first = 2.0 * dot(cross(gamma, image(at.across, at.b)), at.pull)
    second = dot(cross(gamma, image(at.across, at.r)), image(at.slope, at.b))
    return MASS * (first - second - dot(at.r, at.b) * at.twist)
