#!/usr/bin/env python3
"""A measured map as rsc took it: heights, spectrum with its fit and with that of twins, distribution of heights.

    python3 output/plot/plot_surface.py output/map.nc [output/map_twins.nc ...] [-o FILE]

The first result is that of a map (surface%source = 'heights'); with &output heights = .true. the map itself is drawn. Further results of
synthetic surfaces add the rms slope and curvature of their realizations to the title of the spectrum. Needs python3-matplotlib and python3-netcdf4.
"""

import argparse
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")  # works without a screen
    import matplotlib.pyplot as plt
    import numpy as np
    from netCDF4 import Dataset
except ImportError as missing:
    sys.exit(f"The Python module {missing.name!r} is missing; on Debian: apt install python3-numpy python3-matplotlib python3-netcdf4")


def draw_map(axis, result):
    if "height" not in result.variables:
        axis.text(0.5, 0.5, "the file holds no heights\n(&output heights = .true.)", ha="center", va="center", transform=axis.transAxes)
        axis.set_axis_off()
        return
    z = result["height"]
    y, x = (np.asarray(result[name][:]) for name in z.dimensions)
    step = [x[1] - x[0], y[1] - y[0]]
    extent = [x[0] - step[0] / 2, x[-1] + step[0] / 2, y[0] - step[1] / 2, y[-1] + step[1] / 2]
    image = axis.imshow(np.asarray(z[:]), origin="lower", extent=extent, cmap="viridis")
    axis.figure.colorbar(image, ax=axis, label=f"height [{z.units}]", shrink=0.8)
    axis.set_xlabel(f"x [{z.units}]")
    axis.set_ylabel(f"y [{z.units}]")
    axis.set_title(f"Sq {float(result['sq'][...]):.3g} {z.units}, {int(result['filled_points'][...])} points filled")


def draw_spectrum(axis, result, twins):
    k, psd = np.asarray(result["wavenumber"][:]), np.asarray(result["psd"][:])
    axis.loglog(k, psd, ".", ms=3, color="#0b3c5d", label="measured")
    if "psd_fit" in result.variables:
        fit = result["psd_fit"]
        inside = np.asarray(fit[:]) > 0
        axis.loglog(k[inside], np.asarray(fit[:])[inside], "-", color="#c1440e",
                    label=f"fit: H = {fit.hurst:.2f} ± {fit.hurst_error:.2f}, $\\lambda_s$ = {2 * np.pi / fit.ks:.3g}, $\\lambda_l$ = {2 * np.pi / fit.kl:.3g}")
        power = np.asarray(fit[:])[inside]
        axis.set_ylim(max(psd[psd > 0].min(), power.min() * 1e-4), psd.max() * 5)
    for path, twin in twins:
        slope = np.asarray(twin["rms_slope"][:])
        axis.plot([], [], " ", label=f"{path.name}: rms slope {slope.mean():.3g}" + (f" ± {slope.std(ddof=1):.2g} ({slope.size})" if slope.size > 1 else ""))
    axis.plot([], [], " ", label=f"map: rms slope {float(result['sdq'][...]):.3g}, {float(result['points_per_wave'][...]):.1f} points a wave")
    axis.set_xlabel(f"wavenumber k [{result['wavenumber'].units}]")
    axis.set_ylabel(f"power spectral density [{result['psd'].units}]")
    axis.legend(fontsize=6)


def draw_heights(axis, result):
    z, density = np.asarray(result["height_bin"][:]), np.asarray(result["height_pdf"][:])
    sq, ssk, sku = (float(result[name][...]) for name in ("sq", "ssk", "sku"))
    axis.stairs(density, np.append(z, 2 * z[-1] - z[-2]) - (z[1] - z[0]) / 2, fill=True, color="#0b3c5d", alpha=0.4, label="measured")
    axis.plot(z, np.exp(-z**2 / (2 * sq**2)) / (np.sqrt(2 * np.pi) * sq), color="#c1440e", label="Gaussian of this rms")
    axis.set_xlabel(f"height about the mean [{result['height_bin'].units}]")
    axis.set_ylabel(f"probability density [{result['height_pdf'].units}]")
    axis.set_title(f"skewness {ssk:.2f} (0), kurtosis {sku:.2f} (3)")
    axis.legend(fontsize=6)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", type=pathlib.Path)
    parser.add_argument("twins", type=pathlib.Path, nargs="*")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="the picture (png, pdf, svg); NAME_surface.png by default")
    arguments = parser.parse_args()
    plt.rcParams.update({"font.size": 8, "axes.titlesize": 8, "savefig.dpi": 200})
    try:
        result, twins = Dataset(arguments.result), [(path, Dataset(path)) for path in arguments.twins]
    except OSError as error:
        sys.exit(f"plot_surface: {error}")
    if "psd" not in result.variables:
        sys.exit(f"plot_surface: {arguments.result} is no result of a measured map: it holds no psd")
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), constrained_layout=True)
    draw_map(axes[0], result)
    draw_spectrum(axes[1], result, twins)
    draw_heights(axes[2], result)
    picture = arguments.output or arguments.result.with_name(arguments.result.stem + "_surface.png")
    figure.savefig(picture)
    print(picture)


if __name__ == "__main__":
    main()
