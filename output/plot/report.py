#!/usr/bin/env python3
"""A self-contained HTML page on a result of rsc, with its pictures.

    report.py output/first.nc                        output/first.html
    report.py output/study_manifest.nc -o study.html

It contains the levels with status and errors, bodies and surface, the pictures of plot.py, the
case, and the citation. Needs the packages of plot.py."""

import argparse
import base64
import html
import io
import os
import sys

from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "netCDF4", "matplotlib")

import numpy as np

import plot
from plot_results import differing_keys, key_label, value_text
from plot_style import amount, plt, short

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "export"))
import table  # noqa: E402

STATUS = {
    "converged": "residual below the tolerance, at a locally unique minimum of the energy",
    "with_doubts": "",
    "overlapping": "spots closer than the sum of their radii: spots that would merge count as two",
    "not_unique": "other solutions may exist; the solution is selected by a fixed rule",
    "not_converged": "not converged: do not use",
}
# Variables that are 0 if there is nothing to report.
REMARKS = [
    "edge_contacts",
    "overlapping_pairs",
    "large_contacts",
    "beyond_law",
    "crowded_cells",
    "contacts_outside_map",
    "plastic_contacts",
    "extreme_area_fraction",
    "filled_share",
    "wide_contacts",
    "jumps",
]
SURFACE = [
    "sigma",
    "rms_slope",
    "m2",
    "m4",
    "nayak_theory",
    "density_theory",
    "summits",
    "mean_kappa_g",
    "skewness",
    "kurtosis",
    "sq",
    "ssk",
    "sku",
    "sdq",
    "isotropy_ratio",
    "points_per_wave",
    "filled_points",
    "outlier_points",
]
BODIES = ["e_star", "r_star", "transition_force", "pull_off_force"]
SOLIDS = [
    "E",
    "nu",
    "R",
    "hardness",
    "size_effect",
    "resistivity",
    "friction",
    "adhesion",
    "adhesion_range",
    "layer_thickness",
    "layer_E",
    "layer_nu",
    "relaxation_share",
    "relaxation_time",
]
MOST_LEVELS = 12
STYLE = """
body{font:15px/1.45 sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.6rem;margin-bottom:.2rem}
h2{font-size:1.15rem;border-bottom:1px solid #ccc;margin-top:2rem}
table{border-collapse:collapse;font-size:.85rem}
td,th{padding:.2rem .6rem;border-bottom:1px solid #ddd;text-align:right}
th{vertical-align:bottom}
td{white-space:nowrap}
.text td{white-space:normal}
td:first-child,th:first-child,.text td{text-align:left}
img{max-width:100%;display:block;margin:1rem auto}
pre{background:#f5f5f5;padding:.8rem;overflow-x:auto;font-size:.8rem}
.verdict{padding:.6rem 1rem;border-left:5px solid #4b8b3b;background:#f2f7f0}
.verdict.warn{border-color:#b08d00;background:#fbf7e8}
.verdict.bad{border-color:#c1440e;background:#fbefe9}
.scroll{overflow-x:auto}"""


def cells(header, lines, kind=""):
    row = (
        lambda words, tag: "<tr>"
        + "".join(f"<{tag}>{html.escape(str(w)).replace('_', '_<wbr>')}</{tag}>" for w in words)
        + "</tr>"
    )
    return (
        f'<div class="scroll"><table class="{kind}">'
        + (row(header, "th") if header else "")
        + "".join(row(line, "td") for line in lines)
        + "</table></div>"
    )


def shortened(text):
    """A number of the table with four digits; texts unchanged."""
    try:
        return short(float(text), 4)
    except ValueError:
        return text


def percent(values):
    low, high = (
        short(100 * value, 2) if value <= 10 else "more than 1000"
        for value in (np.nanmin(values), np.nanmax(values))
    )
    return f"{high} %" if low == high else f"{low} to {high} %"


