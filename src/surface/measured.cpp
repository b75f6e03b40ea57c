#include "surface/measured.hpp"

#include "base/error.hpp"
#include "base/format.hpp"

namespace rsc {
namespace {

// Filled points that change the rms height by more than this share are reported.
constexpr double kMuchByFilled = 0.1;

void refuse_missing(const HeightMap& map, long missing) {
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx))
            if (std::isnan(map(i, j)))
                bad_input(
                    format("%ld of %.0f points are missing, the first in column %d of row %d, "
                           "counted from 0 with y upwards; "
                           "surface%%missing = 'fill' fills them",
                           missing, double(map.points()), i, j));
}

// Histogram of the heights in 60 bins from -5 to 5 Sq; the few heights beyond are ignored.
void count_heights(const HeightMap& map, Measured& m) {
    constexpr int kBins = 60;
    constexpr double kReach = 5;
    m.height_bin = 2 * kReach * m.parameters.sq / kBins;
    m.height_pdf.assign(kBins, 0.0);
    if (!(m.height_bin > 0)) return;
    const auto points = double(map.points());
    double mean = 0;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) mean += map(i, j) / points;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double bin = std::floor((map(i, j) - mean) / m.height_bin + 0.5 * kBins);
            if (bin >= 0 && bin < kBins) m.height_pdf[at(bin)] += 1 / (points * m.height_bin);
        }
}

std::string told_change(const Roughness& before, const Roughness& after, const char* l) {
    return format(
        "rms height %.4g -> %.4g %s, rms slope %.4g -> %.4g, rms curvature %.4g -> %.4g 1/%s",
        before.height, after.height, l, before.slope, after.slope, before.curvature,
        after.curvature, l);
}

// Reports pits, spikes and steps with their places.
void tell_breaks(const Measured& m, const char* l, std::vector<std::string>& lines) {
    const auto at = [&](const Breaks::Found& found) {
        return format("%.4g %s at x = %.6g, y = %.6g", found.size, l, m.x(found.largest.i),
                      m.y(found.largest.j));
    };
    const auto& [pits, spikes, steps] = m.breaks.found;
    if (pits.points > 0)
        lines.push_back(
            format("pits or grooves one point wide: %ld points, the deepest ", pits.points) +
            at(pits) +
            "; boundary elements include them, the summits beside them are those of the "
            "surrounding surface");
    if (spikes.points > 0)
        lines.push_back(format("warning: spikes one point wide: %ld, the highest ", spikes.points) +
                        at(spikes) + ": they touch first, but their shape is not resolved");
    if (steps.points > 0)
        lines.push_back(
            format("warning: steps: heights jump at %ld points, most by ", steps.points) +
            at(steps));
}

}  // namespace

Roughness roughness(const HeightMap& map) {
    const Moments m = grid_moments(map);
    return {std::sqrt(m.m0), m.rms_slope(), std::sqrt(m.m4)};
}

bool Measured::gaussian() const {
    if (!(parameters.sq > 0)) return true;  // flat
    return std::abs(parameters.ssk) <= 0.3 && std::abs(parameters.sku - 3) <= 0.6;
}

double Measured::points_per_wave() const { return shortest_wave / step(); }

