#!/usr/bin/env python3
"""Two pictures and a report of rough flats under a pressure, from the result files of
input/flat/run.sh.

    python3 output/plot/flat.py [FOLDER]

reads the result files in FOLDER (default output/flat) and writes flat_*.png and report.txt there.
Needs numpy, scipy, matplotlib and netCDF4 (Debian: python3-scipy, python3-matplotlib,
python3-netcdf4)."""

import argparse
import os
import sys

from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "scipy", "netCDF4", "matplotlib")

import numpy as np

from paper_common import STYLES, Report, mean_and_error, members, plt, save

PERSSON, BUSH = np.sqrt(8 / np.pi), np.sqrt(2 * np.pi)  # kappa at light load


def kappa(result):
    """A E* h'/N of each realization, with the rms slope h' of its surface."""
    return (
        (result["contact_area"] / result["force"])[:, 0]
        * float(result["e_star"])
        * result["rms_slope"]
    )


def nayak(folder, report):
    """Area over load against Nayak's parameter."""
    figure, axis = plt.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    of = {}
    for (marker, line, colour), model in zip(STYLES, ("elements", "asperities")):
        runs = members(folder, f"alpha_{model}")
        alpha = np.array([float(r["nayak_theory"]) for r in runs])
        values = np.array([mean_and_error(kappa(r)) for r in runs])
        slope, at_1 = np.polyfit(np.log10(alpha), values[:, 0], 1)
        of[model] = (runs, alpha, values, slope, at_1)
        axis.errorbar(
            alpha,
            values[:, 0],
            yerr=values[:, 1],
            fmt=marker,
            ms=4,
            mfc="none",
            color=colour,
            elinewidth=0.7,
            label=model,
        )
        axis.plot(alpha, at_1 + slope * np.log10(alpha), line, color=colour, lw=1)
    runs, alpha, values, slope, at_1 = of["elements"]
    for value, name in (
        (BUSH, r"Bush, Gibson, Thomas $\sqrt{2\pi}$"),
        (PERSSON, r"Persson $\sqrt{8/\pi}$"),
    ):
        axis.axhline(value, color="0.5", lw=0.8)
        axis.text(alpha[-1], value, name, ha="right", va="bottom", fontsize=7.5, color="0.35")
    pressure = runs[0].case["indentation%levels"]
    axis.set(
        xscale="log",
        xlabel=r"Nayak's parameter $\alpha = m_0 m_4/m_2^2$",
        ylabel=r"$\kappa = A\,E^*h'/N$",
        ylim=(1.1, 2.7),
        title=f"$p/(E^*h')$ = {pressure}, {runs[0].realizations} surfaces a point",
    )
    axis.legend(loc="lower left")
    save(figure, folder, "flat_kappa")

    report.heading("Area over load against Nayak's parameter (flat_kappa.png)")
    report.note(
        f"kappa = A E* h'/N at p/(E* h') = {pressure}, h' the rms slope of each surface; mean "
        f"of {runs[0].realizations} surfaces and its standard error. Areas of elements are "
        "corrected at borders."
    )
    report.raw(
        f"{'L/lambda_l':>12s} {'L/lambda_s':>12s} {'alpha':>8s} {'elements':>18s} "
        f"{'asperities':>18s} {'difference':>12s}"
    )
    for k, r in enumerate(runs):
        e, a = values[k], of["asperities"][2][k]
        report.raw(
            f"{r.number('surface%L_lambda_l'):12g} {r.number('surface%L_lambda_s'):12g} "
            f"{alpha[k]:8.1f} {e[0]:9.3f} +- {e[1]:5.3f} {a[0]:9.3f} +- {a[1]:5.3f} "
            f"{100 * (a[0] / e[0] - 1):+10.1f} %"
        )
    for model in of:
        _, _, points, fall, start = of[model]
        rest = points[:, 0] - start - fall * np.log10(alpha)
        report.note(
            f"{model}: kappa = {start:.3f} {fall:+.3f} log10 alpha, to "
            f"{np.sqrt(np.mean(rest**2)):.3f} rms (standard errors "
            f"{np.sqrt(np.mean(points[:, 1] ** 2)):.3f})."
        )
    report.note(
        "Yastrebov, Anciaux and Molinari (J. Mech. Phys. Solids 107, 2017, arXiv 1704.05650) "
        "found by elements that kappa falls with the logarithm of alpha, and is between "
        "Persson's theory, which is independent of alpha "
        f"({PERSSON:.3f}), and the asymptote of Bush, Gibson and Thomas ({BUSH:.3f})."
    )
    report.finding("Elements say the same." if slope < 0 else "Elements do not fall here.")


