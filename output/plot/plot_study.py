"""A study over two keys as maps: what the members give at one level."""

import numpy as np

from plot_results import differing_keys, key_label, value_text
from plot_style import panels

QUANTITIES = [("force", "force $N$"), ("contact_area", "contact area $A$"), ("contacts", "number of contacts")]


def _level(result, step):
    """The level asked for, or the last."""
    return result.steps - 1 if step is None else step - 1


def table(results, keys, name, step):
    """(values of the first key, of the second, array [first, second]) of the mean of a variable at a level; NaN where there is no member."""
    texts = [[r.case[key] for key in keys] for r in results]
    axes = [sorted({t[i] for t in texts}, key=lambda text: float(value_text(text).split(",")[-1]) if _is_number(text) else text) for i in (0, 1)]
    values = np.full((len(axes[0]), len(axes[1])), np.nan)
    for result, (first, second) in zip(results, texts):
        values[axes[0].index(first), axes[1].index(second)] = result.mean(name)[_level(result, step)]
    return axes[0], axes[1], values


def _is_number(text):
    try:
        float(value_text(text).split(",")[-1])
        return True
    except ValueError:
        return False


def study(results, options):
    """Force, area and contacts at the last level (or --step) over two keys; nothing where other than two keys vary."""
    results = [r for r in results if "force" in r]
    keys = differing_keys(results) if len(results) > 3 else []
    if len(keys) != 2:
        return None
    figure, axes = panels(len(QUANTITIES), options.width, aspect=0.95)
    for axis, (name, label) in zip(axes, QUANTITIES):
        first, second, values = table(results, keys, name, options.step)
        image = axis.imshow(values, cmap="cividis", aspect="auto")
        figure.colorbar(image, ax=axis, location="bottom", pad=0.02, aspect=25, label=label + results[0].unit(name))
        middle = np.nanmean([np.nanmin(values), np.nanmax(values)])
        for (i, j), value in np.ndenumerate(values):
            if np.isfinite(value) and values.size <= 36:
                axis.text(j, i, f"{value:.3g}", ha="center", va="center", color="k" if value > middle else "w", fontsize=6)
        for key, texts, place, set_label in ((keys[0], first, axis.set_yticks, axis.set_ylabel), (keys[1], second, axis.set_xticks, axis.set_xlabel)):
            symbol, unit = key_label(key, results[0])
            place(range(len(texts)), [value_text(t) for t in texts])
            set_label(symbol + (f" [{unit}]" if unit else ""))
    levels = {r.level_name(_level(r, options.step)) for r in results}
    figure.suptitle("Study at " + (levels.pop() if len(levels) == 1 else "the last level"), fontsize=8)
    return figure
