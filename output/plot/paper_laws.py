"""Beyond the paper: its contact solved by elements on all points of the same surfaces, compared
with the contact laws of asperities."""

import numpy as np

from paper_common import Result, jackknife, mean_and_error, members
from paper_contact import ROOT
from paper_pressure import PAPER_COUNTS

LAWS = ("hertz", "elliptic", "fourth_order")
COMPARED = (2.5, 2.0, 1.5, 1.0)  # Z0/sigma for the comparison of laws and elements


def law_of(result):
    return (
        "elements"
        if result.case["solver%model"].strip("'") == "elements"
        else result.case["asperities%law"].strip("'")
    )


def waves_of(result):
    return int(result.number("surface%L_lambda_s"))


def points_of(result):
    """Points to the shortest wave."""
    return (
        result.number("elements%points_per_wave")
        if law_of(result) == "elements"
        else result.number("surface%n") / waves_of(result)
    )


def factor(result):
    """sqrt(2 m2) E*/sqrt(2 pi), which multiplied by A/N is beta."""
    return float(np.sqrt(2 * result["m2_theory"]) * result["e_star"]) / ROOT


def beta(result, keep, steps):
    """beta of the means over the kept realizations, at some levels."""
    return np.array(
        [
            factor(result)
            * result["contact_area"][keep, s].mean()
            / result["force"][keep, s].mean()
            for s in steps
        ]
    )


def laws(folder, report):
    asperities, elements = members(folder, "laws"), members(folder, "elements")
    bare = [r for r in elements if ".false." in r.case["surface%plateau"]]
    waves = max(map(waves_of, bare))
    report.heading("Beyond the paper: elements, and the laws of an asperity")
    report.note(
        "model = 'elements' solves the contact of the surface itself: every point may be in "
        "contact, without asperities. The paper's asperity is a Hertz sphere; law = "
        "'elliptic' uses both "
        "curvatures of a summit, 'fourth_order' also its flattening. beta from A/N of the "
        "mean curves, with jackknife errors over realizations; the surfaces are "
        "the same for all, so that the ratio to elements has a much smaller error than beta itself:"
    )
    betas(asperities, bare, report)
    report.columns()
    finest = [
        r
        for r in asperities
        if waves_of(r) == waves
        and points_of(r) == max(points_of(q) for q in asperities if waves_of(q) == waves)
    ]
    for result in finest + [r for r in bare if waves_of(r) == waves]:
        value, error = jackknife(
            result.realizations, lambda keep: beta(result, keep, [result.level(1.0)])[0]
        )
        report.row(f"beta at 1 sigma, L/lambda_s = {waves}, {law_of(result)}", 0.2, value, error)
    truth = next(r for r in bare if waves_of(r) == waves)
    near, far = beta(truth, slice(None), [truth.level(1.0), truth.level(2.0)])
    report.note(
        f"Elements, which are independent of asperities, give {far:.2f} at 2 sigma and "
        f"{near:.2f} at 1 sigma: 0.2 is not due to the shape of asperities, nor to the "
        "asperity model. At the same load "
        f"the paper's A_II has {100 * 0.2 / near:.0f} % of the true contact area. "
        + grid_and_range(asperities, waves)
    )
    distances(asperities, bare, report)
    paper_numbers(folder, elements, asperities, waves, report)


def betas(asperities, bare, report):
    levels = (2.0, 1.5, 1.0)
    report.raw(
        f"    {'L/ls':>5s} {'points':>6s} {'':12s} "
        + " ".join(f"{f'beta at {z:g} sigma':>19s}" for z in levels)
        + f"   {'over elements, 2 sigma':>22s} {'1 sigma':>19s}"
    )
    for truth in bare:
        for result in [r for r in asperities if waves_of(r) == waves_of(truth)] + [truth]:
            steps, true_steps = ([r.level(z) for z in levels] for r in (result, truth))
            count = min(result.realizations, truth.realizations)
            value, error = jackknife(count, lambda keep: beta(result, np.flatnonzero(keep), steps))
            change, change_error = jackknife(
                count,
                lambda keep: beta(result, np.flatnonzero(keep), steps)
                / beta(truth, np.flatnonzero(keep), true_steps),
            )
            line = (
                f"    {waves_of(result):5d} {points_of(result):6.0f} {law_of(result):12s} "
                + " ".join(f"{b:9.4f} +- {e:.4f}" + "  " for b, e in zip(value, error))
            )
            if result is not truth:
                line += " " + " ".join(
                    f"{change[k]:12.4f} +- {change_error[k]:.4f}" for k in (0, 2)
                )
            report.raw(line.rstrip())


