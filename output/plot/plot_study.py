"""Results of the members of a study at one level or load against the keys that vary."""

from collections import namedtuple

import numpy as np

from plot_adhesion import jkr
from plot_curves import bars, error_band, title
from plot_results import _in_order, axis_label, differing_keys, key_label, with_unit
from plot_style import FEW, GREY, Page, STYLES, amount, colour_bar, label, short

QUANTITIES = {
    "force": "force $N$",
    "pressure": "nominal pressure",
    "separation_sigma": r"separation $Z_0/\sigma$",
    "separation": "separation $Z_0$",
    "contact_area": "true contact area $A$",
    "contacts": "number of contacts",
    "pull_off_force": "pull-off force",
    "energy_lost": "work lost",
}
# A quantity of every result: its name, values, standard errors, and expected errors of the model.
Panel = namedtuple("Panel", "name values errors expected dimension")


def common_level(results, step):
    """The level common to all results, as indices, and its name: the requested one, or the last
    with the same separation, force or pressure in all of them. None if there is no such level."""
    named = [{r.level_name(k): k for k in r.loaded()} for r in results]
    if step is not None:
        at = [step - 1] * len(results)
        found = {r.level_name(step - 1) for r in results}
        return at, found.pop() if len(found) == 1 else f"level {step} of each"
    for name in reversed(list(named[0])):
        if all(name in levels for levels in named):
            return [levels[name] for levels in named], name
    relative = {r.case.get("indentation%unit", "").strip("'") for r in results}
    if (
        all(r.control() == "pressure" for r in results)
        and relative == {"relative"}
        and len({r.steps for r in results}) == 1
    ):
        ends = {r.case.get("indentation%stop") for r in results}
        named = len(ends) == 1 and None not in ends
        return [r.steps - 1 for r in results], (
            f"$p/(E^*h')$ = {ends.pop()}" if named else "the last level"
        )
    return [r.steps - 1 for r in results], "the last level of each"


def _over_levels(result, name):
    """Mean and standard error over the realizations, and expected error, at every level."""
    values, mean = result[name], result.mean(name)
    if values.ndim < 2 and name != "pull_off_force":
        return mean, np.zeros(result.steps), np.zeros(result.steps)
    expected = result.error(name) * abs(mean) if name in ("force", "contact_area") else 0 * mean
    return mean, result.standard_error(values), expected


def _at_level(results, levels, name):
    found = np.array([[v[k] for v in _over_levels(r, name)] for r, k in zip(results, levels)])
    return Panel(name, *found.T, results[0].dimension(name))


def _at_load(results, load, name):
    """Between the levels of first loading, linear in the logarithm of the load; logarithms of
    quantities that are positive."""
    found = []
    for result in results:
        of = "pressure" if "pressure" in result else "force"
        at = result.branches()[0][0]
        known = result.mean(of)[at]
        at, known = at[np.argsort(known)], np.sort(known)
        wanted = load * result.factor(of)
        if not known[0] > 0 or not known[0] <= wanted <= known[-1] * (1 + 1e-9):
            found.append([np.nan] * 3)
            continue
        row = []
        for values in _over_levels(result, name):
            log = (values[at] > 0).all()
            y = np.interp(np.log(wanted), np.log(known), np.log(values[at]) if log else values[at])
            y = np.exp(y) if log else y
            row.append(np.round(y) if name == "contacts" and result.realizations == 1 else y)
        found.append(row)
    return Panel(name, *np.array(found, float).T, results[0].dimension(name))


def _keys(results):
    """(the keys that vary, their texts for each result, the key of numbers of curves or None, the
    names of the other keys for each result); None if there is nothing to draw. Curves are over the
    key of numbers with the most values, one for each set of values of the others."""
    keys = differing_keys(results) if len(results) > 2 else []
    texts = [[r.case.get(key, "") for key in keys] for r in results]
    if not keys or len({tuple(t) for t in texts}) < len(texts):
        return None
    values = [{t[i] for t in texts} for i in range(len(keys))]
    of_numbers = [i for i in range(len(keys)) if not any(_in_order(t[i])[0] for t in texts)]
    for along in sorted(of_numbers, key=lambda i: -len(values[i]))[:1]:
        symbols = [key_label(key, results[0])[0] for key in keys]
        others = [
            ", ".join(
                f"{symbols[i]} = {with_unit(keys[i], text, results[0])}"
                for i, text in enumerate(t)
                if i != along
            )
            for t in texts
        ]
        if len(values[along]) > 2 and len(set(others)) <= FEW:
            return keys, texts, along, others
    return (keys, texts, None, None) if len(keys) == 2 and len(results) >= 4 else None