def trust(results):
    """(class of the verdict, sentences) from the status and the expected errors of all levels."""
    levels = [(r, s, list(STATUS)[r.level_status()[s]]) for r in results for s in r.loaded()]
    counts = {}
    for _, _, name in levels:
        counts[name] = counts.get(name, 0) + 1
    if not counts:
        return "warn", ["No level has contact."]
    doubts = [word for r, s, name in levels if name == "with_doubts" for word in r.causes(s)]
    doubts = [f"{word} ({doubts.count(word)})" for word in sorted(set(doubts))]
    meaning = {**STATUS, "with_doubts": ", ".join(doubts)}
    said = [
        f"{counts[name]} of {len(levels)} levels {name.replace('_', ' ')}: {meaning[name]}."
        for name in STATUS
        if name in counts
    ]
    worst = {"not_converged": "bad", "with_doubts": "warn"}
    kind = next((worst[name] for name in worst if name in counts), "")
    for name, what in (("force_error_expected", "force"), ("area_error_expected", "contact area")):
        known = [r.worst(name)[r.loaded()] for r in results if name in r and r.loaded().size]
        if known and np.isfinite(np.concatenate(known)).any():
            said.append(
                f"The error of the {what} is at most {percent(np.concatenate(known))}, "
                "depending on the level: bounds valid in nine of ten cases."
            )
    for r in results:
        if "force_error" in r or "area_error" in r:
            said += [
                f"Compared with elements on the same surface, level {int(step)}: "
                + ", ".join(
                    f"{what} {100 * error:+.2g} %" for what, error in errors if np.isfinite(error)
                )
                + "."
                for step, *values in zip(
                    r["compare_step"], *(r[n] for n in ("force_error", "area_error") if n in r)
                )
                for errors in [
                    list(
                        zip(
                            [
                                w
                                for n, w in (("force_error", "force"), ("area_error", "area"))
                                if n in r
                            ],
                            values,
                        )
                    )
                ]
            ]
    return kind, said


def remarks(results):
    lines = []
    for name in REMARKS:
        found = [(r, r.worst(name)) for r in results if name in r]
        count = sum(
            int((values > (0.01 if name == "extreme_area_fraction" else 0)).sum())
            for _, values in found
        )
        if count:
            lines.append(
                [
                    name,
                    found[0][0].file[name].long_name,
                    f"{count} levels",
                    short(max(values.max() for _, values in found)),
                ]
            )
    return lines


def known(result, names):
    """[(name, meaning, value with its unit)] of scalars and of means over realizations."""
    lines = []
    for name in names:
        if name in result and result[name].ndim < 2:
            values = np.atleast_1d(result[name])
            values = values[np.isfinite(values)]
            if values.size:
                text = amount(values.mean(), result.dimension(name), 4)
                lines.append(
                    (
                        name,
                        result.file[name].long_name,
                        text
                        + (
                            f" ± {amount(values.std(ddof=1), result.dimension(name), 2)}"
                            if values.size > 1 and np.ptp(values) > 1e-9 * abs(values.mean())
                            else ""
                        ),
                    )
                )
    return lines


def levels_of(results, keys):
    """Header and rows: some levels of one result, or the last loaded level of each of several
    results."""
    if len(results) == 1:
        header, lines = table.rows([results[0].path])
        at = [
            k
            for k in np.unique(
                np.linspace(0, len(lines) - 1, min(len(lines), MOST_LEVELS)).round().astype(int)
            )
        ]
        return (
            header,
            [[shortened(text) for text in lines[k]] for k in at],
            f"{len(at)} of {len(lines)} levels" if len(at) < len(lines) else "all levels",
        )
    header, lines = [], []
    for result in results:
        top, rows = table.rows([result.path])
        values = dict(zip(top, rows[int(result.loaded()[-1]) if result.loaded().size else -1]))
        line = {
            " ".join(
                filter(
                    None,
                    (
                        key.split("%")[1],
                        f"[{key_label(key, result)[1]}]" if key_label(key, result)[1] else "",
                    ),
                )
            ).replace("$^{-2}$", "-2"): value_text(result.case.get(key, ""))
            for key in keys
        } | values
        header += [name for name in line if name not in header]
        lines.append(line)
    return (
        header,
        [[shortened(line.get(name, "")) for name in header] for line in lines],
        "the last level of each",
    )


def pictures(results, width):
    """[(name, description, PNG as base64)]"""
    drawn, options = [], plot.Options(width=width, say=lambda text: None)
    for name, draw in plot.PICTURES.items():
        figure = draw(results, options)
        if figure is None:
            continue
        png = io.BytesIO()
        figure.savefig(png, format="png", dpi=130)
        plt.close(figure)
        drawn.append(
            (
                name,
                " ".join((draw.__doc__ or name).split("\n\n")[0].split()),
                base64.b64encode(png.getvalue()).decode(),
            )
        )
    return drawn


