#include "io/netcdf_writer.hpp"

#include "base/error.hpp"
#include "base/version.h"
#include "io/netcdf_table.hpp"
#include "surface/measured.hpp"

namespace rsc {
namespace {

std::string date() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        char* end = nullptr;
        const long long seconds = std::strtoll(epoch, &end, 10);
        if (end != epoch && *end == '\0') now = static_cast<std::time_t>(seconds);
    }
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

std::string history_text(const std::string& command) {
    return date() + " " + (command.empty() ? "rsc " RSC_VERSION : command);
}

void write_result(const Result& result, const std::string& path, const std::string& command) {
    const Observations& o = result.observations;
    if (o.realizations == 0 || o.steps == 0)
        throw Error(Failure::internal, "result file: there is nothing to write, no level was run");
    ResultTable(result)
        .make(history_text(command))
        .write(path, result.settings.output.format, result.settings.output.compression);
}

void ResultTable::measured() {
    if (!r_.measured) return;
    const Measured& m = *r_.measured;
    if (!m.channel.empty()) file_.attribute("surface_channel", m.channel);
    measured_form(m);
    measured_heights(m);
    measured_spectrum(m);
    measured_quantiles(m);
    if (m.fit) measured_fit(m.spectrum, *m.fit);
    if (m.profile) measured_profile(*m.profile);
}

// The profile before and after its treatment, its parameters and its spectrum.
void ResultTable::measured_profile(const MeasuredProfile& p) {
    const Measured& m = *r_.measured;
    const auto places = [&](double first, std::size_t n) {
        return each_of(int(n), [&](int i) { return first + i * m.dx; });
    };
    add_axis("trace_x", unit(1), "place of the points of the profile as read",
             places(p.trace_x0, p.trace.size()));
    add_absent("trace", {"trace_x"}, unit(1), "heights of the profile as read", p.trace,
               "missing points are missing");
    add_absent("trace_form", {"trace_x"}, unit(1), "form subtracted from them", p.form,
               "missing at missing points");
    add_axis("profile_x", unit(1), "place of the points of the treated profile",
             places(m.x0, p.heights.size()));
    add("profile", {"profile_x"}, unit(1), "heights of the treated profile", p.heights);
    const ProfileParameters& v = p.parameters;
    const char* const standard =
        p.cutoff_long > 0 ? "ISO 21920-2, roughness profile" : "ISO 21920-2, primary profile";
    const std::tuple<const char*, const char*, int, double> values[] = {
        {"ra", "arithmetic mean deviation Ra", 1, v.ra},
        {"rq", "root mean square deviation Rq", 1, v.rq},
        {"rz", "maximum height Rz, mean over sampling lengths", 1, v.rz},
        {"rsk", "skewness Rsk", 0, v.rsk},
        {"rku", "kurtosis Rku", 0, v.rku},
        {"rdq", "root mean square slope Rdq", 0, v.rdq},
        {"evaluation_length", "evaluation length of the profile", 1, v.length},
        {"sampling_length", "sampling length of rz", 1, v.sampling_length}};
    for (const auto& [name, meaning, power, value] : values)
        add_absent(name, {}, power == 0 ? "1" : unit(power), meaning, {value}, standard);
    add("cutoff_long", unit(1), "long-wave cutoff of the Gaussian filter; 0: none", p.cutoff_long,
        comment("ISO 16610-21; half of it is lost at each end"));
    const ProfileSpectrum& s = p.spectrum;
    add_axis("profile_wavenumber", unit(-1),
             "wavenumber q = 2 pi/lambda along the profile, middle of a band", s.wavenumber);
    add("profile_psd", {"profile_wavenumber"}, unit(3),
        "power spectral density C1 of the profile, mean over the band", s.psd,
        comment("after a Hann window, divided by the transmission of the filters; the integral of "
                "C1 dq over all q, negative ones included, is the mean square height"));
    add("profile_modes", {"profile_wavenumber"}, "1", "Fourier modes in the band", s.modes);
    if (!p.fit) return;
    std::vector<double> fitted;
    for (const double q : s.wavenumber)
        fitted.push_back(profile_of_self_affine(p.fit->surface, q / p.stretch) / p.stretch);
    add("profile_psd_fit", {"profile_wavenumber"}, unit(3),
        "density C1 of the profiles of the self-affine surface fitted to profile_psd", fitted,
        {{"sigma", p.fit->sigma.value},
         {"sigma_error", p.fit->sigma.error},
         {"rms_slope", p.fit->slope.value},
         {"rms_slope_error", p.fit->slope.error},
         {"noise", p.fit->noise / p.stretch},
         {"comment",
          "the parameters of the surface are attributes of psd_fit; rms_slope is that of a profile "
          "across the lay; noise: density of white noise under it; errors are 90 % intervals"}});
}

void ResultTable::measured_form(const Measured& m) {
    add("filled_points", "1", "missing points of the map that were filled", clamped(m.missing),
        {{"share", m.missing_share},
         {"comment", "with the harmonic function of the heights around them"}});
    if (m.outlier_times > 0)
        add("outlier_points", "1", "number of filled_points that were outliers",
            clamped(m.outliers.count),
            {{"threshold", m.outliers.threshold},
             {"standard_deviations", m.outlier_times},
             {"comment",
              "differing from the median of the 5 x 5 points around them by more than the "
              "threshold"}});
    NetcdfAttributes form = flags(kDetrendNames);
    append(form, {{"level", m.form.level},
                  {"slope", std::vector<double>{m.form.slope_x, m.form.slope_y}},
                  {"second_derivatives", std::vector<double>{m.form.zxx, m.form.zxy, m.form.zyy}}});
    if (m.form.how == Detrend::sphere && std::isfinite(m.form.radius))
        form.push_back({"radius", m.form.radius});
    form.push_back({"comment",
                    "least-squares fit to the valid points, subtracted; slopes and second "
                    "derivatives in the middle of the map: x, y, xx, xy "
                    "and yy; the radius of a sphere is positive for a dome"});
    add("form_removed", "1", "form subtracted from the heights", std::int32_t(m.form.how), form);
    add("filter_cutoff", unit(1), "cutoff of the Gaussian filter of the heights; 0: none",
        m.filter_cutoff,
        comment("ISO 16610-61: exp(-pi (alpha cutoff/lambda)^2), alpha = sqrt(ln 2/pi)"));
}

void ResultTable::measured_heights(const Measured& m) {
    add_axis("map_stage", "1", "stage of the map", one_to(3),
             {{"flag_values", one_to(3)}, {"flag_meanings", "as_read without_form filtered"}});
    const Roughness* const stages[] = {&m.as_read, &m.without_form, &m.filtered};
    const auto of_stages = [&](double Roughness::*member) {
        std::vector<double> all;
        for (const Roughness* s : stages) all.push_back(s->*member);
        return all;
    };
    add("stage_rms_height", {"map_stage"}, unit(1), "rms height about the mean",
        of_stages(&Roughness::height));
    add("stage_rms_slope", {"map_stage"}, "1", "rms gradient by first differences",
        of_stages(&Roughness::slope));
    add("stage_rms_curvature", {"map_stage"}, unit(-1),
        "rms second derivative of a profile, sqrt(m4), by second differences",
        of_stages(&Roughness::curvature));

    add("sq", unit(1), "rms height Sq (ISO 25178-2)", m.parameters.sq);
    add_absent("ssk", {}, "1", "skewness of the heights Ssk (ISO 25178-2)", {m.parameters.ssk},
               "0 for Gaussian heights");
    add_absent("sku", {}, "1", "kurtosis of the heights Sku (ISO 25178-2)", {m.parameters.sku},
               "3 for Gaussian heights");
    add("sdq", "1", "rms gradient Sdq (ISO 25178-2)", m.parameters.sdq);
    add("isotropy_ratio", "1", "ratio of smallest to largest rms slope over all directions",
        m.isotropy, comment("1 for an isotropic surface, 0 for grooves"));
    add("points_per_wave", "1", "grid steps in the shortest wavelength, 2 pi/ks",
        m.points_per_wave(),
        comment("below 4 slopes, curvatures and summits are determined by the grid or by noise"));

    const int bins = int(m.height_pdf.size());
    add_axis("height_bin", unit(1), "middle of the bin of heights about their mean",
             each_of(bins, [&](int i) { return (i + 0.5 - 0.5 * bins) * m.height_bin; }));
    add("height_pdf", {"height_bin"}, unit(-1), "probability density of the heights", m.height_pdf);
}

void ResultTable::measured_spectrum(const Measured& m) {
    const auto of_twins = [&](const std::string& what, double exponent) {
        NetcdfAttributes attributes = comment(
            what +
            "; synthetic surfaces have it times k^twin_exponent, for the rms slope of the map");
        attributes.push_back({"twin_exponent", exponent});
        return attributes;
    };
    add_axis("wavenumber", unit(-1),
             "wavenumber k = 2 pi/lambda, middle of a ring of Fourier modes",
             m.spectrum.wavenumber);
    add("psd", {"wavenumber"}, unit(4), "power spectral density Phi, mean over the ring",
        m.spectrum.psd,
        m.profile ? comment("of the surface that has such profiles, at the stretched wavenumber "
                            "k' of the assumed lay; the integral of 2 pi k' Phi dk' is its mean "
                            "square height")
                  : of_twins("after a Hann window; the integral of 2 pi k Phi dk is the mean "
                             "square height",
                             m.spectrum.exponent));
    if (m.profile) return;
    constexpr int angles = MeasuredSpectrum::kAngles;
    add_axis("plane_wavenumber", unit(-1), "wavenumber of psd_plane", m.spectrum.plane_wavenumber);
    add_axis("angle", "degree", "direction of the wave vector, from the x axis towards the y axis",
             each_of(angles, [](int a) { return 180.0 * a / angles; }));
    add("psd_plane", {"plane_wavenumber", "angle"}, unit(4), "power spectral density by direction",
        m.spectrum.plane_psd,
        of_twins("the other half plane is the mirror image; surface%twins = 'directional' "
                 "generates surfaces with it",
                 m.spectrum.plane_exponent));
}

void ResultTable::measured_quantiles(const Measured& m) {
    const HeightQuantiles& t = m.quantiles;
    add_axis("normal_score", "1",
             "normal score: the share erfc(-score/sqrt 2)/2 of the points is lower", t.score);
    add("height_quantile", {"normal_score"}, unit(1), "height about the mean at a normal score",
        t.height,
        comment("a straight line for Gaussian heights; surface%twin_heights = 'measured' generates "
                "surfaces with it"));
}

void ResultTable::measured_fit(const MeasuredSpectrum& spectrum, const SelfAffineFit& found) {
    std::vector<double> fit;
    for (const double k : spectrum.wavenumber) fit.push_back(found.around(k));
    add("psd_fit", {"wavenumber"}, unit(4), "self-affine spectrum fitted to psd", fit,
        {{"aspect", found.aspect},
         {"direction", found.direction * 180 / pi},
         {"Phi0", found.Phi0.value},
         {"Phi0_error", found.Phi0.error},
         {"kl", found.kl.value},
         {"kl_error", found.kl.error},
         {"ks", found.ks.value},
         {"ks_error", found.ks.error},
         {"hurst", found.hurst.value},
         {"hurst_error", found.hurst.error},
         {"plateau", std::int32_t{found.plateau ? 1 : 0}},
         {"plateau_seen", std::int32_t{found.plateau_seen ? 1 : 0}},
         {"kl_seen", std::int32_t{found.kl_seen ? 1 : 0}},
         {"ks_seen", std::int32_t{found.ks_seen ? 1 : 0}},
         {"comment",
          "Phi0 (k/kl)^(-2(1+hurst)) from kl to ks, Phi0 below kl with the plateau, 0 elsewhere, "
          "k = hypot(sqrt(aspect) k along, k across/sqrt(aspect)) the direction [degree] of the "
          "lay, mean over all directions; errors are 90 % intervals; ks_seen 0: the power law "
          "extends to the shortest wavelength of the grid; kl_seen 0: kl is an upper bound "
          "because the map is too small; plateau_seen 0: the existence of a plateau is not "
          "determined"}});
}

}  // namespace rsc
