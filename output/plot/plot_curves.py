"""Curves over the levels: force and number of contacts against separation, area against force, and, where a file holds them, nominal pressure, friction, the model beside
elements. Several results are drawn together."""

import numpy as np

from plot_results import names
from plot_style import few, legend, mark_levels, panels, style


def _meanings(results):
    return max((r.level_status()[1] for r in results), key=len)


def _spread(result, name):
    """The 16th and 84th percentile of a variable over realizations, over steps; None for one realization."""
    if result.realizations < 3:
        return None
    return np.percentile(result[name], [16, 84], axis=0)


def _band(axis, x, spread, colour, logarithmic=True):
    if spread is not None:
        low, high = spread
        if logarithmic:
            low = np.where(low > 0, low, np.nan)
        axis.fill_between(x, low, high, color=colour, alpha=0.2, lw=0)


def _title(figure, results, what, band=True):
    many = [r.realizations for r in results if r.realizations > 1]
    note = "; band: two thirds of the realizations" if band and len(results) < 4 and any(m > 2 for m in many) else ""
    figure.suptitle(results[0].heading(what + note) if len(results) == 1 else what + (f" (means over {'/'.join(map(str, sorted(set(many))))} realizations{note})" if many else ""), fontsize=8)


def load(results, options):
    """Force against separation, and how many asperities carry it."""
    results = [r for r in results if "force_mean" in r and "contacts" in r]
    if not any(r.loaded().size for r in results):
        return None
    figure, axes = panels(2, options.width, entries=few(len(results)))
    met, labels = set(), names(results)
    for k, result in enumerate(results):
        marker, line, colour = style(k, len(results))
        at = result.loaded()
        z, status = result.depth()[0][at], result.level_status()[0][at]
        for axis, name in zip(axes, ("force", "contacts")):
            values = result.mean(name)[at]
            axis.plot(z, values, line, color=colour, label=labels[k] if len(results) > 1 else None)
            spread = _spread(result, name) if len(results) < 4 else None
            _band(axis, z, spread if spread is None else spread[:, at], colour)
            met |= mark_levels(axis, z, values, status, colour)
    for axis, label in zip(axes, ("force $N$" + results[0].unit("force"), "number of contacts")):
        axis.set(xlabel=results[0].depth()[1], ylabel=label, yscale="log")
        axis.invert_xaxis()  # the sphere comes down from left to right
    legend(axes[0], met, _meanings(results), below=axes[2] if len(axes) > 2 else None)
    _title(figure, results, "Force and contacts against separation")
    return figure


def _area_at_force(result, force):
    """16th and 84th percentile over realizations of A at given forces, each realization's curve interpolated between its levels; NaN where some realization has no such
    force."""
    curves = []
    for n, a in zip(result["force"], result["contact_area"]):
        good = (n > 0) & (a > 0)
        order = np.argsort(n[good])
        if good.sum() < 2:
            return None
        curves.append(np.interp(np.log(force), np.log(n[good][order]), np.log(a[good][order]), left=np.nan, right=np.nan))
    return np.percentile(np.exp(curves), [16, 84], axis=0)


def area(results, options):
    """A(N); of one result with both regimes of the paper, their crossing and the smooth sphere."""
    results = [r for r in results if "contact_area_mean" in r and ((r["force_mean"] > 0) & (r["contact_area_mean"] > 0)).any()]
    if not results:
        return None
    narrow = options.width < 110 and len(results) == 1  # the legend of regimes and marks would cover the curve
    figure, axes = panels(1, min(options.width, 130.0), least=30.0, entries=8 if narrow else few(len(results)))
    axis, met, labels = axes[0], set(), names(results)
    for k, result in enumerate(results):
        marker, line, colour = style(k, len(results))
        loaded = (result["force_mean"] > 0) & (result["contact_area_mean"] > 0)
        order = np.argsort(result["force_mean"][loaded])
        force, values = result["force_mean"][loaded][order], result["contact_area_mean"][loaded][order]
        single = len(results) == 1
        axis.plot(force, values, line, color=colour, label="rsc" if single else labels[k], zorder=2.5)
        if result.realizations > 2 and len(results) < 4:
            _band(axis, force, _area_at_force(result, force), colour)
        met |= mark_levels(axis, force, values, result.level_status()[0][loaded][order], colour)
        if single:
            _regimes(axis, result, force)
        if "compare_force" in result:
            axis.plot(np.ravel(result["compare_force"]), np.ravel(result["compare_contact_area"]), "D", color=colour, mfc="w", ms=5, label="elements" if single else None)
    axis.set(xscale="log", yscale="log", xlabel="force $N$" + results[0].unit("force"), ylabel="contact area $A$" + results[0].unit("contact_area"))
    legend(axis, met, _meanings(results), below=axes[1] if len(axes) > 1 else None)
    _title(figure, results, "Contact area against force")
    return figure


