"""Figures of the contact as a whole: area against force, maps, radial pressure."""

import numpy as np
from scipy.optimize import curve_fit

from paper_common import STYLES, Result, jackknife, judge, mean_and_error, members, plt, save, text

ROOT = np.sqrt(2 * np.pi)


# --- contact area against force


class AreaMember:
    """One member of the area studies, with beta fitted in the second regime and the radius of
    single contacts in the first."""

    def __init__(self, result):
        self.result = result
        self.sigma, self.waves = result.number("surface%sigma"), result.number("surface%L_lambda_s")
        self.low, self.R = result.number("surface%L_lambda_l"), result.number("solids%R")
        self.E, self.m2, self.m4 = (
            float(result["e_star"]),
            float(result["m2_theory"]),
            float(result["m4_theory"]),
        )
        self.slope = np.sqrt(2 * self.m2)
        self.force, self.area, self.contacts = (
            result["force"],
            result["contact_area"],
            result["contacts"],
        )
        self.N, self.A = result["force_mean"], result["contact_area_mean"]
        count = result.realizations
        self.unit = self.m2**1.5 * self.E / self.m4  # of the transition force
        # The second regime: forces above ten times the crossing with the fitted beta.
        beta = 1.0
        for _ in range(20):
            self.range = self.N > 10 * 1.7013 / beta**3 * self.unit
            if not self.range.any():
                self.range = self.N >= 0.5 * self.N.max()
            beta = self.fit(np.ones(count, bool))
        self.beta, self.beta_error = jackknife(count, self.fit)
        # The first regime: levels of realizations with one contact, A = pi (3 r N/(4 E*))^(2/3).
        lone = self.contacts == 1
        self.lone = int(lone.sum())
        weight = np.where(lone, self.force, 1) ** (2 / 3)
        factors = [np.mean((self.area / weight)[k][lone[k]]) for k in range(count) if lone[k].any()]
        self.factor, self.factor_error = (
            mean_and_error(factors) if len(factors) > 2 else (np.nan, np.nan)
        )

    def fit(self, keep):
        N, A = self.force[keep].mean(axis=0), self.area[keep].mean(axis=0)
        return np.exp(np.mean(np.log(A[self.range] / N[self.range]))) * self.slope * self.E / ROOT

    def name(self):
        return rf"$\sigma$ = {self.sigma:g} mm, $L/\lambda_s$ = {self.waves:.0f}"

    def crossing_formula(self):
        """Crossing of A_I with r_g = 0.737/sqrt(m4) and A_II with the fitted beta, over m2^(3/2)
        E*/m4; and its error."""
        value = 9 / 16 * 0.737**2 * np.pi**1.5 / self.beta**3
        return value, 3 * value * self.beta_error / self.beta

    def crossing_data(self):
        """Crossing of the area of single contacts and A_II with the fitted beta, over m2^(3/2)
        E*/m4."""
        value = (self.factor * self.slope * self.E / (self.beta * ROOT)) ** 3 / self.unit
        return value, 3 * value * np.hypot(
            self.beta_error / self.beta, self.factor_error / self.factor
        )