namespace {

// The spectrum of the treated map, and the self-affine one fitted to it.
void measure_and_fit(const HeightMap& map, const Isotropy& slopes, Measured& m) {
    const auto spectrum = [&](double aspect, double direction) {
        MeasuredSpectrum s = measure_spectrum(map, aspect, direction);
        if (m.form.how == Detrend::quadratic || m.form.how == Detrend::sphere) s.lost = 2.5;
        return s;
    };
    m.spectrum = spectrum(1, 0);
    // The aspect ratio is limited for endless grooves, as it is in synthesis.
    const double aspect = m.isotropy < kIsotropic ? 1 / std::max(m.isotropy, 0.05) : 1;
    const MeasuredSpectrum stretched =
        aspect > 1 ? spectrum(aspect, slopes.direction) : MeasuredSpectrum();
    m.shortest_wave = 2 * m.step();
    if (can_fit(m.spectrum)) {
        m.fit = fit_self_affine(m.spectrum);
        m.shortest_wave = 2 * pi / m.fit->ks.value;
    }
    keep_depths(m.filled, m.nx, m.ny,
                std::max(1, int(std::lround(m.shortest_wave / (8 * m.step())))));
    if (can_fit(stretched)) {
        m.fit = fit_self_affine(stretched);
        m.fit->aspect = aspect;
        m.fit->direction = slopes.direction;
    }
    if (m.fit) {
        MeasuredSpectrum& s = m.spectrum;
        const SpectrumTable table(s.wavenumber, s.psd),
            plane(s.plane_wavenumber, s.plane_psd, MeasuredSpectrum::kAngles);
        const auto breaks = [](const Breaks::Found& found) { return found.points > 0; };
        const double most =
            std::any_of(m.breaks.found.begin(), m.breaks.found.end(), breaks) ? 0 : kMostExponent;
        s.exponent = twin_exponent([&](double kx, double ky) { return table(std::hypot(kx, ky)); },
                                   s.wavenumber, map, m.parameters, most);
        s.plane_exponent = twin_exponent(plane, s.plane_wavenumber, map, m.parameters, most);
    }
}

// The spectrum of a treated profile and of the surface that has such profiles.
void measure_profile(const HeightMap& map, const MeasureOptions& options, MeasuredProfile& p,
                     Measured& m) {
    p.heights.assign(map.row(0), map.row(0) + map.nx);
    p.parameters = profile_parameters(map, options.cutoff_long);
    p.cutoff_long = options.cutoff_long;
    p.spectrum = profile_spectrum(map, options.cutoff_long, options.filter_cutoff, m.form.how);
    Spectrum lay;
    lay.aspect = options.aspect;
    lay.direction = options.direction;
    p.stretch = std::sqrt(stretch(lay).yy);
    m.shortest_wave = 2 * m.dx;
    if (!can_fit(p.spectrum)) return;
    ProfileSpectrum isotropic = p.spectrum;
    for (double* const k : {&isotropic.step, &isotropic.lowest, &isotropic.highest})
        *k /= p.stretch;
    for (auto* const all : {&isotropic.wavenumber, &isotropic.middle})
        for (double& k : *all) k /= p.stretch;
    for (double& c : isotropic.psd) c *= p.stretch;
    p.fit = fit_profile(isotropic);
    m.fit = p.fit->surface;
    m.fit->aspect = options.aspect;
    m.fit->direction = options.direction * pi / 180;
    m.shortest_wave = 2 * pi / (m.fit->ks.value * p.stretch);
    MeasuredSpectrum& s = m.spectrum;
    if (options.by_inversion) {
        s.wavenumber = isotropic.wavenumber;
        s.psd = isotropic_spectrum(s.wavenumber, isotropic.psd);
        return;
    }
    // To the ends of the band, and with a plateau to the longest wave of the profile.
    const double first =
        m.fit->plateau ? std::min(isotropic.step, m.fit->kl.value) : m.fit->kl.value;
    constexpr int points = 200;
    for (const int i : indices(points)) {
        const double k = first * std::pow(m.fit->ks.value / first, i / (points - 1.0));
        s.wavenumber.push_back(i + 1 == points ? m.fit->ks.value : k);
        s.psd.push_back((*m.fit)(s.wavenumber.back()));
    }
}

std::shared_ptr<MeasuredProfile> trace_of(const HeightMap& map) {
    if (map.ny > 1) return nullptr;
    auto profile = std::make_shared<MeasuredProfile>();
    profile->trace.assign(map.row(0), map.row(0) + map.nx);
    profile->trace_x0 = map.x0;
    return profile;
}

void filter_profile(HeightMap& map, double cutoff_long, Measured& m) {
    remove_long_waves(map, cutoff_long);
    cut_ends(map, int(std::ceil(0.5 * cutoff_long / map.dx)), m.filled);
    static_cast<PointGrid&>(m) = map;
    m.filtered = roughness(map);
}

}  // namespace