def _regimes(axis, result, force):
    """The laws of the paper's section 5 as the straight lines they are, and Hertz where there is a sphere."""
    ends = np.array([force.min(), force.max()])
    crossing = float(result["transition_force"]) if "transition_force" in result else np.nan
    if np.isfinite(crossing) and ends[0] / 30 < crossing < ends[1] * 30:
        ends = np.array([min(ends[0], crossing / 2), max(ends[1], crossing * 2)])
    else:
        crossing = np.nan
    last = int(np.argmax(result["force_mean"]))
    laws = [("area_I", 2 / 3, "--", r"$A_I\propto N^{2/3}$, one asperity"), ("area_II", 1, "-.", r"$A_{II}\propto N$, $\beta=0.2$"),
            ("area_hertz", 2 / 3, ":", "smooth sphere (Hertz)")]
    for name, exponent, line, label in laws:
        value = result[name][last] if name in result else np.nan
        if np.isfinite(value) and value > 0:
            axis.plot(ends, value * (ends / result["force_mean"][last]) ** exponent, line, color="0.35", lw=1.0, label=label)
    if np.isfinite(crossing) and "area_II" in result and np.isfinite(result["area_II"][last]):
        unit = result.unit("force").strip(" []")
        axis.plot(crossing, result["area_II"][last] * crossing / result["force_mean"][last], "k*", ms=8, mfc="w", label=rf"crossing, $N^*$ = {crossing:.3g} {unit}")


def flats(results, options):
    """Two flats: kappa = A E* h'/N and the mean separation against the nominal pressure, with the theories the file holds."""
    results = [r for r in results if "pressure" in r and "area_fraction" in r and (r.mean("pressure") > 0).any()]
    if not results:
        return None
    figure, axes = panels(2, options.width, entries=few(len(results)))
    met, labels = set(), names(results)
    for k, result in enumerate(results):
        marker, line, colour = style(k, len(results))
        pressure = result.mean("pressure")
        at = np.flatnonzero(pressure > 0)
        relative = pressure[at] / (float(result["e_star"]) * float(np.mean(result["rms_slope"])))
        status = result.level_status()[0][at]
        single = len(results) == 1
        for name, law, label in (("area_fraction", line, "rsc" if single else labels[k]), ("area_persson", "--", "Persson"), ("area_bgt", ":", "Bush, Gibson, Thomas")):
            if name not in result or (name != "area_fraction" and not single):
                continue
            kappa = result.mean(name)[at] / relative
            axes[0].plot(relative, kappa, law, color=colour if name == "area_fraction" else "0.35", label=label)
            if name == "area_fraction":
                met |= mark_levels(axes[0], relative, kappa, status, colour)
        z = result.depth()[0][at]
        axes[1].plot(relative, z, line, color=colour)
        mark_levels(axes[1], relative, z, status, colour)
    axes[0].set(xscale="log", xlabel=r"pressure $p/(E^*h')$", ylabel=r"$\kappa = A\,E^*h'/N$", ylim=(0, None))
    axes[1].set(xscale="log", xlabel=r"pressure $p/(E^*h')$", ylabel=results[0].depth()[1])
    legend(axes[0], met, _meanings(results), below=axes[2] if len(axes) > 2 else None)
    _title(figure, results, "Nominally flat surfaces: area and separation against pressure", band=False)
    return figure


def chosen_levels(result, count, step):
    """The level asked for, or `count` levels with contact, evenly spread and ending with the last; none where nothing touches."""
    loaded = result.loaded()
    if step is not None:
        return [step - 1] if step - 1 in loaded else []
    if loaded.size == 0:
        return []
    return sorted({int(s) for s in loaded[np.linspace(0, loaded.size - 1, count + 1).round().astype(int)[1:]]})
