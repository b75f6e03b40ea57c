"""Common parts of the pictures and the report of the paper: result files by name, rows of the
report, styles."""

import glob
import os
import re
import textwrap

import numpy as np

from plot_results import Result
from plot_style import STYLES, plt

plt.rcParams.update(
    {
        "savefig.dpi": 200,
        "font.size": 9,
        "axes.titlesize": 9,
        "legend.fontsize": 7.5,
        "legend.framealpha": 0.9,
        "image.origin": "lower",
    }
)


def members(folder, name):
    """The result files of a study, in order."""
    return [Result(path) for path in sorted(glob.glob(os.path.join(folder, f"{name}_[0-9]*.nc")))]


def mean_and_error(values):
    """Mean and its standard error."""
    values = np.asarray(values, dtype=float)
    return values.mean(), values.std(ddof=1) / np.sqrt(values.size) if values.size > 1 else np.nan


def jackknife(count, estimate):
    """estimate(keep) of all data, and its jackknife standard error, omitting one of `count` parts
    at a time. `keep` is a boolean mask."""
    full = estimate(np.ones(count, bool))
    if count < 2:
        return full, np.full_like(full, np.nan)
    parts = np.array([estimate(np.arange(count) != k) for k in range(count)])
    return full, np.sqrt((count - 1) / count * ((parts - parts.mean(axis=0)) ** 2).sum(axis=0))


def text(value, digits=4):
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return "-"
    if isinstance(value, str):
        return value
    if value != 0 and abs(value) >= 1e4:
        return f"{value:,.0f}".replace(",", " ")
    return f"{value:.{digits}g}"


def agrees(paper, ours, error):
    """Within 2.5 standard errors, or 2 %."""
    return abs(ours - paper) <= max(0.02 * abs(paper), 2.5 * error if np.isfinite(error) else 0.0)