def size(folder, report):
    """Stiffness over pressure of surfaces with few or many of their longest waves."""
    figure, axis = plt.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    report.heading("Stiffness over pressure, and the size of the surface (flat_stiffness.png)")
    report.note("K sigma/p, K = -dp/dZ0: mean of K over surfaces; in brackets asperities.")
    found = []
    rows = []
    both = list(zip(members(folder, "size_elements"), members(folder, "size_asperities")))
    for (marker, line, colour), (elements, asperities) in zip(STYLES, both):
        sigma = elements.number("surface%sigma")
        relative = elements.mean("pressure") / (
            float(elements["e_star"]) * np.sqrt(2 * float(elements["m2_theory"]))
        )
        K = lambda r: -r["stiffness"].mean(axis=0) / r["force"].mean(axis=0) * sigma
        error = (
            elements["stiffness"].std(axis=0, ddof=1)
            / np.sqrt(elements.realizations)
            / elements["force"].mean(axis=0)
            * sigma
        )
        waves = elements.number("surface%L_lambda_l")
        axis.errorbar(
            relative,
            K(elements),
            yerr=error,
            fmt=marker,
            ls=line,
            ms=4,
            mfc="none",
            color=colour,
            lw=1,
            elinewidth=0.7,
            label=rf"$L/\lambda_l$ = {waves:g}, elements",
        )
        axis.plot(
            relative,
            K(asperities),
            marker,
            ms=2,
            color=colour,
            label="asperities (filled)" if not rows else None,
        )
        ln_p, ln_K = np.log(relative), np.log(K(elements) * relative)
        found.append(
            (
                waves,
                (ln_K[2] - ln_K[0]) / (ln_p[2] - ln_p[0]),
                np.interp(np.log(0.005), ln_p, K(elements)),
                relative[2],
            )
        )
        rows.append((waves, K(elements), K(asperities)))
        H = elements.number("surface%hurst")
    # Line at the smallest surface and lightest pressure: the exponent of a single contact.
    axis.plot(
        relative[:5],
        rows[0][1][0] * (relative[:5] / relative[0]) ** (1 / (1 + H) - 1),
        ":",
        color="0.4",
        lw=1,
        label=r"$K \sim p^{1/(1+H)}$",
    )
    axis.axhline(2, color="0.5", lw=0.8)
    axis.minorticks_off()
    axis.set(
        xscale="log",
        yscale="log",
        ylim=(1.5, 10),
        yticks=[2, 3, 4, 6, 8],
        yticklabels=["2", "3", "4", "6", "8"],
        xlabel=r"pressure $p/(E^*h')$",
        ylabel=r"stiffness over pressure $K\sigma/p$",
        title=f"{elements.realizations} surfaces a point",
    )
    axis.legend()
    save(figure, folder, "flat_stiffness")

    report.raw(
        f"{'p/(E* h)':>10s} "
        + " ".join(f"{'L/lambda_l = ' + format(w, 'g'):>20s}" for w, _, _ in rows)
    )
    for k, p in enumerate(relative):
        report.raw(
            f"{p:10.2g} " + " ".join(f"{e[k]:11.3f} ({a[k]:.3f})".rjust(20) for _, e, a in rows)
        )
    for waves, exponent, value, upto in found:
        report.note(
            f"L/lambda_l = {waves:g}: K sigma/p = {value:.2f} at p/(E* h') = 0.005; K ~ "
            f"p^{exponent:.2f} up to {upto:.1e} (a single self-affine contact: 1/(1 + H) = "
            f"{1 / (1 + H):.3f}; many: 1)."
        )
    report.note(
        "Akarapu, Sharp and Robbins (Phys. Rev. Lett. 106, 2011): stiffness proportional to "
        "load, K sigma/p near 2. Pastewka, Prodanov, Lorenz, Mueser, Robbins and Persson "
        "(Phys. Rev. E 87, 2013, arXiv 1210.4635): at small "
        "pressures a finite surface is one contact around its highest summit, and K grows "
        "with a power below 1; this range moves to lower pressures for larger surfaces."
    )
    order = [K_of[0] for _, K_of, _ in rows]
    report.finding(
        "At the lightest pressure the smaller surface is stiffer, in agreement."
        if all(np.diff(order) < 0)
        else "At the lightest pressure the order of sizes is not clear."
    )


def main():
    parser = argparse.ArgumentParser(
        description="Pictures and report of rough flats under a pressure."
    )
    parser.add_argument(
        "folder",
        nargs="?",
        default="output/flat",
        help="folder with the result files (default output/flat)",
    )
    folder = parser.parse_args().folder
    report = Report()
    try:
        runs = members(folder, "alpha_elements")
        if not runs:
            sys.exit(f"flat.py: no results in {folder!r}; they are made by input/flat/run.sh")
        report.lines += ["Rough flats under a pressure", "============================"]
        report.note(
            "Two periodic flats, H = 0.8; elements on every point of the surface with 8 "
            "points in the shortest wavelength, asperities by law 'fourth_order'."
        )
        report.full = runs[0].realizations >= 20
        if not report.full:
            report.note(
                "This is the SHORTENED version: few small surfaces. It shows that the command "
                "works; its numbers are not verified."
            )
        nayak(folder, report)
        size(folder, report)
        with open(os.path.join(folder, "times.txt"), encoding="utf-8") as times:
            rows = [line.split() for line in times]
        report.heading("Time")
        report.note(
            f"{sum(int(row[1]) for row in rows)} s in all with {os.cpu_count()} processors: "
            + ", ".join(f"{row[0]} {row[1]} s" for row in rows)
            + "."
        )
        path = os.path.join(folder, "report.txt")
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(report.lines) + "\n")
    except (OSError, IndexError) as error:
        sys.exit(f"flat.py: {error}; the result files are written by input/flat/run.sh")
    print(path)


if __name__ == "__main__":
    main()