Measured measure(HeightMap& map, const MeasureOptions& options) {
    Measured m;
    static_cast<PointGrid&>(m) = map;
    // Beyond this ratio, rounding removes the smaller of the terms in 1/dx^2 and 1/dy^2 from their
    // sum.
    constexpr double most_unlike = 1e4;
    if (map.ny > 1 && std::max(map.dx, map.dy) > most_unlike * std::min(map.dx, map.dy))
        bad_input(format("steps of %.6g x %.6g: one is more than %.0f times the other", map.dx,
                         map.dy, most_unlike));
    m.missing = count_missing(map);
    const auto points = double(map.points());
    if (m.missing > 0 && double(m.missing) == points)
        bad_input("all points of the map are missing");
    if (m.missing > 0 && options.missing == Missing::refuse) refuse_missing(map, m.missing);
    m.outlier_times = options.outliers;
    if (options.outliers > 0) m.outliers = remove_outliers(map, options.outliers);
    m.missing += m.outliers.count;
    m.missing_share = double(m.missing) / points;
    if (!(options.filter_cutoff > 0)) m.height_step = height_step(map);
    m.as_read = roughness(map);
    const std::shared_ptr<MeasuredProfile> profile = trace_of(map);
    m.form = detrend(map, options.detrend);
    for (int i = 0; profile && i < map.nx; ++i)
        profile->form.push_back(profile->trace[std::size_t(i)] - map(i, 0));
    m.filled = fill_missing(map);
    for (const int j : indices(map.ny))
        if (!std::all_of(map.row(j), map.row(j) + map.nx,
                         [](double z) { return std::isfinite(z); }))
            bad_input(
                "the heights are too small or too large: their squares overflow or underflow "
                "double precision");
    m.without_form = m.filtered = roughness(map);
    m.filter_cutoff = options.filter_cutoff;
    if (options.filter_cutoff > 0) {
        gaussian_filter(map, options.filter_cutoff);
        m.filtered = roughness(map);
        constexpr double rounding = 1e-12;  // of the heights before
        if (m.without_form.height > 0 && !(m.filtered.height > rounding * m.without_form.height))
            bad_input(format("surface%%filter_cutoff = %g removes all heights of a map of %g x %g",
                             options.filter_cutoff, map.Lx(), map.Ly()));
    }
    if (profile && options.cutoff_long > 0) filter_profile(map, options.cutoff_long, m);
    m.breaks = find_breaks(map, m.height_step);
    m.parameters = height_parameters(map);
    m.moments = grid_moments(map);
    const Isotropy slopes = isotropy(map);
    m.isotropy = slopes.ratio;
    m.quantiles = height_quantiles(map);
    count_heights(map, m);
    if (profile) {
        measure_profile(map, options, *profile, m);
        m.profile = profile;
    } else {
        measure_and_fit(map, slopes, m);
    }
    return m;
}