def area(folder, report):
    base = [AreaMember(r) for r in members(folder, "area")]
    added = [AreaMember(r) for name in ("area_R5", "area_l48") for r in members(folder, name)]
    picture_area(folder, base)
    picture_slope(folder, base + added)

    everything = base + added
    report.heading("Contact area against force (paper_area.png, paper_area_slope.png)")
    report.columns()
    betas = np.array([m.beta for m in base])
    report.row(
        "beta, mean of the six members",
        0.2,
        betas.mean(),
        betas.std(ddof=1) / np.sqrt(6),
        "A = beta sqrt(2 pi) N/(sqrt(2 m2) E*), fitted to the ratio of the means at the "
        "levels with "
        "N > 10 N* of the fitted beta. The error is the scatter of the members; the single "
        "members:",
    )
    report.raw(
        f"    {'sigma':>6s} {'L/ls':>5s} {'L/ll':>5s} {'R':>4s} {'beta':>8s} {'+-':>7s}  "
        f"{'sqrt(2m2) E* A/N from .. to':28s} {'N*/unit: formula r_g':>22s} "
        f"{'single contacts':>16s} {'N* [N]':>9s} {'paper [N]':>10s}"
    )
    for m in everything:
        kappa = (m.A * m.slope * m.E / np.where(m.N > 0, m.N, np.nan))[m.range]
        formula, data = m.crossing_formula(), m.crossing_data()
        report.raw(
            f"    {m.sigma:6g} {m.waves:5.0f} {m.low:5.0f} {m.R:4.1f} {m.beta:8.4f} "
            f"{m.beta_error:7.4f}  {kappa[0]:8.3f} .. {kappa[-1]:6.3f}{'':12s} "
            f"{formula[0]:13.2f} +- {formula[1]:5.2f} "
            + (
                f"{data[0]:8.2f} +- {data[1]:4.2f} {data[0] * m.unit:9.3g}"
                if np.isfinite(data[0])
                else f"{'-':>8s}    {'-':>4s} {'-':>9s}"
            )
            + f" {212.66 * m.unit:10.4g}"
        )
    report.finding(
        "beta is not 0.2 in any of them. sqrt(2 m2) E* A/N = beta sqrt(2 pi) near 2.1 is "
        "close to that of the same surfaces by elements (last section), and the "
        "asymptotic Bush-Gibson-Thomas theory has beta = 1, Persson's beta = 2/pi = 0.64; 0.2 "
        "is far below all of them."
    )
    c = [m.crossing_formula()[0] for m in base]
    d = [m.crossing_data()[0] for m in base if np.isfinite(m.crossing_data()[0])]
    report.row(
        "N*/(m2^(3/2) E*/m4), A_I by r_g = 0.737/sqrt(m4)",
        212.66,
        np.mean(c),
        np.std(c, ddof=1) / np.sqrt(len(c)),
        "212.66 = 1.7013/beta^3 with beta = 0.2: the formula is correct and contains "
        "1/beta^3. With the beta of the data the transition lies "
        f"{212.66 / np.mean(c):.0f} times lower.",
    )
    if d:
        report.row(
            "N*, A_I by the single contacts of the data",
            212.66,
            np.mean(d),
            np.std(d, ddof=1) / np.sqrt(len(d)),
            "Single contacts are the highest summits, sharper than the mean one: their "
            "radius, not r_g, determines the first regime, and the mean over realizations of "
            "A(N) follows it only briefly, "
            "because the probability of further contacts increases with the load.",
        )
    normalisations(base, report)
    surfaces_tried(folder, report)


def surfaces_tried(folder, report):
    """beta with plateau, finer grid, other mean curvature, larger sphere."""
    report.note("Surfaces tried, beta at Z0/sigma = 2 and 1.43 (A/N of the means):")
    for t in members(folder, "trials") + members(folder, "trials_R5"):
        if t.case["surface%normalise"] != "'sample'":
            continue
        steps = [t.level(2.0), t.level(10 / 7)]
        scale = np.sqrt(2 * float(t["m2_theory"])) * float(t["e_star"]) / ROOT
        beta, error = jackknife(
            t.realizations,
            lambda keep: np.array(
                [
                    scale * t["contact_area"][keep, s].mean() / t["force"][keep, s].mean()
                    for s in steps
                ]
            ),
        )
        report.raw(
            f"    plateau {t.case['surface%plateau']:8s} n = {t.number('surface%n'):5.0f} "
            f"curvature {t.case['asperities%curvature']:12s} R = {t.number('solids%R'):3g} "
            f"{beta[0]:8.4f} +- {error[0]:.4f} {beta[1]:8.4f} +- {error[1]:.4f}"
        )


