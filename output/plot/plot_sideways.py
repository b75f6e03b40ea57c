"""What a contact answers sideways and through: stiffness beside the force, the loop of friction beside that of a smooth sphere under the same load, which spots
stick and slip, resistance against force.

The functions are of the kind that plot.py knows: (results, options) -> figure or None."""

import numpy as np

from plot_results import names, plain
from plot_style import few, legend, panels, style

def _loaded(result):
    return result.loaded()


def stiffness(results, options):
    """Force and stiffness -dN/dZ0 against separation."""
    results = [r for r in results if "stiffness" in r and r.loaded().size]
    if not results:
        return None
    figure, axes = panels(2, options.width, entries=few(len(results)))
    labels = names(results)
    for k, result in enumerate(results):
        _, line, colour = style(k, len(results))
        at = _loaded(result)
        z = result.depth()[0][at]
        axes[0].plot(z, result.mean("force")[at], line, color=colour, label=labels[k] if len(results) > 1 else None)
        axes[1].plot(z, -result.mean("stiffness")[at], line, color=colour)
    for axis, label in zip(axes, ("force $N$" + results[0].unit("force"), "stiffness $-dN/dZ_0$" + results[0].unit("stiffness"))):
        axis.set(xlabel=results[0].depth()[1], ylabel=label, yscale="log")
        axis.invert_xaxis()
    legend(axes[0], below=axes[2] if len(axes) > 2 else None)
    figure.suptitle("Force and stiffness against separation", fontsize=8)
    return figure


def resistance(results, options):
    """Constriction resistance against force, where resistivities are given."""
    results = [r for r in results if "resistance" in r and r.loaded().size]
    if not results:
        return None
    figure, axes = panels(1, min(options.width, 130.0), least=30.0, entries=few(len(results)))
    labels = names(results)
    for k, result in enumerate(results):
        _, line, colour = style(k, len(results))
        at = _loaded(result)
        axes[0].plot(result.mean("force")[at], result.mean("resistance")[at], line, color=colour, label=labels[k] if len(results) > 1 else None)
    label = "constriction resistance" + results[0].unit("resistance")
    axes[0].set(xlabel="force $N$" + results[0].unit("force"), ylabel=label, xscale="log", yscale="log")
    legend(axes[0], below=axes[1] if len(axes) > 1 else None)
    figure.suptitle("Resistance against force", fontsize=8)
    return figure


def _friction_level(result, options):
    """The level to draw: the one asked for, otherwise the last with a loop."""
    loops = np.flatnonzero(np.isfinite(result["tangential_force"][:, -1]))
    if options.step is not None:
        return options.step - 1 if options.step - 1 in loops else None
    return int(loops[-1]) if loops.size else None


def _slide_per_depth(result, step):
    """mu/m: the slide that full slip takes, over the approach since first touch; m is the tangential over the normal stiffness."""
    mu = float(result.case["solids%friction"])
    return mu / (result["tangential_stiffness"][step] / -result["stiffness"].reshape(-1, result.steps)[0][step])


def loop(results, options):
    """The loop of friction of a level, beside Mindlin's for a smooth sphere of the same radius, moduli and load."""
    results = [r for r in results if "tangential_force" in r]
    if len(results) != 1:
        return None
    result = results[0]
    step = _friction_level(result, options)
    if step is None:
        return None
    figure, axes = panels(1, min(options.width, 130.0), least=30.0)
    x, Q = result["tangential_displacement"][step], result["tangential_force"][step]
    axes[0].plot(x, Q, color=style(0, 2)[2], label="rough")
    N, mu = result["force_mean"][step], float(result.case["solids%friction"])
    R, E = float(result["r_star"]), float(result["e_star"])
    if np.isfinite(R) and R < 1e30:
        full = _slide_per_depth(result, step) * (3 * N / (4 * E * np.sqrt(R))) ** (2 / 3)
        drop = lambda t: mu * N * (1 - np.clip(1 - t, 0, None) ** 1.5)
        t = np.linspace(0, 1, 61)
        back = np.linspace(0, 0.9, 61)
        reach = drop(0.9)
        smooth_x = np.concatenate([t, 0.9 - 2 * back, -0.9 + 2 * back])
        smooth_Q = np.concatenate([drop(t), reach - 2 * drop(back), -reach + 2 * drop(back)])
        axes[0].plot(full * smooth_x, smooth_Q, style(1, 2)[1], color=style(1, 2)[2], label="smooth sphere (Mindlin)")
    axes[0].set(xlabel="displacement" + result.unit("tangential_displacement"), ylabel="tangential force $Q$" + result.unit("tangential_force"))
    legend(axes[0])
    figure.suptitle(result.heading(f"Friction at {result.level_name(step)}, $N$ = {N:.3g}{plain(result.unit('force'))}"), fontsize=8)
    return figure


def stick(results, options):
    """Spots of a level as a map: what sticks and what slips at about half of the slide to full slip. The part that sticks is the spot of an earlier level, Z0',
    the slide being (mu/m) (Z0' - Z0)."""
    results = [r for r in results if "tangential_force" in r and "contact_radius" in r]
    if len(results) != 1:
        return None
    from matplotlib.collections import EllipseCollection

    result = results[0]
    step = _friction_level(result, options)
    if step is None:
        return None
    Z, count, start = result.mean("separation"), result["contact_count"].astype(int), result["contact_start"].astype(int) - 1
    full = result["tangential_displacement"][step].max()
    slides = _slide_per_depth(result, step) * (Z - Z[step])
    inner = int(np.argmin(abs(slides - 0.5 * full)))
    if not 0 < slides[inner] < full or count[step] == 0:
        return None
    spots = {}
    for level in (step, inner):
        part = slice(start[level], start[level] + count[level])
        which = result["contact_asperity"][part].astype(int) - 1
        spots[level] = result["asperity_x"][which], result["asperity_y"][which], 2 * result["contact_radius"][part]
    figure, axes = panels(1, min(options.width, 130.0), aspect=0.95, least=30.0)
    for level, colour, label in ((step, style(1, 2)[2], "slips"), (inner, style(0, 2)[2], "sticks")):
        x, y, width = spots[level]
        axes[0].add_collection(EllipseCollection(width, width, 0 * width, units="x", offsets=np.column_stack([x, y]), transOffset=axes[0].transData, facecolors=colour, edgecolors="none"))
        axes[0].plot([], [], "o", color=colour, label=label)
    x, y, width = spots[step]
    margin = 0.05 * max(np.ptp(x), np.ptp(y), width.max())
    axes[0].set(xlim=(x.min() - margin, x.max() + margin), ylim=(y.min() - margin, y.max() + margin), aspect="equal", xlabel="$x$" + result.unit("asperity_x"), ylabel="$y$" + result.unit("asperity_y"))
    legend(axes[0], loc="upper right")
    figure.suptitle(result.heading(f"Spots at {result.level_name(step)}, slide {slides[inner] / full:.0%} of full slip"), fontsize=8)
    return figure


PICTURES = {"stiffness": stiffness, "loop": loop, "stick": stick, "resistance": resistance}