namespace {

void tell_points(const Measured& m, const char* l, std::vector<std::string>& lines) {
    if (m.profile)
        lines.push_back(format("profile%s: %zu points, %.6g %s apart",
                               m.channel.empty() ? "" : (" '" + m.channel + "'").c_str(),
                               m.profile->trace.size(), m.dx, l));
    else
        lines.push_back(format("map%s: %d x %d points of %.6g x %.6g %s, %.6g x %.6g %s",
                               m.channel.empty() ? "" : (" '" + m.channel + "'").c_str(), m.nx,
                               m.ny, m.dx, m.dy, l, m.Lx(), m.Ly(), l));
    if (m.code)
        lines.push_back(format(
            "warning: %ld points (%.3g %%) have the height %s: if that means a missing point, "
            "set surface%%missing_value = %s",
            m.coded, 100 * double(m.coded) / double(m.points()), text_of(*m.code).c_str(),
            text_of(*m.code).c_str()));
    if (m.outlier_times > 0)
        lines.push_back(format(
            "outliers: %ld points differ by more than %.4g %s (%.3g standard deviations) "
            "from %s around them%s",
            m.outliers.count, m.outliers.threshold, l, m.outlier_times,
            m.profile ? "lines through two points" : "the 5 x 5 points",
            m.outliers.islands > 0
                ? format("; %ld of these are alone inside a missing part", m.outliers.islands)
                      .c_str()
                : ""));
    if (m.missing > 0)
        lines.push_back(format("missing points%s: %ld (%.3g %%) filled",
                               m.outliers.count > 0 ? " and outliers" : "", m.missing,
                               100 * m.missing_share));
    if (m.missing > 0 && std::abs(m.without_form.height / m.form.rms - 1) > kMuchByFilled)
        lines.push_back(format(
            "warning: filled points change the rms height from %.4g to %.4g %s: %s, or a wide "
            "margin of the map is missing, which surface%%window crops",
            m.form.rms, m.without_form.height, l,
            m.outliers.count > 0
                ? "narrow grooves were taken for outliers, which a larger surface%outliers leaves, "
                  "or outliers at the border of the holes are left, which a smaller one removes"
            : m.outlier_times > 0 ? "they continue outliers at the border of the holes, which a "
                                    "smaller surface%outliers removes"
                                  : "they continue outliers at the border of the holes, which a "
                                    "positive surface%outliers (6) removes"));
}

void tell_form_and_heights(const Measured& m, const char* l, std::vector<std::string>& lines) {
    std::string form = std::string("form '") + kDetrendNames[at(m.form.how)] + "': ";
    if (m.profile && m.form.how == Detrend::plane)
        form += format("line of slope %.4g; ", m.form.slope_x);
    else if (m.form.how == Detrend::plane || m.form.how == Detrend::quadratic)
        form += format("slopes %.4g, %.4g; ", m.form.slope_x, m.form.slope_y);
    if (m.form.how == Detrend::sphere)
        form += format("radius %.6g %s (%s); ", std::abs(m.form.radius), l,
                       m.form.radius > 0 ? "dome" : "bowl");
    lines.push_back(form + told_change(m.as_read, m.without_form, l));
    if (m.filter_cutoff > 0)
        lines.push_back(format("filter (Gaussian, %.4g %s): ", m.filter_cutoff, l) +
                        told_change(m.without_form, m.filtered, l));
    if (!(m.parameters.sq > 0))
        lines.push_back("heights: all are equal");
    else if (!m.profile)
        lines.push_back(format(
            "heights: Sq %.5g %s, Ssk %.3f, Sku %.3f, Sdq %.4g; isotropy ratio of slopes %.2f",
            m.parameters.sq, l, m.parameters.ssk, m.parameters.sku, m.parameters.sdq, m.isotropy));
    if (m.height_step > 0)
        lines.push_back(
            format("heights are rounded to multiples of %.4g %s: asperities are detected after a "
                   "Wiener filter has removed the rounding",
                   m.height_step, l));
}

void tell_spectrum(const Measured& m, const char* l, std::vector<std::string>& lines) {
    constexpr double kKnown = 0.5;  // of the interval of a Hurst exponent, 0 to 1
    const bool unknown = m.fit && m.fit->hurst.error > kKnown;
    if (unknown)
        lines.emplace_back(
            "spectrum: not that of a self-affine surface (hurst and its wavelengths are unknown)");
    else if (m.fit) {
        const SelfAffineFit& fit = *m.fit;
        const double two_pi = 2 * pi;
        const char* const plateau =
            !fit.kl_seen        ? ""
            : !fit.plateau_seen ? " (too few long waves to tell whether there is a plateau above)"
            : fit.plateau       ? " (plateau above)"
                                : "";
        lines.push_back(format(
            "spectrum%s: hurst %.3f +- %.3f, lambda_l %s%.4g %s%s, lambda_s %.4g %s%s, %.1f points "
            "in the shortest wave",
            fit.aspect > 1
                ? format(" (waves between along and across the lay, aspect %.2f)", fit.aspect)
                      .c_str()
                : "",
            fit.hurst.value, fit.hurst.error, fit.kl_seen ? "" : "at least ", two_pi / fit.kl.value,
            l, plateau, two_pi / fit.ks.value, l, fit.ks_seen ? "" : " (limit of the grid)",
            m.points_per_wave()));
    } else {
        lines.emplace_back("spectrum: not fitted, there are too few points or no heights");
    }
    if (!unknown && m.points_per_wave() < kFewPointsPerWave)
        lines.push_back(
            format("warning: fewer than %.0f points in the shortest wave: slopes, curvatures and "
                   "summits are determined by the grid or by pixel noise; "
                   "surface%%filter_cutoff removes such waves",
                   kFewPointsPerWave));
}

// What similar synthetic surfaces need.
void tell_twins(const Measured& m, std::vector<std::string>& lines) {
    const bool directional = !m.profile && m.isotropy < kIsotropic, gaussian = m.gaussian();
    if (directional) lines.push_back(format("lay at %.0f degrees from x", m.spectrum.lay));
    if (directional || !gaussian)
        lines.push_back(std::string(m.profile ? "the profile " : "the map ") +
                        (directional ? "has a lay" : "") +
                        (directional && !gaussian ? " and " : "") +
                        (gaussian ? "" : "has heights that are not Gaussian") +
                        "; to reproduce this in synthetic surfaces, set " +
                        (directional ? "surface%twins = 'directional'" : "") +
                        (directional && !gaussian ? ", " : "") +
                        (gaussian ? "" : "surface%twin_heights = 'measured'"));
}

}  // namespace