class Report:
    """The report, by sections. A row: quantity, the paper's number, ours, its standard error, and a
    remark."""

    def __init__(self):
        self.lines = []
        self.rows = []  # (what, paper, ours, error) of rows with both numbers
        self.full = True  # not the shortened version

    def heading(self, title):
        self.lines += ["", title, "-" * len(title)]

    def columns(self):
        self.lines.append(
            f"  {'':56s} {'paper':>12s} {'ours':>12s} {'+-':>10s} {'difference':>18s}"
        )

    def row(self, what, paper, ours, error=np.nan, remark=None):
        difference = ""
        if isinstance(paper, (int, float)) and not isinstance(ours, str) and np.isfinite(ours):
            self.rows.append((what, paper, float(ours), float(error)))
            d = float(ours) - paper
            difference = f"{text(d, 3)} ({100 * d / paper:+.1f} %)" if paper else text(d, 3)
        self.lines.append(
            f"  {what:56s} {text(paper):>12s} "
            f"{text(float(ours) if not isinstance(ours, str) else ours):>12s} "
            f"{text(float(error), 2):>10s} {difference:>18s}".rstrip()
        )
        if remark:
            self.note(remark, indent=6)

    def note(self, words, indent=2):
        self.lines += textwrap.wrap(
            re.sub(r"\s+", " ", words.strip()),
            width=110,
            initial_indent=" " * indent,
            subsequent_indent=" " * indent,
        )

    def finding(self, words):
        """A conclusion from the full numbers, which is omitted in the shortened version."""
        if self.full:
            self.note(words)

    def raw(self, line):
        self.lines.append("  " + line)

    # The paper's numbers by kind: description, beginning of their rows, and reasons for agreement
    # or disagreement.
    KINDS = [
        (
            "the theory of the model",
            ("value of Greenwood", "area fraction beyond", "hardness at"),
            "rsc and the paper use the same model, so these must agree.",
        ),
        (
            "area against load (beta, N*)",
            ("beta, mean", "N*/", "N*, A_I"),
            "The most important difference. A = beta sqrt(2 pi) N/(sqrt(2 m2) E*) with the "
            "paper's beta = 0.2 fits no surface here, by asperities or by "
            "elements, which give 0.7 to 1; the theories of Persson (0.64) and of Bush, "
            "Gibson and Thomas (1) agree with these. N* is proportional to 1/beta^3.",
        ),
        (
            "the gold surface: force, contacts, radius, slope",
            ("N at", "contacts at", "rms slope", "r_g = "),
            "The paper does not state the grid, the plateau of the spectrum and the number of "
            "surfaces "
            "counted. Its force indicates a plateau, its radius and slope none: no single "
            "surface gives all of them.",
        ),
        (
            "summits counted on a grid",
            ("asperities", "kappa1", "<kappa", "r_g sqrt", "grid error"),
            "Four points in the shortest wavelength reduce the curvatures by an amount that "
            "depends on their definition, which the "
            "paper does not state. On finer grids rsc agrees with the theory.",
        ),
        (
            "distributions of pressure and spots",
            ("exponent", "Rayleigh", "mean spot"),
            "Exponents depend on the weight of contacts (equal or by area) and on the range "
            "of the fit, which the paper does not state.",
        ),
        (
            "the paper's method",
            ("solves",),
            "The number of solves for a level depends on the rule for reducing the "
            "regularisation, which the paper does not state.",
        ),
    ]
    # Statements of the paper in short, and the rows to compare with.
    VERDICTS = [
        ("curvatures of summits, kappa1/kappa2", "value of Greenwood's formula itself"),
        ("spots merge beyond an area fraction of [%]", "area fraction beyond"),
        ("rms slope of the gold surface", "rms slope of the gold"),
        ("force at Z0/sigma = 1.43 [N]", "N at Z0/sigma = 1.43 [N], no plateau"),
        ("area over load, beta", "beta, mean of the six"),
        ("force between the regimes, N*/(m2^1.5 E*/m4)", "N*/(m2"),
        ("pressure in contacts, exponent alpha", "exponent alpha at Z0/sigma = 2, no plateau"),
        ("hardness at r = 0.18 um [N/mm2]", "hardness at"),
        ("solves a level by dgesv, 90 % have at most", "solves a level, 90 %"),
    ]

    def verdict(self):
        """Number of confirmed numbers of the paper, by kind and with the reason, and the nine most
        important ones."""
        agree = sum(agrees(*row[1:]) for row in self.rows)
        same = [row for row in self.rows if row[0].startswith(self.KINDS[0][1])]
        met = sum(agrees(*row[1:]) for row in same)
        lines = (
            textwrap.wrap(
                "In short: rsc solves the equations of the paper"
                + (
                    ": all numbers that depend only on them agree. "
                    if met == len(same)
                    else f", but only {met} of {len(same)} numbers that follow from these "
                    "alone agree: that should not be. "
                )
                + "The one number important to users that does not agree is the paper's "
                "area under load (beta = 0.2): rsc, elements on the same surfaces and the theories "
                "have three to five times as much. The other differences concern numbers for "
                "which the paper does not state grid, spectrum or fit; no choice gives all of "
                "them.",
                width=110,
            )
            if self.full and same
            else []
        )
        lines += [
            f"Verdict: of {len(self.rows)} numbers of the paper, {agree} agree (within 2.5 "
            f"standard errors or 2 %), {len(self.rows) - agree} do not."
            + ("" if self.full else " SHORTENED: no verdict on the paper.")
        ]
        for kind, starts, why in self.KINDS:
            rows = [row for row in self.rows if row[0].startswith(starts)]
            if rows:
                lines += textwrap.wrap(
                    f"- {kind}: {sum(agrees(*row[1:]) for row in rows)} of {len(rows)} agree. "
                    + (why if self.full else ""),
                    width=110,
                    subsequent_indent="  ",
                )
        lines.append("The nine most important numbers:")
        for words, row in self.VERDICTS:
            paper, ours, error = next(
                (r[1:] for r in self.rows if r[0].startswith(row)), (None, None, None)
            )
            said = (
                "not in this run"
                if paper is None
                else (
                    f"paper {text(paper)}, rsc {text(ours)}"
                    + (f" +- {text(error, 2)}" if np.isfinite(error) and error > 0 else "")
                    + ": "
                    + (
                        "agrees"
                        if agrees(paper, ours, error)
                        else f"does not agree, {100 * (ours - paper) / paper:+.0f} %"
                    )
                )
            )
            lines.append(f"  {words:46s} {said}")
        return lines

    def write(self, path):
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(self.verdict() + ["", *self.lines]) + "\n")


def save(figure, folder, name):
    path = os.path.join(folder, f"{name}.png")
    figure.savefig(path)
    plt.close(figure)
    print(path)


def judge(ours, error, paper):
    """'agrees within sampling', or the difference in standard errors."""
    if not np.isfinite(error) or error == 0:
        return ""
    pull = abs(ours - paper) / error
    return "agrees within sampling" if pull < 2.5 else f"{pull:.0f} standard errors apart"
