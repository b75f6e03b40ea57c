"""Beyond the paper: what the laws of an asperity make of its factor beta, and how far each lies from boundary elements."""

import os

import numpy as np

from paper_common import jackknife, members, text
from paper_contact import ROOT

ELEMENTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../test/data/boundary_elements.txt")
LAWS = ("hertz", "elliptic", "fourth_order")


def law_of(result):
    return result.case["asperities%law"].strip("'")


def factor(result):
    """sqrt(2 m2) E*/sqrt(2 pi): times A/N it is beta."""
    return float(np.sqrt(2 * result["m2_theory"]) * result["e_star"]) / ROOT


def laws(folder, report):
    report.heading("Beyond the paper: laws of an asperity")
    report.note("The paper's asperity is a Hertz sphere. law = 'elliptic' takes the two curvatures of a summit for what they are, 'fourth_order' its flattening, too. What beta becomes with them, "
                "A/N of the mean curves, errors by leaving out one realization at a time; the surfaces are the same for all laws, so the ratio to hertz is known much better than beta itself:")
    results = members(folder, "laws")
    levels, everything = (2.0, 1.5, 1.0), []
    report.raw(f"    {'L/ls':>5s} {'n':>5s} {'points':>6s} {'law':12s} " + " ".join(f"{f'beta at {z:g} sigma':>19s}" for z in levels) + f"   {'over hertz, 2 sigma':>21s} {'1 sigma':>19s}")
    for result in results:
        waves = result.number("surface%L_lambda_s")
        same = lambda r: all(r.number(key) == result.number(key) for key in ("surface%L_lambda_s", "surface%n"))
        hertz = next(r for r in results if law_of(r) == "hertz" and same(r))
        steps = [result.level(z) for z in levels]
        count = result.realizations
        beta, error = jackknife(count, lambda keep: mean_ratio(result, keep, steps))
        change, change_error = jackknife(count, lambda keep: mean_ratio(result, keep, steps) / mean_ratio(hertz, keep, steps))
        line = f"    {waves:5.0f} {result.number('surface%n'):5.0f} {result.number('surface%n') / waves:6.0f} {law_of(result):12s} " + " ".join(f"{b:9.4f} +- {e:.4f}" + "  " for b, e in zip(beta, error))
        if result is not hertz:
            line += " " + " ".join(f"{change[k]:12.4f} +- {change_error[k]:.4f}" for k in (0, 2))
        report.raw(line.rstrip())
        everything += list(beta)
    finest = max(r.number("surface%L_lambda_s") for r in results)
    grid = max(r.number("surface%n") for r in results if r.number("surface%L_lambda_s") == finest)
    report.columns()
    for result in results:
        if (result.number("surface%L_lambda_s"), result.number("surface%n")) == (finest, grid):
            beta, error = jackknife(result.realizations, lambda keep: mean_ratio(result, keep, [result.level(1.0)])[0])
            report.row(f"beta at 1 sigma, n = {grid:.0f}, law {law_of(result)}", 0.2, beta, error)
    report.note(f"No law brings beta near 0.2: it lies from {min(everything):.2f} to {max(everything):.2f} in all of these. {results[0].realizations} realizations of each.")
    report.finding("fourth_order raises beta by its area, elliptic lowers it. " + grid_and_range(results, finest, grid))
    elements(folder, report)


def grid_and_range(results, waves, grid):
    """What half the points to the shortest wave change, and how many contacts are beyond fourth_order's range, in words."""
    def at_one_sigma(n, law):
        result = next(r for r in results if (r.number("surface%L_lambda_s"), r.number("surface%n")) == (waves, n) and law_of(r) == law)
        return result, mean_ratio(result, range(result.realizations), [result.level(1.0)])[0]

    change = {law: abs(at_one_sigma(grid / 2, law)[1] - at_one_sigma(grid, law)[1]) for law in LAWS}
    result = at_one_sigma(grid, "fourth_order")[0]
    step = result.level(1.0)
    beyond = result["beyond_law"][:, step].sum() / result["contacts"][:, step].sum()
    return (f"With {grid / waves:.0f} points to the shortest wave instead of {grid / 2 / waves:.0f}, beta at 1 sigma and L/lambda_s = {waves:.0f} changes by {change['hertz']:.4f} for hertz, whose summits are grid "
            f"points, by {change['elliptic']:.4f} for elliptic and {change['fourth_order']:.4f} for fourth_order, which look between them. There {100 * beyond:.0f} % of the contacts are beyond the range of fourth_order.")