namespace {

void tell_profile(const Measured& m, const char* l, std::vector<std::string>& lines) {
    const MeasuredProfile& profile = *m.profile;
    const ProfileParameters& p = profile.parameters;
    if (profile.cutoff_long > 0)
        lines.push_back(format(
            "filter (Gaussian, ISO 16610-21): waves longer than %.4g %s removed, and half of that "
            "at each end, where the filter reaches beyond the profile; %d points, %.6g %s, remain",
            profile.cutoff_long, l, m.nx, p.length, l));
    lines.push_back(format("profile: Ra %.5g, Rq %.5g, Rz %.5g %s, Rsk %.3f, Rku %.3f, Rdq %.4g",
                           p.ra, p.rq, p.rz, l, p.rsk, p.rku, p.rdq));
    lines.push_back(
        profile.cutoff_long > 0
            ? format("Rz: mean over %d sampling lengths of %.4g %s", p.samplings, p.sampling_length,
                     l)
            : std::string("without surface%cutoff_long these are values of the primary profile "
                          "(Pa, Pq, ...), Rz over its whole length"));
    lines.push_back(
        "a profile passes beside most summits: those of the surface are higher and more sharply "
        "curved than its peaks, and its lay is not seen");
    if (!profile.fit) return;
    const ProfileFit& fit = *profile.fit;
    lines.push_back(format(
        "surface with such profiles (%s): rms height %.4g +- %.2g %s of waves up to %.4g %s "
        "(form and filter take longer ones), rms slope of a profile %.4g +- %.2g, 90 %% intervals",
        m.fit->aspect == 1 ? "isotropic"
                           : format("lay with aspect %.3g at %.4g degrees, assumed", m.fit->aspect,
                                    m.fit->direction * 180 / pi)
                                 .c_str(),
        fit.sigma.value, fit.sigma.error, l, 2 * pi / profile.spectrum.lowest, l, fit.slope.value,
        fit.slope.error));
    if (fit.surface.hurst.value > 0.99 * kMostHurst)
        lines.push_back(
            "warning: the spectrum falls faster than that of a self-affine surface, as where the "
            "instrument smooths: surface%profile_surface = 'inversion' takes it as it is, and "
            "surface%filter_cutoff removes its short waves");
    if (fit.noise > 0)
        lines.push_back(format(
            "white noise of some %.2g %s rms lies under the spectrum; surface%%filter_cutoff "
            "removes short waves from the profile",
            std::sqrt(2 * profile.spectrum.highest * fit.noise), l));
}

}  // namespace

std::vector<std::string> report(const Measured& m, const std::string& length_unit) {
    const char* const l = length_unit.c_str();
    std::vector<std::string> lines;
    tell_points(m, l, lines);
    tell_form_and_heights(m, l, lines);
    if (m.profile) tell_profile(m, l, lines);
    tell_breaks(m, l, lines);
    tell_spectrum(m, l, lines);
    tell_twins(m, lines);
    return lines;
}

}  // namespace rsc
