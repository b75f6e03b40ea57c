"""Results of the members of a study at one level against the keys that vary."""

import numpy as np

from plot_curves import error_band, title
from plot_results import _in_order, axis_label, differing_keys, key_label, value_text
from plot_style import FEW, Page, STYLES, colour_bar, label, short

QUANTITIES = {
    "force": "force $N$",
    "pressure": "nominal pressure",
    "separation_sigma": r"separation $Z_0/\sigma$",
    "separation": "separation $Z_0$",
    "contact_area": "true contact area $A$",
    "contacts": "number of contacts",
}


def common_level(results, step):
    """The level common to all results, as indices, and its name: the requested one, or the last with the same
    separation, force or pressure in all of them. None if there is no such level."""
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
        ends = {r.case.get(key) for r in results for key in ("indentation%stop",)}
        return [r.steps - 1 for r in results], f"$p/(E^*h')$ = {ends.pop()}" if len(
            ends
        ) == 1 and None not in ends else "the last level"
    return [r.steps - 1 for r in results], "the last level of each"


def _curves(page, axis, quantity, results, values, levels, numbers, others):
    """A quantity against the key of numbers, a curve for each set of values of the other keys, with the expected error as a band."""
    shown = dict.fromkeys(others)
    for (marker, line, colour), other in zip(STYLES, shown):
        at = [k for k in np.argsort(numbers, kind="stable") if others[k] == other]
        x, y = numbers[at], values[at]
        axis.plot(x, y, marker, ls=line, color=colour, ms=3.5, label=other or None)
        off = np.array([results[k].error(quantity)[levels[k]] for k in at])
        error_band(
            page,
            axis,
            x,
            y,
            off,
            f"expected error{' of ' + other if len(shown) > 1 else ''}",
            color=colour,
            alpha=0.15,
        )


def study(results, options):
    """Area, contacts and force (separation under force control) at one level against the keys that vary: curves over one key of numbers (of
    more than two keys that with the most values), one for each value of the others; maps for two keys of numbers, or of none.
    """
    results = [r for r in results if "force" in r and r.loaded().size]
    keys = differing_keys(results) if len(results) > 2 else []
    texts = [[r.case.get(key, "") for key in keys] for r in results]
    if not keys or len({tuple(t) for t in texts}) < len(texts):
        return None
    of_numbers = [i for i in range(len(keys)) if not any(_in_order(t[i])[0] for t in texts)]
    if len(keys) > 2:  # no map: curves over the key of numbers with the most values
        of_numbers = sorted(of_numbers, key=lambda i: -len({t[i] for t in texts}))[:1]
    curves = len(of_numbers) == 1 and len({t[of_numbers[0]] for t in texts}) > 2
    if curves:
        key, marks = keys[of_numbers[0]], [t[of_numbers[0]] for t in texts]
        x = np.array([_in_order(mark)[1] for mark in marks])
        named = [
            value_text
            if _in_order(text)[0]
            else lambda value, label=key_label(
                name, results[0]
            ): f"{label[0]} = {value_text(value)} {label[1]}".strip()
            for name, text in zip(keys, texts[0])
        ]
        others = [
            ", ".join(named[i](text) for i, text in enumerate(t) if i != of_numbers[0])
            for t in texts
        ]
        curves = len(set(others)) <= FEW
    if not curves and (len(keys) != 2 or len(results) < 4):
        return None
    levels, name = common_level(results, options.step)
    given = {
        "force": [
            "separation_sigma" if all("separation_sigma" in r for r in results) else "separation"
        ],
        "pressure": ["separation_sigma"],
    }.get(results[0].control(), ["force"])
    quantities = given + ["contact_area", "contacts"]
    page = Page(options, 3, aspect=0.9)
    for axis, quantity in zip(page.axes, quantities):
        values = np.array([r.mean(quantity)[level] for r, level in zip(results, levels)])
        dimension = results[0].dimension(quantity)
        if curves:
            _curves(page, axis, quantity, results, values, levels, x, others)
            if x.min() > 0 and x.max() > 8 * x.min() and len(set(x)) > 5:
                axis.set_xscale("log")
            label(axis, "x", axis_label(key, results[0]))
            if len(set(x)) <= 5:  # the values themselves
                axis.minorticks_off()
                axis.set_xticks(
                    sorted(set(x)),
                    [value_text(marks[list(x).index(value)]) for value in sorted(set(x))],
                )
            label(axis, "y", QUANTITIES[quantity], dimension)
            continue
        ends = [sorted({t[i] for t in texts}, key=_in_order) for i in (0, 1)]
        table = np.full((len(ends[0]), len(ends[1])), np.nan)
        for (first, second), value in zip(texts, values):
            table[ends[0].index(first), ends[1].index(second)] = value
        image = axis.imshow(np.ma.masked_invalid(table), cmap="cividis", aspect="auto")
        if np.nanmax(table) - np.nanmin(table) < 1e-9 * abs(np.nanmax(table)):
            image.set_clim(0.9 * np.nanmin(table), 1.1 * np.nanmax(table))
        bar = colour_bar(
            page.figure,
            image,
            axis,
            QUANTITIES[quantity],
            dimension,
            location="bottom",
            pad=0.02,
            aspect=22,
        )
        middle = np.nanmean([np.nanmin(table), np.nanmax(table)])
        for (i, j), value in np.ndenumerate(table):
            if np.isfinite(value) and table.size <= 36:
                axis.text(
                    j,
                    i,
                    short(value / bar.size),
                    ha="center",
                    va="center",
                    color="k" if value > middle else "w",
                    fontsize=7,
                )
        for key, shown, place, set_label in (
            (keys[0], ends[0], axis.set_yticks, axis.set_ylabel),
            (keys[1], ends[1], axis.set_xticks, axis.set_xlabel),
        ):
            shown = [value_text(t) for t in shown]
            every = -(
                -(len(shown) if key == keys[0] else sum(map(len, shown)) // 2) // 14
            )  # as many as there is room for
            place(range(0, len(shown), every), shown[::every])
            set_label(axis_label(key, results[0]))
    return page.finish(title(results, f"Study at {name}"))