def mean_ratio(result, keep, steps):
    """beta of the means over the kept realizations, at some levels."""
    return np.array([factor(result) * result["contact_area"][keep, s].mean() / result["force"][keep, s].mean() for s in steps])


def read_elements():
    """{(L/lambda_s, seed): {Z0/sigma: (N, corrected A)}} of the finest grid."""
    finest, found = {}, {}
    for row in np.loadtxt(ELEMENTS):
        key, n = (int(row[0]), int(row[1])), int(row[3])
        if n > finest.get(key, 0):
            finest[key], found[key] = n, {}
        if n == finest[key]:
            found[key][row[2]] = row[4], row[6]
    return found


def elements(folder, report):
    """Each law beside full boundary-element solutions of the same surfaces."""
    if not os.path.exists(ELEMENTS):
        report.note("Boundary elements: test/data/boundary_elements.txt is not there; the README has the table.")
        return
    reference = read_elements()
    results = members(folder, "laws_elements")
    report.note("Beside boundary elements on the very same surfaces (test/data/boundary_elements.txt: 4096^2 elements, area corrected by its perimeter): model minus boundary elements in per cent, "
                "mean over two surfaces and the levels 2.5, 2, 1.5 and 1 sigma, in brackets the worst; beta with both surfaces together. At 64 and 128 the elements resolve the surface; for "
                "the paper's 512 there is no such solution here.")
    report.raw(f"    {'L/ls':>5s} {'law':18s} {'load N':>16s} {'area A':>16s} {'beta at 2 sigma':>16s} {'1 sigma':>9s}")
    for waves in sorted({int(r.number("surface%L_lambda_s")) for r in results}):
        part = [r for r in results if r.number("surface%L_lambda_s") == waves]
        for law in LAWS:
            N, A, sums = [], [], {2.0: np.zeros(2), 1.0: np.zeros(2)}
            for r in part:
                if law_of(r) != law:
                    continue
                for step, z in enumerate(r["separation_sigma"]):
                    ours = np.array([r["force"][0, step], r["contact_area"][0, step]])
                    truth = reference[waves, int(r.number("run%seed"))][round(z, 3)]
                    N.append(100 * (ours[0] / truth[0] - 1))
                    A.append(100 * (ours[1] / truth[1] - 1))
                    if round(z, 3) in sums:
                        sums[round(z, 3)] += ours
            worst = lambda v: max(v, key=abs)
            report.raw(f"    {waves:5d} {law:18s} {f'{np.mean(N):+.1f} ({worst(N):+.1f})':>16s} {f'{np.mean(A):+.1f} ({worst(A):+.1f})':>16s} "
                       + " ".join(f"{factor(part[0]) * sums[z][1] / sums[z][0]:{width}.3f}" for z, width in ((2.0, 16), (1.0, 9))))
        truth = {z: np.sum([reference[waves, seed][z] for w, seed in reference if w == waves], axis=0) for z in (2.0, 1.0)}
        report.raw(f"    {waves:5d} {'boundary elements':18s} {'':16s} {'':16s} " + " ".join(f"{factor(part[0]) * truth[z][1] / truth[z][0]:{width}.3f}" for z, width in ((2.0, 16), (1.0, 9))))
    report.note("So beta = 0.2 is not a matter of the asperity's shape either: boundary elements, which know nothing of asperities, give a beta of the same size as every law here.")