def _more_even(values, than):
    """True if the steps between values differ less than those of others, relative to their
    mean."""
    steps, others = np.diff(values), np.diff(than)
    return np.std(steps) / np.mean(steps) < np.std(others) / np.mean(others) - 1e-9


def _curves(page, axis, panel, results, keys, texts, along, others):
    """A quantity against the key of numbers, a curve for each set of values of the other keys, with
    the expected error as a band and the standard error as bars."""
    numbers = np.array([_in_order(t[along])[1] for t in texts])
    shown = dict.fromkeys(others)
    for (marker, line, colour), other in zip(STYLES, shown):
        at = [k for k in np.argsort(numbers, kind="stable") if others[k] == other]
        x, y = numbers[at], panel.values[at]
        axis.plot(x, y, marker, ls=line, color=colour, ms=3.5, label=other or None)
        if panel.errors[at].any():  # otherwise the bars show it
            error_band(page, axis, x, y, panel.expected[at], None, color=colour, alpha=0.15)
        errors = panel.errors[at] if panel.errors[at].any() else panel.expected[at]
        if (errors > 0).any():
            bars(page, axis, x, y, errors, results[at[0]], colour)
    values = sorted(set(numbers))
    if values[0] > 0 and len(values) > 2 and _more_even(np.log(values), values):
        axis.set_xscale("log")
    label(axis, "x", axis_label(keys[along], results[0]))
    if len(values) <= 5:  # the values themselves
        axis.minorticks_off()
        key = keys[along]
        of = {_in_order(t[along])[1]: with_unit(key, t[along], results[0]) for t in texts}
        axis.set_xticks(values, [of[value] for value in values])
        axis.set_xlabel(key_label(key, results[0])[0])
    label(axis, "y", QUANTITIES[panel.name], panel.dimension)


