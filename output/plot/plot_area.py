"""True contact area against force, beside theories, and the force at which yielding begins."""

import numpy as np

from plot_curves import begin, curve, smooth_areas, title
from plot_style import GREY, amount, label, short


def area(results, options):
    """A(N), beside the smooth sphere (Hertz) if it is the same for all results. A single result is
    drawn with the smooth sphere or cylinder and the two regimes of the paper with their crossing,
    two flats with the theories of Persson, of Bush, Gibson and Thomas, of Greenwood and
    Williamson."""
    results = [
        r
        for r in results
        if "contact_area" in r
        and (np.nan_to_num(r.mean("contact_area")) > 0).any()
        and r.load_varies()
    ]
    if not results:
        return None
    page, looks = begin(results, options)
    axis, alone = page.axes[0], len(results) == 1
    pulls = any(
        r.pulls() for r in results
    )  # forces of either sign, to which the theories do not apply
    axis.set(xscale="linear" if pulls else "log", yscale="linear" if pulls else "log")
    if not alone and not pulls and (smooth := smooth_areas(results)):
        axis.plot(*smooth, ":", color=GREY, lw=1.0, label=results[0].smooth())
    for result, look in zip(results, looks):
        if alone:
            page.entry("rsc", color=look[1], ls=look[0])
            if not pulls:
                _theories(page, result)
        force, values = result.mean("force"), result.mean("contact_area")
        curve(page, axis, result, look, force, values, "contact_area", "force", alone)
        if "compare_force" in result:
            axis.plot(
                np.ravel(result["compare_force"]),
                np.ravel(result["compare_contact_area"]),
                "D",
                color=look[1],
                mfc="w",
                ms=5,
                zorder=4,
                gid="compare",
            )
            page.entry("the same by elements", color=look[1], ls="none", marker="D", mfc="w")
        if alone:
            _elastic_until(page, axis, result)
    label(axis, "x", "force $N$", results[0].dimension("force"))
    label(axis, "y", "true contact area $A$", results[0].dimension("contact_area"))
    return page.finish(title(results, "True contact area against force"))


def _theories(page, result):
    axis, at = page.axes[0], result.loaded()
    order = at[np.argsort(result.mean("force")[at])]
    force = result.mean("force")[order]
    widths = np.array([result.half_width(level) for level in order])
    if np.isfinite(widths).all():
        area = 2 * widths * force / result.mean("force_per_length")[order]
        axis.plot(force, area, ":", color=GREY, lw=1.0, label="smooth cylinder (Hertz)")
        return
    if not result.has_sphere():
        for name, line, text in (
            ("area_persson", "--", "Persson"),
            ("area_bgt", ":", "Bush, Gibson, Thomas"),
            ("area_gw", "-.", "Greenwood, Williamson"),
        ):
            if name in result and np.isfinite(result.mean(name)[order]).any():
                # Shares of the nominal area.
                nominal = result.mean("contact_area")[order] / result.mean("area_fraction")[order]
                axis.plot(
                    force, nominal * result.mean(name)[order], line, color=GREY, lw=1.0, label=text
                )
        return
    top = order[-1]
    ends = np.array([force.min(), force.max()])
    crossing = float(result["transition_force"]) if "transition_force" in result else np.nan
    near = (
        np.isfinite(crossing)
        and ends[0] / 30 < crossing < ends[1] * 30
        and not result.by_elements()
    )
    if near:
        ends = np.array([min(ends[0], crossing / 2), max(ends[1], crossing * 2)])
    laws = [
        ("area_hertz", {"cone": 1, "punch": 0}.get(result.shape(), 2 / 3), ":", result.smooth())
    ]
    if not result.by_elements():  # the regimes hold for asperities far from merging
        laws += [
            ("area_I", 2 / 3, "--", r"$A_I\propto N^{2/3}$, one asperity"),
            ("area_II", 1, "-.", r"$A_{II}\propto N$, many"),
        ]
    for name, exponent, line, text in laws:
        value = result[name][top] if name in result else np.nan
        if np.isfinite(value) and value > 0:
            axis.plot(
                ends,
                value * (ends / result.mean("force")[top]) ** exponent,
                line,
                color=GREY,
                lw=1.0,
                label=text,
            )
    if near and "area_II" in result and np.isfinite(result["area_II"][top]):
        axis.plot(
            crossing,
            result["area_II"][top] * crossing / result.mean("force")[top],
            "k*",
            ms=8,
            mfc="w",
            ls="none",
            label=f"crossing, $N^*$ = {amount(crossing, result.dimension('force'))}",
        )


def _shade(axis, result, at, begins):
    """Yellow from the onset of yielding on, the darker the larger the share of the contact area
    that yields."""
    looks = dict(color="#f2b400", lw=0, gid="yields", zorder=0)
    if "yielding_share" not in result:
        axis.axvspan(begins, axis.get_xlim()[1], alpha=0.15, **looks)
        return
    force = result.mean("force")[at]
    at = at[np.argsort(force)]
    force, share = np.sort(force), result.mean("yielding_share")[at]
    share = np.maximum.accumulate(np.nan_to_num(share))
    ends = np.append(np.sqrt(force[1:] * force[:-1]), axis.get_xlim()[1])
    for low, high, part in zip(np.append(begins, ends[:-1]), ends, share):
        if high > begins and part > 0:
            axis.axvspan(max(low, begins), high, alpha=0.06 + 0.44 * part, **looks)


def _elastic_until(page, axis, result):
    """Onset of yielding: between the highest force without and the lowest force with a yielding
    contact."""
    if "plastic_contacts" not in result:
        return
    at, force, yields = result.loaded(), result.mean("force"), result.worst("plastic_contacts") > 0
    dimension, hardness = result.dimension("force"), result.case.get("solids%hardness", "")
    if not yields[at].any():
        page.entry(
            f"elastic up to {amount(force[at].max(), dimension)}: pressures below the "
            f"hardness {hardness}",
            ls="none",
        )
        return
    # In the order of the levels: a spot that yielded counts at lower forces after it too.
    first = at[np.argmax(yields[at])]
    begins, below = force[first], force[at[(at < first) & (force[at] < force[first])]]
    _shade(axis, result, at, begins)
    text = f"contacts yield from {amount(begins, dimension)} on"
    if yields[at].all():
        text = "contacts yield at all levels"
    elif below.size:
        text += f" (none at {amount(below.max(), dimension)})"
    if "yielding_share" in result:
        most = short(100 * np.nanmax(result.mean("yielding_share")[at]), 2)
        text += f", up to {most} % of the contact area"
    page.entry(
        text,
        color="#f2b400",
        alpha=0.3,
        lw=6,
    )