def normalisations(base, report):
    """beta of these data with other normalisations: one that explains 0.2 must give it for all
    members."""
    E_young = 78.0e3
    tries = [
        ("as stated", lambda m: 1.0),
        ("m2 summed over the modes drawn", lambda m: np.sqrt(m.result["m2"].mean() / m.m2)),
        (
            "m2 of finite differences",
            lambda m: np.sqrt(m.result["m2_grid"].mean() / m.m2)
            if "m2_grid" in m.result
            else np.nan,
        ),
        ("sqrt(m2) for the gradient", lambda m: np.sqrt(0.5)),
        ("2 m2 for the gradient (without the root)", lambda m: m.slope),
        ("no gradient at all", lambda m: 1 / m.slope),
        ("gradient with K in cycles, K/(2 pi)", lambda m: 1 / (2 * np.pi)),
        ("2 pi for sqrt(2 pi)", lambda m: 1 / ROOT),
        ("A without pi: sum of a^2", lambda m: 1 / np.pi),
        ("E for E*", lambda m: E_young / m.E),
        ("sigma/lambda_s for the gradient", lambda m: m.sigma * m.waves / m.slope),
        ("sigma/lambda_l for the gradient", lambda m: m.sigma * m.low / m.slope),
        ("half the area, or 2 E*", lambda m: 0.5),
        ("a quarter of the area, pi (a/2)^2", lambda m: 0.25),
    ]
    report.note(
        "Normalisations tried, beta of the six members (smallest .. largest). A normalisation "
        "that explains the paper's value would give 0.2 for all six:"
    )
    fits = []
    for name, factor in tries:
        values = np.array([m.beta * factor(m) for m in base])
        if not np.isfinite(values).all():
            continue
        good = values.min() > 0.17 and values.max() < 0.23
        if good:
            fits.append(name)
        report.raw(
            f"    {name:40s} {values.min():8.4f} .. "
            f"{values.max():8.4f}{'   near 0.2 for all' if good else ''}"
        )
    report.raw(f"    {'A and N over the same nominal area':40s}  does not change beta")
    if "no gradient at all" not in fits:
        report.finding(
            "Without the gradient the members with sigma = 0.01 mm, the paper's surface, are "
            "near 0.2, but those with ten times less or more are not: a coincidence of the "
            "unit."
        )
    if any(f.startswith("a quarter") for f in fits):
        report.note(
            "Only a quarter of the area is close, as if the radius of a contact were taken as "
            "its diameter, pi a^2/4. But then single contacts would be four times below A_I, "
            "and nothing in the "
            "paper supports it. No other normalisation with a justification was found."
        )
    elif not fits:
        report.note("None was found.")


def picture_area(folder, base):
    figure, axes = plt.subplots(
        1, 2, figsize=(11.2, 4.8), constrained_layout=True, sharex=True, sharey=True
    )
    for axis, waves in zip(axes, sorted({m.waves for m in base})):
        for m, (marker, line, colour) in zip([m for m in base if m.waves == waves], STYLES):
            shown = m.contacts.sum(axis=0) >= 5  # a mean over fewer contacts is not significant
            few = np.flatnonzero(shown)[::3]  # every third level: bars would hide each other
            N, A, dN, dA = (
                m.N[few],
                m.A[few],
                m.result["force_std"][few],
                m.result["contact_area_std"][few],
            )
            axis.errorbar(
                N,
                A,
                yerr=[np.minimum(dA, 0.9 * A), dA],
                xerr=[np.minimum(dN, 0.9 * N), dN],
                fmt=marker,
                ms=3,
                mfc="none",
                color=colour,
                elinewidth=0.5,
            )
            ends = np.array([N.min(), N.max()])
            r = 0.737 / np.sqrt(m.m4)
            axis.plot(
                ends, np.pi * (3 * r * ends / (4 * m.E)) ** (2 / 3), ":", color=colour, lw=1.4
            )
            axis.plot(ends, m.beta * ROOT * ends / (m.slope * m.E), "-", color=colour, lw=1)
            axis.plot(
                [],
                [],
                marker + "-",
                ms=3,
                mfc="none",
                color=colour,
                lw=1,
                label=rf"$\sigma$ = {m.sigma:g} mm; $A_{{II}}$, fitted $\beta$ = {m.beta:.3f}",
            )
            axis.plot(ends, 0.2 * ROOT * ends / (m.slope * m.E), "--", color=colour, lw=0.8)
        axis.set(
            xscale="log",
            yscale="log",
            xlabel="force $N$ [N]",
            title=rf"$L/\lambda_s$ = {waves:.0f}",
        )
        axis.plot([], [], "k:", lw=1.4, label="$A_I$")
        axis.plot([], [], "k--", lw=0.8, label=r"$A_{II}$, $\beta$ = 0.2 (paper)")
        axis.legend()
    smallest = min(m.A[m.contacts.sum(axis=0) >= 5].min() for m in base)
    axes[0].set(ylabel="contact area $A$ [mm$^2$]", ylim=(smallest / 5, None))
    figure.suptitle(
        f"Mean and standard deviation of {base[0].result.realizations} realizations, every "
        "third level",
        fontsize=9,
    )
    save(figure, folder, "paper_area")