def _table(page, axis, panel, results, keys, texts):
    """A map of a quantity over two keys."""
    ends = [sorted({t[i] for t in texts}, key=_in_order) for i in (0, 1)]
    table = np.full((2, len(ends[0]), len(ends[1])), np.nan)
    for (first, second), *pair in zip(texts, panel.values, panel.errors):
        table[:, ends[0].index(first), ends[1].index(second)] = pair
    image = axis.imshow(np.ma.masked_invalid(table[0]), cmap="cividis", aspect="auto")
    low, high = np.nanmin(table[0]), np.nanmax(table[0])
    if high - low < 1e-9 * abs(high):
        image.set_clim(0.9 * low, 1.1 * high)
    how = dict(location="bottom", pad=0.02, aspect=22)
    bar = colour_bar(page.figure, image, axis, QUANTITIES[panel.name], panel.dimension, **how)
    for (i, j), value in np.ndenumerate(table[0]):
        if np.isfinite(value) and table[0].size <= 36:
            error = table[1, i, j]
            text = short(value / bar.size) + (f"\n± {short(error / bar.size, 2)}" if error else "")
            dark = value <= (low + high) / 2
            how = dict(ha="center", va="center", fontsize=7, color="w" if dark else "k")
            axis.text(j, i, text, **how)
    for key, shown, place, set_label in (
        (keys[0], ends[0], axis.set_yticks, axis.set_ylabel),
        (keys[1], ends[1], axis.set_xticks, axis.set_xlabel),
    ):
        shown = [with_unit(key, t, results[0]) for t in shown]
        room = len(shown) if key == keys[0] else sum(map(len, shown)) // 2
        every = -(-room // 14)  # as many as there is room for
        place(range(0, len(shown), every), shown[::every])
        set_label(key_label(key, results[0])[0])


def _page(results, options, found, panels):
    keys, texts, along, others = found
    # A quantity that is the same in all results says nothing.
    panels = [p for p in panels if np.ptp(p.values[np.isfinite(p.values)]) > 0] or panels[:1]
    page = Page(options, len(panels), aspect=0.9 if len(panels) > 1 else 0.72)
    for axis, panel in zip(page.axes, panels):
        if along is None:
            _table(page, axis, panel, results, keys, texts)
        else:
            _curves(page, axis, panel, results, keys, texts, along, others)
    return page


def study(results, options):
    """Area, contacts and force (separation under force control or at a chosen load) against the
    keys that vary: curves over the key of numbers with the most values, one for each value of the
    others; maps where these would be more than six, or of two keys without numbers."""
    results = [r for r in results if "force" in r and r.loaded().size]
    found = _keys(results)
    if not found:
        if len(results) == 2:
            options.say("study: two results make no curve; three or more are drawn")
        return None
    in_sigma = all("separation_sigma" in r for r in results) and "surface%sigma" not in found[0]
    separation = "separation_sigma" if in_sigma else "separation"
    if options.at is not None:
        of = "pressure" if "pressure" in results[0] else "force"
        load = options.at * results[0].factor(of)
        name = f"${'p' if of == 'pressure' else 'N'}$ = {amount(load, results[0].dimension(of))}"
        panels = [
            _at_load(results, options.at, q) for q in (separation, "contact_area", "contacts")
        ]
        if not all(np.isfinite(panel.values).any() for panel in panels):
            options.say(f"study: no result has levels around the load {options.at:g}")
            return None
    else:
        levels, name = common_level(results, options.step)
        first = "force" if results[0].control() == "separation" else separation
        panels = [_at_level(results, levels, q) for q in (first, "contact_area", "contacts")]
    return _page(results, options, found, panels).finish(title(results, f"Study at {name}"))


def _mark(page, results, found, values, at):
    """Rings around pull-off forces in doubt, and arrows where the bodies still stick at the last
    level, so that the force may be larger."""
    axis, (_, texts, along, _) = page.axes[0], found
    x = np.array([_in_order(t[along])[1] for t in texts])
    # From the level of the smallest force on: contacts in doubt may come apart too early.
    statuses = [r["status"].reshape(-1, r.steps)[:, k:] for r, k in zip(results, at)]
    doubt = np.array([np.nanmax(status) > 0 for status in statuses])
    stuck = np.array([np.nan_to_num(r.mean("contacts"))[-1] > 0 for r in results])
    for these, marker, text in (
        (doubt, "o", "in doubt (status above 0)"),
        (stuck, "^", "still attached at the last level: at least"),
    ):
        if these.any():
            axis.plot(x[these], values[these], marker, mfc="none", mec="k", ms=9, label=text)


def pulloff(results, options):
    """Pull-off force and work lost against the keys that vary, beside the smooth ball (JKR)."""
    results = [r for r in results if r.pulls() and r.carrying().size]
    found = _keys(results)
    if not found:
        return None
    values = -np.array([float(r.mean("pull_off_force")) for r in results])
    errors = np.array([float(r.standard_error(r["pull_off_force"])) for r in results])
    dimension = results[0].dimension("pull_off_force")
    at = [int(np.nanargmin(r.mean("force"))) for r in results]  # the level of the smallest force
    name = "pull_off_force_error_expected"  # missing where none is stated
    relative = [float(np.nan_to_num(r.mean(name))) if name in r else 0.0 for r in results]
    expected = relative * np.abs(values)
    panels = [Panel("pull_off_force", values, errors, expected, dimension)]
    if all("energy_lost" in r for r in results):
        panels.append(_at_level(results, [r.steps - 1 for r in results], "energy_lost"))
    page = _page(results, options, found, panels)
    if found[2] is not None:
        _mark(page, results, found, values, at)
    smooth = {short(abs(curve[0].min())) for curve in map(jkr, results) if curve is not None}
    if len(smooth) == 1 and found[2] is not None:
        axis, least = page.axes[0], float(smooth.pop())
        text = f"smooth ball (JKR): {amount(least, dimension)}"
        if least < 3 * values.max():
            axis.axhline(least, color=GREY, ls=":", label=text)
        else:  # far above the results, which it would flatten
            page.entry(text, ls="none")
        label(axis, "y", QUANTITIES["pull_off_force"], dimension)
    return page.finish(title(results, "Pull-off"))
