"""Fits to the distributions of a result, by maximum likelihood: Rayleigh, exponential, generalised
gamma. Pressures and areas are in the units of the file; a fit is NaN where there is too little to
fit."""

from collections import namedtuple

import numpy as np

Scale = namedtuple("Scale", "scale error ks_distance")
Gamma = namedtuple(
    "Gamma", "alpha beta delta factor alpha_error beta_error delta_error ks_distance"
)


def shares(result, k, weights, density):
    """Edges of the bins, the shares of their weights and of the overflow, and the sum of all
    weights."""
    values = np.asarray(result.file.variables[weights][k], float)
    total = np.append(values, result.attribute(weights, "overflow")[k])
    width = float(result.file.variables[density.replace("_pdf", "_bin")].bin_width)
    return width * np.arange(values.size + 1), total / max(total.sum(), 1e-300), total.sum()


def distance(share, cumulative):
    """Kolmogorov-Smirnov distance at the upper edges of the bins."""
    return float(np.max(np.abs(np.cumsum(share[:-1]) - cumulative[1:])))


def rayleigh(result, k):
    """Density (p/s^2) exp(-p^2/(2 s^2)) of the mean pressure: s^2 = <p^2>/2."""
    edges, share, count = shares(result, k, "pressure_mean_count", "pressure_mean_pdf")
    mean, deviation = (
        result.attribute("pressure_mean_pdf", a)[k] for a in ("mean", "standard_deviation")
    )
    s = np.sqrt((mean**2 + deviation**2) / 2)
    return Scale(
        s, s / (2 * np.sqrt(count)), distance(share, -np.expm1(-(edges**2) / (2 * s**2)))
    )


def exponential(result, k):
    """Density exp(-A/s)/s of the spot area: s = <A>."""
    edges, share, count = shares(result, k, "spot_area_count", "spot_area_pdf")
    s = result.attribute("spot_area_pdf", "mean")[k]
    return Scale(s, s / np.sqrt(count), distance(share, -np.expm1(-edges / s)))


def generalised_gamma(result, k):
    """Density factor p^alpha exp(-(p/delta)^beta) of the pressure, with the probabilities of whole
    bins; standard errors for the effective number of independent contacts. NaN for fewer than 5
    bins with weight or 10 contacts, and without scipy."""
    edges, share, _ = shares(result, k, "pressure_area", "pressure_pdf")
    return fit_gamma(
        edges,
        share,
        result.attribute("pressure_pdf", "mean")[k],
        result.attribute("pressure_pdf", "independent_contacts")[k],
    )


def fit_gamma(edges, share, mean, independent):
    """The fit to shares of bins between edges, the last share beyond them."""
    none = Gamma(*[np.nan] * 8)
    try:
        from scipy.optimize import minimize
        from scipy.special import gamma, gammainc, gammaincc
    except ImportError:
        return none
    if np.count_nonzero(share[:-1]) < 5 or not independent >= 10:
        return none
    x = edges / mean  # all numbers below are of order one

    def tails(t):
        a, z = np.exp(t[0] - t[1]), (x / np.exp(t[2])) ** np.exp(t[1])
        return np.append(gammainc(a, z), 1), np.append(gammaincc(a, z), 0)

    def probabilities(t):
        low, high = tails(t)  # differences of the smaller tails, to avoid cancellation
        return np.where(low[:-1] < 0.5, np.diff(low), -np.diff(high))

    def loss(t):
        with np.errstate(all="ignore"):
            value = -np.sum(share[share > 0] * np.log(probabilities(t)[share > 0]))
        return value if np.isfinite(value) else 1e9

    # Parameters log(alpha + 1), log(beta), log(delta/mean), from the paper's exponents and the
    # delta that follows from the mean.
    start = np.log([5 / 3, 1.5, gamma(10 / 9) / gamma(16 / 9)])
    found = minimize(
        loss,
        start,
        method="Nelder-Mead",
        options={"xatol": 1e-8, "fatol": 1e-15, "maxiter": 4000, "maxfev": 4000},
    )
    if not found.success:
        return none
    step = 1e-5
    slopes = [
        (probabilities(found.x + step * e) - probabilities(found.x - step * e)) / (2 * step)
        for e in np.eye(3)
    ]
    weight = 1 / np.maximum(probabilities(found.x), 1e-290)
    information = independent * np.array([[np.sum(a * b * weight) for a in slopes] for b in slopes])
    errors = np.sqrt(np.diag(np.linalg.inv(information)))
    (one_more, beta, delta), cumulative = np.exp(found.x), tails(found.x)[0][:-1]
    delta *= mean
    return Gamma(
        one_more - 1,
        beta,
        delta,
        beta / (delta**one_more * gamma(one_more / beta)),
        one_more * errors[0],
        beta * errors[1],
        delta * errors[2],
        distance(share, cumulative),
    )