def picture_slope(folder, everything):
    figure, axes = plt.subplots(1, 2, figsize=(11.2, 4.8), constrained_layout=True)
    groups = sorted({(m.R, m.low, m.waves) for m in everything})
    for (R, low, waves), (marker, _, colour) in zip(groups, STYLES):
        for n, m in enumerate(m for m in everything if (m.R, m.low, m.waves) == (R, low, waves)):
            x = m.N / (m.E * m.slope)
            shown = (m.N > 0) & (m.contacts.mean(axis=0) >= 1)
            label = (
                rf"$R$ = {R:g} mm, $L/\lambda_l$ = {low:.0f}, $L/\lambda_s$ = {waves:.0f}"
                if n == 0
                else None
            )
            axes[0].plot(
                x[shown][::3], m.A[shown][::3], marker, ms=3, mfc="none", color=colour, label=label
            )
            shown &= m.contacts.mean(axis=0) >= 3
            axes[1].plot(
                (m.N[shown] / m.unit)[::3],
                (m.A / np.where(m.N > 0, m.N, 1) * m.E * m.slope / ROOT)[shown][::3],
                marker,
                ms=3,
                mfc="none",
                color=colour,
                label=label,
            )
    x = np.array(axes[0].get_xlim())
    x = np.array([max(x[0], 1e-9), x[1]])
    axes[0].set(
        xscale="log",
        yscale="log",
        xlabel=r"$N/(E^*\sqrt{2m_2})$ [mm$^2$]",
        ylabel="contact area $A$ [mm$^2$]",
        title="force normalised by the rms gradient; every third level with a contact or more",
    )
    x = np.array([1e-9, 1e-2])
    limits = axes[0].get_xlim(), axes[0].get_ylim()
    beta = np.mean([m.beta for m in everything])
    axes[0].plot(
        x, beta * ROOT * x, "k-", lw=0.8, label=rf"$\beta$ = {beta:.3f} (mean of the fits)"
    )
    axes[0].plot(x, 0.2 * ROOT * x, "k--", lw=0.8, label=r"$\beta$ = 0.2 (paper)")
    axes[0].set(xlim=limits[0], ylim=limits[1])
    axes[1].axhline(0.2, color="k", ls="--", lw=0.8)
    axes[1].axvline(212.66, color="0.5", lw=0.8)
    axes[1].annotate(
        "paper: $N^*$ = 212.66", (212.66, 0.5), rotation=90, ha="right", va="center", fontsize=7.5
    )
    axes[1].annotate(
        r"paper: $\beta$ = 0.2",
        (0.97, 0.2),
        xycoords=("axes fraction", "data"),
        ha="right",
        va="bottom",
        fontsize=7.5,
    )
    axes[1].axvline(1.7013 / beta**3, color="0.5", ls=":", lw=1)
    axes[1].annotate(
        "1.7013/$\\beta^3$, fitted",
        (1.7013 / beta**3, 0.5),
        rotation=90,
        ha="right",
        va="center",
        fontsize=7.5,
    )
    axes[1].set(
        xscale="log",
        ylim=(0, None),
        xlabel=r"force $N/(m_2^{3/2}E^*/m_4)$ [1]",
        ylabel=r"$\beta = \sqrt{2m_2}\,E^*A/(\sqrt{2\pi}\,N)$ [1]",
        title="the factor of the second regime; every third level with 3 contacts or more",
    )
    axes[0].legend()
    save(figure, folder, "paper_area_slope")


# --- maps


def bezier_matrix(cells, per_cell):
    """Cubic Bezier interpolation between cell centres, tangents of Catmull and Rom, at per_cell
    points a cell: a matrix."""
    s = (np.arange(cells * per_cell) + 0.5) / per_cell - 0.5
    matrix = np.zeros((s.size, cells))
    tangent = np.zeros((cells, cells))
    for i in range(1, cells - 1):
        tangent[i, i + 1], tangent[i, i - 1] = 0.5, -0.5
    tangent[0, :3], tangent[-1, -3:] = (-1.5, 2, -0.5), (0.5, -2, 1.5)
    unit = np.eye(cells)
    for row, position in enumerate(s):
        i = min(max(int(np.floor(position)), 0), cells - 2)
        t = position - i
        control = (unit[i], unit[i] + tangent[i] / 3, unit[i + 1] - tangent[i + 1] / 3, unit[i + 1])
        matrix[row] = sum(
            c * w
            for c, w in zip(
                control, ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            )
        )
    return matrix