def page(results):
    first = results[0]
    keys = differing_keys(results) if len(results) > 1 else []
    title = (
        first.title
        if len(results) == 1
        else os.path.commonprefix([r.title for r in results]).strip(" ,:(")
    ) or os.path.basename(first.path)
    kind, said = trust(results)
    parts = [f"<h1>{html.escape(title)}</h1>"]
    many = f"{len(results)} results, " if len(results) > 1 else ""
    of = f"{first.realizations} realizations" if first.realizations > 1 else "one realization"
    parts.append(
        f"<p>{many}{getattr(first.file, 'indenter', '')}, by "
        f"{'elements' if first.by_elements() else 'asperities'}, {of}, {first.steps} levels. "
        f"{html.escape(first.file.source.split(',')[0])}.</p>"
    )
    parts.append(f'<div class="verdict {kind}">' + "<br>".join(map(html.escape, said)) + "</div>")
    header, lines, which = levels_of(results, keys)
    parts += [
        f"<h2>Levels</h2><p>{which}; expected errors are fractions of the value.</p>",
        cells(header, lines),
    ]
    if noted := remarks(results):
        parts += ["<h2>Remarks</h2>", cells(["", "", "found in", "at most"], noted, "text")]
    parts.append("<h2>Pictures</h2>")
    parts += [
        f'<img alt="{html.escape(name)}: {html.escape(what)}" src="data:image/png;base64,{png}">'
        for name, what, png in pictures(results, 180.0)
    ]
    units = " and ".join(
        first.case.get(f"run%{u}_unit", "").strip("'") for u in ("length", "force")
    )
    solids = [
        (f"solids%{name}", "", first.case[f"solids%{name}"])
        for name in SOLIDS
        if first.case.get(f"solids%{name}", "") not in ("", "0.0", "0.0, 0.0")
        and f"solids%{name}" not in keys
    ]
    parts += [
        "<h2>Bodies</h2><p>Body 1 is rough, body 2 presses: "
        f"{html.escape(getattr(first.file, 'indenter', ''))}. Keys are in {units}.</p>",
        cells([], solids + known(first, BODIES), "text"),
    ]
    parts += [
        "<h2>Surface</h2>" + ("<p>Of the first result.</p>" if len(results) > 1 else ""),
        cells([], known(first, SURFACE), "text"),
    ]
    parts += [
        "<h2>Case</h2><p>The namelist that reproduces the result"
        + (" (that of the first result)" if len(results) > 1 else "")
        + (
            ".</p><details><summary>every "
            f"key</summary><pre>{html.escape(first.file.case)}</pre></details>"
        )
    ]
    files = "\n".join(
        r.path + "  " + getattr(r.file, "history", "").split("\n")[0] for r in results[:20]
    ) + ("\n..." if len(results) > 20 else "")
    parts += [
        "<h2>Files and "
        f"version</h2><pre>{html.escape(files)}\n{html.escape(first.file.source)}</pre>"
    ]
    parts += [
        f"<h2>How to cite</h2><p>{html.escape(first.file.source.split(',')[0])}: rough "
        "spheres in contact (CITATION.cff), and the paper whose model it "
        f"solves:<br>{html.escape(getattr(first.file, 'references', ''))}</p>"
    ]
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width">'
        f"<title>{html.escape(title)}</title><style>{STYLE}</style></head>\n<body>"
        + "\n".join(parts)
        + "</body></html>\n"
    )


def main(words=None):
    parser = argparse.ArgumentParser(
        description="One HTML page on results of rsc, including pictures."
    )
    parser.add_argument(
        "result", nargs="+", help="result files (NetCDF), or the manifest of a study"
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="the page (default: the result's name with .html)"
    )
    arguments = parser.parse_args(words)
    results, stem = plot.open_results(arguments.result)
    if not results:
        sys.exit("report.py: the study has no results yet")
    path = arguments.output or os.path.join(os.path.dirname(arguments.result[0]), stem + ".html")
    try:
        text = page(results)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
    except table.Refused as reason:
        sys.exit(f"report.py: {reason}")
    except OSError as error:
        sys.exit(f"report.py: cannot write: {error}")
    print(path)


if __name__ == "__main__":
    main()