def grid_and_range(asperities, waves):
    """Text on the effect of half the points per shortest wavelength, and on the share of contacts
    beyond the range of fourth_order."""
    part = [r for r in asperities if waves_of(r) == waves]
    many, few = max(map(points_of, part)), min(map(points_of, part))

    def at_one_sigma(points, law):
        result = next(r for r in part if points_of(r) == points and law_of(r) == law)
        return result, beta(result, slice(None), [result.level(1.0)])[0]

    change = {law: abs(at_one_sigma(few, law)[1] - at_one_sigma(many, law)[1]) for law in LAWS}
    result = at_one_sigma(many, "fourth_order")[0]
    step = result.level(1.0)
    beyond = result["beyond_law"][:, step].sum() / result["contacts"][:, step].sum()
    return (
        f"With {many:.0f} points to the shortest wave instead of {few:.0f}, beta at 1 sigma "
        f"and L/lambda_s = {waves} changes by {change['hertz']:.4f} for hertz, whose summits "
        "are grid "
        f"points, by {change['elliptic']:.4f} for elliptic and {change['fourth_order']:.4f} "
        f"for fourth_order, which locate summits between them. There {100 * beyond:.0f} % of "
        "the contacts are beyond the range of fourth_order."
    )


def distances(asperities, bare, report):
    """Each law minus elements on the same surfaces, of the sums over realizations."""
    report.note(
        "Laws minus elements in per cent, with the most points per shortest wavelength, of "
        "the sums over the realizations: mean over the levels 2.5, 2, 1.5 and 1 sigma, in "
        "brackets the worst of these levels:"
    )
    report.raw(f"    {'L/ls':>5s} {'law':18s} {'load N':>16s} {'area A':>16s} {'contacts':>16s}")
    for truth in bare:
        part = [r for r in asperities if waves_of(r) == waves_of(truth)]
        most = max(map(points_of, part))
        for result in (r for r in part if points_of(r) == most):
            count = min(result.realizations, truth.realizations)
            cells = []
            for name in ("force", "contact_area", "contacts"):
                total = lambda r, z: r[name][:count, r.level(z)].sum()
                off = [
                    100 * (total(result, z) / total(truth, z) - 1)
                    for z in COMPARED
                    if total(truth, z) > 0
                ]
                cells.append(f"{f'{np.mean(off):+.1f} ({max(off, key=abs):+.1f})':>16s}")
            report.raw(f"    {waves_of(truth):5d} {law_of(result):18s} " + " ".join(cells))


def paper_numbers(folder, elements, asperities, waves, report):
    """The paper's force and its numbers of contacts, by elements and by asperities on the same
    surfaces."""
    runs = {False: Result(f"{folder}/maps.nc"), True: Result(f"{folder}/maps_plateau.nc")}
    report.columns()
    counts = []
    for truth in (r for r in elements if waves_of(r) == waves):
        plateau = ".true." in truth.case["surface%plateau"]
        name, run = ("plateau" if plateau else "no plateau"), runs[plateau]
        first = slice(0, min(truth.realizations, run.realizations))
        # On the same surfaces the ratio of elements to the asperities of maps.nc has a small error;
        # it is applied to their 2 000 surfaces.
        step, own = truth.level(10 / 7), run.level(10 / 7)
        ratio, ratio_error = jackknife(
            first.stop,
            lambda keep: np.array(
                truth["force"][first, step][keep].sum() / run["force"][first, own][keep].sum()
            ),
        )
        mean, error = mean_and_error(run["force"][:, own])
        report.row(
            f"N at Z0/sigma = 1.43 [N], {name}, elements",
            116.6,
            mean * float(ratio),
            mean * float(ratio) * np.hypot(error / mean, float(ratio_error) / float(ratio)),
            f"That of {run.realizations} realizations with the paper's asperities, times "
            f"{float(ratio):.4f} +- {float(ratio_error):.4f}, elements over asperities on "
            f"{first.stop} of these surfaces.",
        )
        counts.append((name, truth, run, first))
    report.note(
        "Numbers of contacts per surface, and numbers of realizations that would give the "
        "paper's three counts (320 000, 157 000, 39 000 at 2, 2.5 and 3 sigma). A contact of "
        "elements is a connected set of "
        "points, in which several summits may have merged; hertz: the paper's asperities, "
        "four points to the shortest wave; both on the same surfaces:"
    )
    report.raw(
        f"    {'':26s} "
        + " ".join(f"{f'{z:g} sigma':>10s}" for z in PAPER_COUNTS)
        + f"   {'realizations for the counts':>28s}"
    )
    for name, truth, run, first in counts:
        for what, r in (("hertz", run), ("elements", truth)):
            found = [r["contacts"][first, r.level(z)].mean() for z in PAPER_COUNTS]
            report.raw(
                f"    {f'{name}, {what}':26s} "
                + " ".join(f"{c:10.2f}" for c in found)
                + "   "
                + ", ".join(
                    f"{n / c:.0f}" if c > 0 else "-" for n, c in zip(PAPER_COUNTS.values(), found)
                ).rjust(28)
            )
    _, truth, run, first = counts[0]
    elements_found, hertz_found = (
        np.array([r["contacts"][first, r.level(z)].mean() for z in PAPER_COUNTS])
        for r in (truth, run)
    )
    fewer = 100 * (1 - elements_found / np.maximum(hertz_found, 1e-9))
    report.note(
        f"Without plateau elements have {fewer[0]:.0f}, {fewer[1]:.0f} and {fewer[2]:.0f} % "
        "fewer contacts at these levels, because summits have merged."
    )
    report.finding(
        "The paper's three counts are no more consistent with them, and its force differs "
        "more: the disagreement is not due to asperities that do not merge."
    )