MAP_LEVELS = (4.0, 25 / 7, 22 / 7, 19 / 7, 16 / 7, 13 / 7)


def hertz_radius(result, step):
    return float(np.sqrt(result["area_hertz"][step] / np.pi))


def maps(folder, report):
    runs = [Result(f"{folder}/maps.nc"), Result(f"{folder}/maps_plateau.nc")]
    result = runs[0]
    matrix = bezier_matrix(result["x"].size, 8)
    figure, axes = plt.subplots(
        2, 3, figsize=(11.6, 6.6), constrained_layout=True, sharex=True, sharey=True
    )
    for axis, z in zip(axes.flat, MAP_LEVELS):
        step = result.level(z)
        image = axis.imshow(
            np.maximum(matrix @ result["map_pressure"][step] @ matrix.T, 0),
            extent=[0, 1, 0, 1],
            cmap="cividis",
            vmin=0,
        )
        figure.colorbar(image, ax=axis, label="pressure $p$ [N mm$^{-2}$]", shrink=0.85)
        angle = np.linspace(0, 2 * np.pi, 200)
        for style in ({"color": "k", "lw": 2.2}, {"color": "w", "lw": 1.1, "ls": "--"}):
            axis.plot(
                0.5 + hertz_radius(result, step) * np.cos(angle),
                0.5 + hertz_radius(result, step) * np.sin(angle),
                **style,
            )
        axis.set(
            title=rf"$Z_0/\sigma$ = {z:.2f}, mean force {result['force_mean'][step]:#.3g} N",
            xlim=(0, 1),
            ylim=(0, 1),
        )
    for axis in axes[1]:
        axis.set_xlabel("$x$ [mm]")
    for axis in axes[:, 0]:
        axis.set_ylabel("$y$ [mm]")
    figure.suptitle(
        f"Mean pressure of {result.realizations} realizations, bicubic Bezier smoothing; "
        "dashed: Hertz contact of the smooth sphere under the mean force",
        fontsize=9,
    )
    save(figure, folder, "paper_maps")

    report.heading("Maps (paper_maps.png)")
    report.columns()
    for run, name in zip(runs, ("no plateau", "plateau")):
        mean, error = mean_and_error(run["force"][:, run.level(10 / 7)])
        report.row(
            f"N at Z0/sigma = 1.43 [N], {name}",
            116.6,
            mean,
            error,
            judge(mean, error, 116.6).capitalize() + ".",
        )
    report.note(
        "Mean force at the levels of the maps [N], no plateau / plateau: "
        + ", ".join(
            f"{z:.2f}: {text(mean_and_error(runs[0]['force'][:, runs[0].level(z)])[0])} / "
            f"{text(mean_and_error(runs[1]['force'][:, runs[1].level(z)])[0])}"
            for z in MAP_LEVELS
        )
        + "."
    )
    report.note(
        f"Trials, N at 1.43: the mean of {result.realizations} plus the difference by each "
        "change on the same surfaces."
    )
    for trial in members(folder, "trials"):
        base = runs[".true." in trial.case["surface%plateau"]]
        reference = base["force"][:, base.level(10 / 7)]
        common = min(trial.realizations, reference.size)
        mean, error = mean_and_error(reference)
        change, change_error = mean_and_error(
            trial["force"][:common, trial.level(10 / 7)] - reference[:common]
        )
        report.raw(
            f"    plateau {trial.case['surface%plateau']:8s} n = "
            f"{trial.number('surface%n'):5.0f} curvature "
            f"{trial.case['asperities%curvature']:12s} sigma by "
            f"{trial.case['surface%normalise']:12s} "
            f"{mean + change:8.2f} +- {np.hypot(error, change_error):.2f}"
        )
    report.finding(
        "With the plateau the paper's force is reproduced to one or two per cent, best with "
        "sigma in expectation and n = 4096; without it is far off. So its force indicates a "
        "plateau, while its r_g and its rms slope (below) are "
        "those of a surface without: no single surface gives all three."
    )
    report.row(
        "area fraction beyond which spots would merge [%]", 19.6, 100 * np.pi / 16, 0.0, "pi/16."
    )


def radial(folder, report):
    result = Result(f"{folder}/maps.nc")
    r = result["radius"]
    figure, axes = plt.subplots(1, 3, figsize=(14.4, 4.6), constrained_layout=True)
    report.heading("Radial pressure (paper_radial.png)")
    report.note(
        "The paper states no numbers for these fits. Least squares of the radial means, no "
        "plateau: p = p0 sqrt(1 - r^2/a^2) and p = pg exp(-r^2/(2 s^2)); the Hertz contact of "
        "the smooth "
        "sphere under the same force beside; d is the rms deviation from the data over the "
        "largest pressure."
    )
    report.raw(
        f"    {'Z0/sigma':>8s} {'N [N]':>9s} | {'Hertz a [mm]':>12s} {'p0 [MPa]':>9s} | "
        f"{'fit a':>8s} {'p0':>9s} {'d':>6s} | {'Gauss s [mm]':>12s} {'pg [MPa]':>9s} "
        f"{'d':>6s}"
    )
    for (marker, line, colour), z in zip(STYLES, MAP_LEVELS + (10 / 7, 1.0)):
        step = result.level(z)
        p, N, a0 = (
            result["radial_pressure"][step],
            float(result["force_mean"][step]),
            hertz_radius(result, step),
        )
        if not (p > 0).sum() > 4:
            continue
        gauss = lambda x, top, s: top * np.exp(-(x**2) / (2 * s**2))
        hertz = lambda x, top, a: top * np.sqrt(np.maximum(1 - (x / a) ** 2, 0))
        # The areas of the rings are proportional to r, hence the weights.
        weight = 1 / np.sqrt(r)
        width = np.sqrt(max((p * r**3).sum() / max((p * r).sum(), 1e-300) / 2, 1e-6))
        try:
            (pg, s), _ = curve_fit(gauss, r, p, p0=[p.max(), width], sigma=weight)
            starts = [
                curve_fit(hertz, r, p, p0=[p.max(), f * width], sigma=weight, maxfev=5000)[0]
                for f in (1.5, 2, 2.5, 3)
            ]
        except RuntimeError:
            continue
        p0, a = min(starts, key=lambda q: (((hertz(r, *q) - p) / weight) ** 2).sum())
        middle = p.max()
        deviation = [
            np.sqrt(np.mean((f - p) ** 2)) / middle for f in (hertz(r, p0, a), gauss(r, pg, s))
        ]
        report.raw(
            f"    {z:8.2f} {N:9.4g} | {a0:12.4f} {1.5 * N / (np.pi * a0**2):9.4g} | {a:8.4f} "
            f"{p0:9.4g} {deviation[0]:6.3f} | {abs(s):12.4f} {pg:9.4g} {deviation[1]:6.3f}"
        )
        fine = np.linspace(0, r[-1], 400)
        shown = p > 0
        for axis in axes[:2]:
            axis.plot(
                r[shown],
                p[shown],
                marker,
                ms=3,
                mfc="none",
                color=colour,
                label=rf"$Z_0/\sigma$ = {z:.2f}",
            )
            axis.plot(fine, gauss(fine, pg, s), "-", color=colour, lw=1)
            within = np.linspace(0, abs(a), 400)
            axis.plot(within, hertz(within, p0, a), "--", color=colour, lw=0.9)
        axes[2].plot(
            r / a0, p / (1.5 * N / (np.pi * a0**2)), marker, ms=3, mfc="none", color=colour
        )
    for axis in axes[:2]:
        axis.set(
            xlabel="distance from the tip $r$ [mm]",
            ylabel="pressure $p$ [N mm$^{-2}$]",
            xlim=(0, 0.5),
        )
    x = np.linspace(0, 1, 300)
    axes[2].plot(x, np.sqrt(1 - x**2), "k-", lw=1, label="Hertz, smooth sphere")
    axes[2].set(
        xlabel=r"$r/a$ [1], $a$ of the smooth sphere",
        ylabel=r"$p/p_0$ [1], $p_0$ of the smooth sphere",
        xlim=(0, 4),
        ylim=(0, 1.05),
        title="beside the smooth sphere under the same force",
    )
    axes[2].legend()
    axes[0].set_ylim(0, None)
    top = result["radial_pressure"].max()
    axes[1].set(yscale="log", ylim=(top * 1e-6, top * 5))
    axes[0].legend(title="solid: Gaussian fit, dashed: Hertz fit")
    figure.suptitle(f"Radial mean of the pressure, {result.realizations} realizations", fontsize=9)
    save(figure, folder, "paper_radial")
